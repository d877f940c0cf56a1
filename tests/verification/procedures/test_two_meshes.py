"""The path on a coarse mesh leads: the same states as without it, what is said where it does not, and the mesh error.

The coarse path decides where Newton's method starts, not where it ends: states are those of the path on the fine mesh
alone, to the tolerance of both. The mesh error that follows from the two meshes is compared with a mesh of 2.5 mm,
on which the error is a tenth of that on the fine mesh.
"""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import turgor as tg
from turgor.accuracy.adaptivity.mesh_error import estimate_mesh_error
from turgor.core.results.measures.measures import find_measure
from turgor.core.solvers import solve as solving
from turgor.core.solvers.continuation.guide import Guide
from turgor.core.solvers.solution import Iteration
from turgor.units import MPa, kPa, mm

AT = (0.25, 0.5, 0.75)
ASKED = tg.Static(at=AT)
TIP = [find_measure("tip_displacement")]
RUBBER = tg.Material(name="rubber", law=tg.laws.NeoHooke(C10=0.1 * MPa))
FLOOR = tg.obstacles.Plane(point=(0.0, 0.0, -15 * mm), normal=(0.0, 0.0, 1.0))


def bar(size: float) -> tg.Mesh:
    """A bar of 60 mm with the ends ``fixed`` and ``tip``."""
    mesh = tg.mesh(tg.bodies.Block(width=10 * mm, height=10 * mm, length=60 * mm).build(), size=size)
    far = (mesh.points[mesh.faces["ends"], 0] > 0).all(axis=1)
    ends = mesh.faces["ends"]
    return replace(mesh, faces={**mesh.faces, "fixed": ends[~far], "tip": ends[far]})


def bent(mesh: tg.Mesh, floor: bool = False) -> tg.Model:
    """A bar that traction on its tip bends by about a quarter turn, or onto a floor."""
    floors = [tg.obstacles.Obstacle(name="floor", shape=FLOOR)] if floor else []
    return tg.Model(
        mesh,
        materials={"body": RUBBER},
        supports=[tg.Fixed("fixed")],
        loads=[tg.Traction("tip", (0.0, 0.0, -3 * kPa))],
        contact=tg.Contact(self_contact=False, obstacles=floors),
    )


@pytest.fixture(scope="module")
def coarse() -> tg.Mesh:
    return bar(10 * mm)


@pytest.fixture(scope="module")
def fine() -> tg.Model:
    return bent(bar(5 * mm))


@pytest.fixture(scope="module")
def led(fine: tg.Model, coarse: tg.Mesh) -> tg.Solution:
    return tg.solve(fine, ASKED, coarse=coarse)


def moves(solution: tg.Solution) -> np.ndarray:
    """Displacements at the load factors asked for."""
    found = {state.load_factor: state.displacement for state in solution.states}
    return np.stack([found[factor] for factor in (*AT, 1.0)])


@pytest.mark.parametrize("floor", [False, True], ids=["free", "onto a floor"])
def test_states_are_those_of_the_fine_mesh_alone(
    fine: tg.Model, coarse: tg.Mesh, floor: bool, record_verification: Callable[..., None]
) -> None:
    model = bent(fine.mesh, floor)
    alone, two = tg.solve(model, ASKED), tg.solve(model, ASKED, coarse=coarse)
    largest = np.abs(moves(alone)).max()
    assert (alone.states[-1].touches["floor"].area > 0) if floor else largest > 20 * mm
    assert [state.load_factor for state in two.states] == [0.0, *AT, 1.0]
    assert two.coarse is not None
    assert {0.0, *AT, 1.0} <= {state.load_factor for state in two.coarse.states}
    record_verification(
        claim=f"bent bar {'onto a floor' if floor else 'in the air'}, led by a coarse mesh: largest displacement [mm]",
        source="the path on the fine mesh alone",
        expected=float(largest) / mm,
        got=float(np.abs(moves(two)).max()) / mm,
        tolerance="1e-5, the tolerance of both",
    )
    assert np.abs(moves(two) - moves(alone)).max() < 1e-5 * largest
    assert two.iterations < alone.iterations
    assert f"The path on a coarse mesh of {coarse.unknown_count:,} unknowns led in" in two.message


@pytest.mark.parametrize(("steps", "between_walls"), [(10, False), (4, True)], ids=["short", "long"])
def test_between_walls_that_touch_it_leads_long_steps_only(
    fine: tg.Model, coarse: tg.Mesh, monkeypatch: pytest.MonkeyPatch, steps: int, between_walls: bool
) -> None:
    """In short ones the tangent of the path does better."""
    led, at = [], Guide.at
    monkeypatch.setattr(Guide, "at", lambda self, load: led.append(load) or at(self, load))
    factors = tuple((i + 1) / steps for i in range(steps - 1))
    found = tg.solve(bent(fine.mesh, floor=True), tg.Static(at=factors, max_step=1.0), coarse=coarse)
    meets = next(each.load_factor for each in found.states if each.touches["floor"].area > 0)
    assert 0 < meets < 0.7
    assert max(led) == (1.0 if between_walls else meets)


def test_time_and_factorizations_are_those_of_both_meshes(led: tg.Solution) -> None:
    assert led.coarse is not None
    assert led.timing.factorizations > led.coarse.timing.factorizations > 0
    assert led.timing.total > led.coarse.timing.total


def test_the_difference_of_the_meshes_is_the_mesh_error(led: tg.Solution, coarse: tg.Mesh) -> None:
    """The estimate is at least the error against a much finer mesh, and not much more; no state is found again."""
    assert estimate_mesh_error(led, TIP).unknowns == coarse.unknown_count
    response = tg.measure(led, "tip_displacement")
    truth = tg.measure(tg.solve(bent(bar(2.5 * mm)), ASKED), "tip_displacement", mesh_error=False)
    by_load = dict(zip(truth.column("load_factor"), truth.column("tip_displacement"), strict=True))
    estimates = response.mesh_error("tip_displacement")
    assert estimates is not None
    for load in (*AT, 1.0):
        number = list(response.column("load_factor")).index(load)
        error = abs(response.column("tip_displacement")[number] - by_load[load])
        assert error < estimates[number] < 12 * error


def test_a_mesh_that_is_hardly_coarser_says_nothing_about_the_error(fine: tg.Model) -> None:
    near = bar(5.5 * mm)
    assert 1 < fine.mesh.unknown_count / near.unknown_count < 1.7
    solution = tg.solve(fine, ASKED, coarse=near)
    assert estimate_mesh_error(solution, TIP).unknowns > fine.mesh.unknown_count


def test_a_coarse_mesh_that_leads_astray_is_left(fine: tg.Model, coarse: tg.Mesh) -> None:
    """The coarse bar is a third as thick and bends much farther; few iterations do not lead back."""
    thin = replace(coarse, points=coarse.points * (1.0, 1.0, 0.3))
    found = tg.solve(fine, replace(ASKED, max_iterations=3), coarse=thin)
    assert "the guide led astray; steps went on without it" in found.message
    assert np.abs(moves(found) - moves(tg.solve(fine, ASKED))).max() < 1e-6


def test_a_coarse_path_that_ends_early_leads_as_far_as_it_goes(
    fine: tg.Model, coarse: tg.Mesh, monkeypatch: pytest.MonkeyPatch
) -> None:
    asked = solving.on_coarse_mesh
    monkeypatch.setattr(solving, "on_coarse_mesh", lambda each: _few_steps(asked(each)))
    found = tg.solve(fine, ASKED, coarse=coarse)
    assert "up to load factor 0.5, where it ended" in found.message
    assert found.converged
    assert np.abs(moves(found) - moves(tg.solve(fine, ASKED))).max() < 1e-6


def _few_steps(question: solving.Question) -> solving.Question:
    return replace(question, procedure=replace(question.procedure, max_steps=4))


@pytest.mark.parametrize("on_fine", [False, True], ids=["on the coarse mesh", "on the fine mesh"])
def test_a_run_that_was_ended_goes_on_from_there(
    fine: tg.Model, coarse: tg.Mesh, led: tg.Solution, on_fine: bool, tmp_path: Path
) -> None:
    heard: list[float] = []

    def kill(iteration: Iteration, state: object) -> None:  # only states on the fine mesh are told
        if iteration.load_factor >= 0.6 and on_fine == (state is not None):
            raise RuntimeError("killed")

    with pytest.raises(RuntimeError):
        tg.solve(fine, ASKED, coarse=coarse, folder=tmp_path / "path", progress=kill)
    resumed = tg.resume(tmp_path / "path", progress=lambda each, _: heard.append(each.load_factor))
    assert heard[0] > 0.5
    assert resumed.message == led.message
    assert np.array_equal(moves(resumed), moves(led))


def test_coarse_meshes_that_cannot_lead_are_refused(fine: tg.Model, coarse: tg.Mesh, led: tg.Solution) -> None:
    with pytest.raises(tg.TurgorError, match="coarse is '6 mm'; allowed is a Mesh"):
        tg.solve(fine, coarse="6 mm")  # type: ignore[arg-type]
    with pytest.raises(tg.TurgorError, match="it must have fewer"):
        tg.solve(bent(coarse), coarse=fine.mesh)
    with pytest.raises(tg.TurgorError, match="coarse is a mesh of another body: its corners are off by"):
        tg.solve(fine, coarse=replace(coarse, points=2.0 * coarse.points))
    with pytest.raises(tg.TurgorError, match=r"coarse leads the steps of Static .* is ArcLength"):
        tg.solve(fine, tg.ArcLength(), coarse=coarse)
    with pytest.raises(tg.TurgorError, match="guide and coarse are both given"):
        tg.solve(fine, coarse=coarse, guide=led)
