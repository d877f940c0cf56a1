"""A path that a similar one guides: the same states in fewer iterations, and what happens where the guide leads astray.

The guide decides where Newton's method starts, not where it ends: guided states are those of the unguided path to the
tolerance of both. The reference is therefore the unguided path on the same mesh.
"""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import turgor as tg
from refused import refused
from turgor.units import MPa, kPa, mm

AT = (0.25, 0.5, 0.75)
FLOOR = tg.obstacles.Plane(point=(0.0, 0.0, -0.1), normal=(0.0, 0.0, 1.0))
ASKED = tg.Static(at=AT, max_step=1.0)


def rubber(C10: float) -> tg.Material:
    return tg.Material(name="rubber", law=tg.laws.NeoHooke(C10=C10))


def cantilever(size: float, C10: float = 0.1 * MPa, pull: float = 3 * kPa) -> tg.Model:
    """A block that traction on its far end bends by about a quarter turn."""
    bar = tg.bodies.Block(width=10 * mm, height=10 * mm, length=60 * mm).build()
    mesh = tg.mesh(bar, size=size)
    fixed = mesh.faces["ends"][(mesh.points[mesh.faces["ends"], 0] < 0).all(axis=1)]
    end = mesh.faces["ends"][(mesh.points[mesh.faces["ends"], 0] > 0).all(axis=1)]
    mesh = replace(mesh, faces={**mesh.faces, "fixed": fixed, "end": end})
    return tg.Model(
        mesh,
        materials={"body": rubber(C10)},
        supports=[tg.Fixed("fixed")],
        loads=[tg.Traction("end", (0.0, 0.0, -pull))],
        contact=tg.Contact(self_contact=False),
    )


@pytest.fixture(scope="module")
def similar() -> tg.Solution:
    return tg.solve(cantilever(10 * mm))


def moves(solution: tg.Solution) -> np.ndarray:
    """Displacements at the load factors asked for."""
    results = {state.load_factor: state.displacement for state in solution.states}
    return np.stack([results[factor] for factor in (*AT, 1.0)])


def test_a_guided_path_has_the_requested_states_in_fewer_iterations(
    similar: tg.Solution, record_verification: Callable[..., None]
) -> None:
    model = cantilever(10 * mm, C10=0.11 * MPa)
    alone = tg.solve(model, tg.Static(at=AT))
    guided = tg.solve(model, ASKED, guide=similar)
    assert [state.load_factor for state in guided.states] == [0.0, *AT, 1.0]
    largest = np.abs(moves(alone)).max()
    assert largest > 20 * mm
    ends = [float(np.abs(each[-1]).max()) / mm for each in (moves(alone), moves(guided))]
    record_verification(
        claim=f"bent block of {len(model.mesh.cells)} cells, guided: largest displacement [mm]",
        source="the unguided path",
        expected=ends[0],
        got=ends[1],
        tolerance="1e-5, the tolerance of both",
    )
    assert np.abs(moves(guided) - moves(alone)).max() < 1e-5 * largest
    assert guided.iterations < alone.iterations


def test_one_step_of_an_even_expansion_is_guided_to_its_end(similar: tg.Solution) -> None:
    """Where only the last state is asked for, one step goes there; without a guide it takes many."""
    model = cantilever(10 * mm, C10=0.11 * MPa)
    end = tg.Static(max_step=1.0)
    guided = tg.solve(model, end, guide=similar)
    assert len(guided.states) == 2
    assert guided.iterations < 0.5 * tg.solve(model, end).iterations


def test_a_guide_that_leads_astray_is_left_and_the_message_says_where(similar: tg.Solution) -> None:
    """The guide bends the other way, and few iterations do not lead back."""
    turned = tuple(replace(state, displacement=-8.0 * state.displacement) for state in similar.states)
    model = cantilever(10 * mm)
    result = tg.solve(model, tg.Static(at=AT, max_step=1.0, max_iterations=4), guide=replace(similar, states=turned))
    assert "the guide predicted wrongly; steps went on without it" in result.message
    assert np.abs(moves(result) - moves(tg.solve(model, tg.Static(at=AT)))).max() < 1e-6
    assert "astray" not in tg.solve(model, ASKED, guide=similar).message


def test_a_guided_run_that_was_ended_goes_on_with_its_guide(similar: tg.Solution, tmp_path: Path) -> None:
    model = cantilever(10 * mm, C10=0.11 * MPa)
    whole = tg.solve(model, ASKED, guide=similar)

    def kill(_: object, state: tg.solutions.State | None) -> None:
        if state is not None and state.load_factor >= 0.5:
            raise RuntimeError("killed")

    with pytest.raises(RuntimeError):
        tg.solve(model, ASKED, guide=similar, folder=tmp_path / "path", progress=kill)
    resumed = tg.resume(tmp_path / "path")
    assert resumed.iterations == whole.iterations
    assert np.array_equal(moves(resumed), moves(whole))


@pytest.mark.parametrize(("procedure", "fact"), [(tg.ArcLength(), "ArcLength"), (tg.Static(duration=2.0), "2 s")])
def test_procedures_that_no_guide_leads_are_refused(procedure: object, fact: str, similar: tg.Solution) -> None:
    with refused("Static", fact):
        tg.solve(cantilever(10 * mm), procedure, guide=similar)


def test_guides_of_other_bodies_and_models_with_a_memory_are_refused(similar: tg.Solution) -> None:
    model = cantilever(10 * mm)
    with refused("guide", "'folder'", "Solution"):
        tg.solve(model, guide="folder")  # type: ignore[arg-type]
    with refused("guide", 36, 998):
        tg.solve(cantilever(6 * mm), guide=similar)
    large = replace(model, mesh=replace(model.mesh, points=2.0 * model.mesh.points))
    with refused("guide", "25%", "20%"):
        tg.solve(large, guide=similar)
    rubs = replace(
        model, contact=tg.Contact(obstacles=[tg.obstacles.Obstacle(name="floor", shape=FLOOR, friction=0.5)])
    )
    with refused("guide", "friction 0.5"):
        tg.solve(rubs, guide=similar)
    smooth = replace(model, contact=tg.Contact(obstacles=[tg.obstacles.Obstacle(name="floor", shape=FLOOR)]))
    with refused("guide", "'floor'"):
        tg.solve(smooth, guide=similar)
