"""Steps of load control in which walls meet."""

from collections.abc import Callable

import numpy as np
import pytest

import contact_cases
import turgor as tg
from turgor.core.engine.system import System
from turgor.core.solvers.continuation import load_control
from turgor.core.solvers.continuation.path_points import unknowns_between
from turgor.core.solvers.continuation.path_run import Point
from turgor.core.solvers.continuation.predictor import gentle_share, predicted
from turgor.core.solvers.restart import unknowns_of
from turgor.units import kPa, mm

#: Pressure of a load factor of 1, shortly before the walls meet, and a load factor at which a line through the last two
#: states has brought them far through each other.
FULL, BEYOND = 7.5 * kPa, 2.0

#: Pressure of a load factor of 1 beyond the touch, and two load factors close to each other at which walls touch.
HARDER, TOUCHING, NEXT = 12 * kPa, 0.9, 0.91


def finger(pressure: float) -> tg.Model:
    """A fast PneuNet of three chambers, half of it."""
    rubber = tg.from_library("elastosil-m4601", record="yeoh-mosadegh-2014")
    return tg.Model(
        tg.mesh(tg.FastPneuNet(chambers=3, length=30 * mm).build(), size=4 * mm),
        materials={"body": rubber, "base": rubber},
        supports=[tg.Fixed("fixed")],
        loads=[tg.Pressure("cavity", pressure)],
    )


def block_under_a_ball() -> tg.Model:
    """A block that a ball of stone is pressed into."""
    ball = tg.obstacles.Sphere(center=(5 * mm, 5 * mm, 9 * mm), radius=4 * mm)
    return contact_cases.standing(contact_cases.block((3, 3, 2)), contact_cases.pushed(ball, (0.0, 0.0, -1.2)))


@pytest.fixture(scope="module")
def path() -> tuple[System, list[Point]]:
    """A finger, and its path until shortly before the walls meet."""
    model = finger(FULL)
    solution = tg.solve(model)
    system, states = System(model), solution.states
    first = system.evaluate(unknowns_of(system, states[-1]), 1.0)  # searches for what may touch
    assert first is not None
    points = [
        Point(s.load_factor, unknowns_of(system, s), first.unknowns[:0], None, None, None, s)  # type: ignore[arg-type]
        for s in states[-2:]
    ]
    return system, points


def test_a_step_far_beyond_the_touch_is_shortened_to_just_beyond_it(path: tuple[System, list[Point]]) -> None:
    system, points = path
    last = points[-1]
    share = gentle_share(system, points, BEYOND)
    assert 0.05 < share < 0.6
    gently = last.parameter + share * (BEYOND - last.parameter)
    there = [system.contacts(unknowns_between(points, load), load).touch for load in (gently - 0.15, gently)]
    assert there == [False, True]


def test_a_step_that_brings_no_wall_to_another_is_taken_whole(path: tuple[System, list[Point]]) -> None:
    system, points = path
    assert gentle_share(system, points, points[-1].parameter + 0.02) == 1.0
    assert gentle_share(system, points[:1], BEYOND) == 1.0  # nothing to extrapolate


@pytest.mark.parametrize(
    ("model", "off"),
    [(lambda: finger(HARDER), 0.02), (block_under_a_ball, 0.1)],  # the factors are those of an earlier iterate
    ids=["walls", "a moving obstacle"],
)
def test_what_touches_moves_on_along_the_tangent(
    model: Callable[[], tg.Model], off: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    starts = {}

    def noted(constraint, tangent, history, parameter, how):  # type: ignore[no-untyped-def]
        starts[parameter] = history[-1], predicted(constraint, tangent, history, parameter, how)
        return starts[parameter][1]

    monkeypatch.setattr(load_control, "predicted", noted)
    solution = tg.solve(model(), tg.Static(at=(TOUCHING, NEXT)))
    system = System(solution.model)
    there = next(unknowns_of(system, state) for state in solution.states if state.load_factor == NEXT)
    last, start = starts[NEXT]
    assert last.parameter == TOUCHING
    along = last.unknowns + (NEXT - TOUCHING) * last.change
    assert np.allclose(start.unknowns, along, rtol=0, atol=1e-12)
    moved = np.linalg.norm((there - last.unknowns)[system.moving])
    assert np.linalg.norm((along - there)[system.moving]) < off * moved
    assert start.evaluation is not None and start.evaluation.contacts.touch_as(system.contacts(there, NEXT))


def test_an_obstacle_that_reaches_a_body_cuts_no_step() -> None:
    ball = tg.obstacles.Sphere(center=(5 * mm, 5 * mm, 9.235 * mm), radius=4 * mm)
    model = contact_cases.standing(contact_cases.block((3, 3, 2)), contact_cases.pushed(ball, (0.0, 0.0, -1.2)))
    steps = tg.solve(model, tg.Static(first_step=0.2, max_step=0.2)).steps
    assert [step.load_factor for step in steps] == pytest.approx([0.2, 0.4, 0.6, 0.8, 1.0])
