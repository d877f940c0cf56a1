"""A row of equal chambers that the path of a shorter one leads: the same states in fewer iterations, or none at all.

The reference is the path of the whole row without a guide, on the same mesh.
"""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import turgor as tg
from turgor.core.engine.algebra.tangent import Tangent
from turgor.core.engine.cells.element import element_of
from turgor.core.engine.system import System
from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
from turgor.core.meshing.sweeping.section import Fineness
from turgor.core.meshing.sweeping.swept import swept_mesh
from turgor.core.solvers import row_guide
from turgor.core.solvers.guide import Guide
from turgor.core.solvers.row_guide import shorter_row
from turgor.units import deg, kPa, mm


@pytest.fixture(scope="module")
def finger() -> tg.Model:
    """Eight chambers of the coarsest cells; nothing else is so soft with so few unknowns."""
    shape = FastPneuNet(chambers=8, length=79 * mm, height=12 * mm, width=16 * mm, base=0.0, floor=2 * mm)
    mesh = replace(swept_mesh(shape.build(), Fineness(size=12 * mm, lines="none")), serendipity=True)
    rubber = tg.Material(name="rubber", law=tg.laws.NeoHooke(C10=30 * kPa))
    return tg.Model(mesh, rubber, supports=["fixed"], loads=[tg.Pressure("cavity", 7 * kPa)])


@pytest.fixture(scope="module")
def alone(finger: tg.Model) -> tg.Solution:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(row_guide, "short_row", lambda mesh: None)
        return tg.solve(finger, tg.Static(at=(0.25, 0.5, 0.75)))


def angles(solution: tg.Solution) -> list[float]:
    return [tg.bending_angle(state) / deg for state in solution.states if state.load_factor in (0.25, 0.5, 0.75, 1.0)]


def test_row_is_led_to_the_states_of_its_own_path(
    finger: tg.Model, alone: tg.Solution, monkeypatch: pytest.MonkeyPatch, record_verification: Callable[..., None]
) -> None:
    """Its walls come near each other and do not meet, so that the test is short; the demo is led where they do."""
    monkeypatch.setattr(row_guide, "_walls_meet", lambda system, tangent: True)
    texts: list[str] = []
    led = tg.solve(finger, options=tg.EngineOptions(notify=texts.append))
    assert [state.load_factor for state in led.states] == [0.0, 0.25, 0.5, 0.75, 1.0]
    record_verification(
        claim="eight chambers without a layer, led by the path of five: bending angle [°]",
        source="the path of the eight",
        expected=angles(alone)[-1],
        got=angles(led)[-1],
        tolerance="5e-5, the tolerance of both in a soft body",
    )
    assert angles(led) == pytest.approx(angles(alone), rel=5e-5)
    assert led.iterations < 0.4 * alone.iterations
    assert any("3 of its equal parts" in text for text in texts)
    assert 0 < led.timing.guide < led.timing.total


def test_run_that_was_ended_is_led_to_its_end(
    finger: tg.Model, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr(row_guide, "_walls_meet", lambda system, tangent: True)
    end = tg.Static(max_step=0.5)

    def kill(_: object, state: tg.solutions.State | None) -> None:
        if state is not None:
            raise RuntimeError("killed")

    with pytest.raises(RuntimeError):
        tg.solve(finger, end, folder=tmp_path / "path", progress=kill)
    resumed, whole = tg.resume(tmp_path / "path"), tg.solve(finger, end)
    assert [step.load_factor for step in resumed.steps] == [0.5, 1.0]
    assert np.array_equal(resumed.states[-1].displacement, whole.states[-1].displacement)


def test_parts_that_do_not_follow_one_motion_do_not_fit(finger: tg.Model) -> None:
    shorter = shorter_row(finger, tg.Static())
    assert shorter is not None
    short = replace(finger, mesh=shorter.mesh)
    placed = row_guide._Placed.of(shorter, finger, short)
    points = shorter.mesh.points
    turn = np.array([[0.0, 0.0, -1.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]])
    moved = tg.solutions.State(
        model=short, load_factor=1.0, displacement=points @ turn.T - points, mean_stress=np.zeros(0), nodal_force=points
    )
    assert placed.fits(moved)
    bulged = moved.displacement.copy()
    bulged[shorter.ends[1][0]] += 0.1 * mm
    assert not placed.fits(replace(moved, displacement=bulged))


def test_states_of_the_short_row_take_the_places_of_the_same_nodes(finger: tg.Model) -> None:
    """A rigid motion is that of the whole row, and mean stresses stay at their corners of a section."""
    shorter = shorter_row(finger, tg.Static())
    assert shorter is not None
    short, whole = replace(finger, mesh=shorter.mesh), finger.mesh
    turn = np.array([[0.8, 0.0, -0.6], [0.0, 1.0, 0.0], [0.6, 0.0, 0.8]])

    def across(mesh: tg.Mesh, numbers: np.ndarray, count: int) -> np.ndarray:
        values = np.zeros(count)
        corners = mesh.points[mesh.cells[:, : numbers.shape[1]]]
        values[numbers] = corners[..., 1] + 2 * corners[..., 2]
        return values

    elements = element_of(short), element_of(finger)
    stress, expected = (across(m, e.mean, e.mean_count) for m, e in zip((shorter.mesh, whole), elements, strict=True))
    points = shorter.mesh.points
    state = tg.solutions.State(
        model=short, load_factor=1.0, displacement=points @ turn.T - points, mean_stress=stress, nodal_force=points
    )
    system = System(finger)
    displacement, mean_stress = system.physical(row_guide._Placed.of(shorter, finger, short).unknowns(system, state))
    assert np.abs(whole.points + displacement - whole.points @ turn.T).max() < 1e-9
    assert np.abs(mean_stress - expected).max() < 1e-9


def test_guide_of_a_row_leads_from_state_to_state_until_one_fails() -> None:
    guide = Guide([0.0, 0.25, 1.0], [np.zeros(3)] * 3, exact=True)
    assert [guide.next_load(now, now + 0.1) for now in (0.0, 0.1, 0.25)] == [0.25, 0.25, 1.0]
    assert not guide.misleads(0)
    assert guide.misleads(1)
    assert replace(guide, exact=False).next_load(0.0, 0.1) == 0.1


def test_walls_that_hardly_meet_are_not_worth_a_guide(finger: tg.Model) -> None:
    shorter = shorter_row(finger, tg.Static())
    assert shorter is not None
    results = []
    for pressure in (1 * kPa, 40 * kPa):
        system = System(replace(finger, mesh=shorter.mesh, loads=[tg.Pressure("cavity", pressure)]))
        results.append(row_guide._walls_meet(system, Tangent(system, "rslab", 1)))
    assert results == [False, True]


def test_only_pressure_and_few_loads_are_led(finger: tg.Model) -> None:
    assert shorter_row(finger, tg.Static()) is not None
    assert shorter_row(finger, tg.Static(max_step=0.1)) is None
    assert shorter_row(finger, tg.Static(duration=2.0)) is None
    assert shorter_row(replace(finger, contact=tg.Contact(self_contact=False)), tg.Static()) is None
    pulled = replace(finger, loads=[*finger.loads, tg.loads.Force("tip", (0.0, 0.0, -0.1))])
    assert shorter_row(pulled, tg.Static()) is None
    falling = replace(finger, loads=[tg.Pressure("cavity", 7 * kPa, history=[(0, 0), (0.5, 1), (1, 0.5)])])
    assert shorter_row(falling, tg.Static()) is None
