"""Obstacles turn: friction goes with their surface.

Problem 1: the base of a block is pushed up against a plate and sideways, with friction, then base and plate turn
together by 6° about an oblique axis. Exact: the force on the plate turns with them (frame indifference). Tolerance:
1e-6, the tolerance of the steps.

Problem 2: a bar pressed into a block turns about its axis until all of it slides. Exact: every point rubs at the radius
R with µ times its pressure, so the moment is µ R P, where P is the sum of what presses at all points; the work on the
bar in a step is the mean moment times the angle. Tolerance: 2 %, because P is read off the force, in which pressures on
an arc of half a radian add up to 1 % less; 1e-9 for the work. A bar that rolls, moved by R times its angle, pulls with
less than a twentieth of that.
"""

from dataclasses import replace

import numpy as np
import pytest

import contact_cases
import problems
import turgor as tg
from problems import MM
from turgor.core.geometry.directions import rotation_of
from turgor.core.model.obstacles import Box, Cylinder, Obstacle, Plane
from turgor.core.results.fields.contact import contact_force, contact_moment
from turgor.core.results.fields.state_fields import StateFields
from turgor.core.results.measures.work.outside import outside_works

FRICTION, STIFFNESS = 0.5, 1e10
CORNER = np.array([2.0, -3.0, 1.0]) * MM
TURN = np.deg2rad(6) * np.array([2.0, 1.0, 2.0]) / 3
PLATES = {
    "plane": Plane(point=(0, 0, 3 * MM), normal=(0, 0, -1)),
    "box": Box(center=(5 * MM, 5 * MM, 13 * MM), size=(30 * MM, 30 * MM, 20 * MM)),
    "triangles": contact_cases.slab(40, 3),
}
STEPS = tg.Static(first_step=0.1, max_step=0.1)
RADIUS, TOP = 4 * MM, 3 * MM


def _carried(points, load_factor):
    """Up and sideways until load factor 0.5, then round."""
    pushed = points + min(2 * load_factor, 1.0) * np.array([0.6, 0.3, 0.1]) * MM
    turn = rotation_of(max(2 * load_factor - 1, 0.0) * TURN)
    return (pushed - CORNER) @ turn.T + CORNER - points


@pytest.mark.parametrize("name", PLATES)
def test_force_turns_with_body_and_obstacle(name, record_verification):
    rotation = [(0, (0, 0, 0)), (0.5, (0, 0, 0)), (1, tuple(TURN))]
    plate = Obstacle(
        name="plate", shape=PLATES[name], friction=FRICTION, rotation=rotation, about=CORNER, stiffness=STIFFNESS
    )
    mesh = contact_cases.block((2, 2, 1), (10, 10, 3))
    model = tg.Model(
        mesh, {"body": problems.rubber(problems.NEO_HOOKE)}, [tg.Displacement("z0", _carried)], [],
        contact=tg.Contact(False, [plate]),
    )  # fmt: skip
    states = problems.solve(model, tg.Static(first_step=0.25, max_step=0.25, tolerance=1e-8)).states
    before, after = (contact_cases.push(states[i].touches["plate"]) for i in (2, -1))
    assert states[2].load_factor == 0.5
    assert np.hypot(*before[:2]) > 0.1 * abs(before[2])  # friction acts
    error = contact_cases.apart(rotation_of(TURN) @ before, after)
    record_verification(
        claim=f"block and {name} that turn together by 6°, with friction: force in the turned frame, relative",
        source="frame indifference, exact",
        expected=0.0,
        got=error,
        tolerance="1e-6",
    )
    assert error < 1e-6


def _bar(rolls: float, procedure=STEPS, density=None, cells=(10, 1, 2)):
    """A bar pressed into a block by 0.15 mm, then turned by 0.15 rad, and moved by a share of its way."""
    down, angle = -0.15 * MM, 0.15
    path = [(0, (0, 0, 0)), (0.3, (0, 0, down)), (1, (rolls * RADIUS * angle, 0, down))]
    rotation = [(0, (0, 0, 0)), (0.3, (0, 0, 0)), (1, (0, angle, 0))]
    shape = Cylinder(center=(5 * MM, 2 * MM, TOP + RADIUS), axis=(0, 1, 0), radius=RADIUS)
    bar = Obstacle(name="bar", shape=shape, friction=FRICTION, path=path, rotation=rotation)
    model = contact_cases.standing(contact_cases.block(cells, (10, 4, 3)), bar)
    if density is not None:
        model = replace(model, materials={"body": problems.rubber(problems.NEO_HOOKE, density=density)})
    return problems.solve(model, procedure).states


@pytest.fixture(scope="module")
def turning():
    return _bar(0.0)


def test_turning_bar_pulls_with_the_friction_of_what_presses_it(turning, record_verification):
    at = StateFields(turning[-1])
    force, moment = contact_force(at, "bar"), contact_moment(at, "bar")
    pressing = np.linalg.norm(force) / np.hypot(1, FRICTION)
    record_verification(
        claim="bar that turns on a block, µ = 0.5: its moment over µ R P",
        source="Coulomb's law, exact",
        expected=1.0,
        got=-moment[1] / (FRICTION * RADIUS * pressing),
        tolerance="2 %",
    )
    assert -moment[1] == pytest.approx(FRICTION * RADIUS * pressing, rel=0.02)
    assert moment[[0, 2]] == pytest.approx([0, 0], abs=1e-3 * abs(moment[1]))


def test_work_on_a_turning_bar_is_moment_times_angle(turning):
    path = [StateFields(state) for state in turning]
    work = np.diff(outside_works(path))[-1]
    moments = [contact_moment(at, "bar")[1] for at in path[-2:]]
    angle = 0.15 / 0.7 * (turning[-1].load_factor - turning[-2].load_factor)
    assert work == pytest.approx(np.mean(moments) * angle, rel=1e-9)
    assert tg.measures.moment_on("bar").function(path[-1]) == pytest.approx(abs(moments[-1]), rel=1e-3)


def test_rolling_bar_hardly_pulls(turning):
    slides, rolls = (contact_force(StateFields(states[-1]), "bar") for states in (turning, _bar(1.0)))
    assert abs(rolls[0] / rolls[2]) < 0.05 * abs(slides[0] / slides[2])


def test_work_of_a_turning_bar_is_in_the_energy_balance():
    """Of what a slowly turning bar does, friction dissipates most, and at most a hundredth is missing."""
    states = _bar(0.0, tg.Dynamic(duration=1.0, accuracy=0.05), 1000.0, (5, 1, 1))
    energies = states[-1].energies
    assert energies.dissipated > 0.3 * energies.work
    assert abs(energies.missing) < 0.01 * energies.work
