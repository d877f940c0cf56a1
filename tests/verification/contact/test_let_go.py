"""V16: contact that opens and closes in turn does not stop a run, and friction has a consistent tangent.

Problem: a block of 10 × 10 × 5 mm, clamped below, under a plate with µ = 0.5 (and 0.3) that comes down by 1 mm and then
moves sideways by 4 mm: its edge rolls over, points let go, stick and slip, and the pull falls at once where the edge
does. All settings are the defaults. A bellows whose fold closes under vacuum.
Exact: the full load is reached; the pull is never more than µ times the push; the end is that of many small steps;
Newton's method has the order 2. Source: Coulomb's law. Tolerance: 1e-3 for the law, 1 % for the end, 1.8 for the order.
"""

import numpy as np
import pytest
from scipy.sparse.linalg import splu

import contact_cases
import problems
import turgor as tg
from problems import MM
from turgor.core.engine.algebra.tangent import Tangent
from turgor.core.engine.system import System
from turgor.core.model.obstacles import Obstacle, Plane, Sphere
from turgor.core.solvers.constraints.loads import load_control
from turgor.core.solvers.listeners import silent
from turgor.core.solvers.newton.contact_newton import newton_with_contact
from turgor.core.solvers.newton.inertia_correction import inertia_corrected
from turgor.core.solvers.newton.newton_values import NewtonSettings, Start
from turgor.core.solvers.step_reasons import Cause

PATH = ((0, (0, 0, 0)), (0.3, (0, 0, -1 * MM)), (1, (4 * MM, 0, -1 * MM)))
TOP = Plane(point=(0, 0, 5 * MM), normal=(0, 0, -1))
BALL = Sphere(center=(4 * MM, 5 * MM, 9.5 * MM), radius=5 * MM)


def _dragged(friction, procedure=None):
    plate = Obstacle(name="plate", shape=TOP, path=PATH, friction=friction)
    return tg.solve(contact_cases.standing(contact_cases.block(), plate), procedure, throw=False)


def _pull_and_push(state):
    x, y, z = contact_cases.push(state.touches["plate"])
    return float(np.hypot(x, y)), -float(z)


@pytest.fixture(scope="module")
def dragged():
    return _dragged(0.5)


@pytest.mark.parametrize("friction", [0.3, 0.5])
def test_a_plate_that_drags(friction, dragged, record_verification):
    solution = dragged if friction == 0.5 else _dragged(friction)
    assert solution.complete, solution.message
    pulls, pushes = np.array([_pull_and_push(state) for state in solution.states[1:]]).T
    record_verification(
        claim=f"plate dragged over a block whose edge rolls over, µ = {friction}: most of pull over push",
        source="V16, Coulomb's law",
        expected=friction,
        got=float((pulls / pushes).max()),
        tolerance="no more, 1e-3",
    )
    assert (pulls <= friction * pushes * 1.001).all()
    assert max(state.touches["plate"].share for state in solution.states) < 1 + 1e-6
    held = problems.reaction(solution.states[-1], "z0")
    assert contact_cases.apart(held, -contact_cases.push(solution.states[-1].touches["plate"])) < 1e-4


def test_few_iterations_and_some_found_by_inertia_correction(dragged):
    assert any(step.cause is Cause.INERTIA_CORRECTED for step in dragged.steps if step.accepted)
    assert "slipped or snapped to another equilibrium close by" in dragged.message
    assert 0.3 in [state.load_factor for state in dragged.states]  # where the path of the plate turns
    assert dragged.iterations < 400


def test_small_steps_end_the_same(dragged, record_verification):
    fine = _dragged(0.5, tg.Static(max_step=0.02))
    got, expected = (contact_cases.push(each.states[-1].touches["plate"]) for each in (dragged, fine))
    record_verification(
        claim="plate dragged over a block whose edge rolls over: force at the end by long steps against short ones",
        source="V16, small steps",
        expected=0.0,
        got=contact_cases.apart(got, expected),
        tolerance="1 %",
    )
    assert len(fine.steps) > 2 * len(dragged.steps)
    assert contact_cases.apart(got, expected) < 0.01


def _rubbing(friction=0.4):
    """A ball pressed into a block, unknowns in which all points slide, and the history from which they do."""
    system = System(
        contact_cases.standing(
            contact_cases.block((2, 2, 1)), contact_cases.pushed(BALL, friction=friction, stiffness=1e9)
        )
    )
    unknowns = np.zeros(system.size)
    history = system.history(system.remembered(system.evaluate(unknowns, 1.0)))
    moved = unknowns.copy()
    moved[0 : 3 * system.node_count : 3] += np.where(
        system.prescribed[0 : 3 * system.node_count : 3], 0.0, 0.3 * MM / system.length
    )
    return system, moved, history


def test_solutions_contain_friction():
    """The factors are those of the symmetric part; what is solved is the whole."""
    system, unknowns, history = _rubbing()
    at, free = system.evaluate(unknowns, 1.0, history=history), np.flatnonzero(~system.prescribed)
    tangent = Tangent(system, "rslab", 1)
    tangent.factor(at)
    whole = system.tangent(unknowns, 1.0, history)[free][:, free]
    assert abs(whole - whole.T).max() > 0.01
    right = np.where(system.prescribed, 0.0, np.random.default_rng(3).normal(size=system.size))
    off = whole @ tangent.solve(right)[free] - right[free]
    assert np.linalg.norm(off) < 1e-3 * np.linalg.norm(right)


def _slid():
    """A ball pressed into a block and moved on sideways, unknowns near the equilibrium, and the history of the step."""
    path = ((0, (0, 0, 0)), (0.5, (0, 0, -0.5 * MM)), (1, (0.3 * MM, 0, -0.5 * MM)))
    ball = Obstacle(name="ball", shape=BALL, path=path, friction=0.4, stiffness=1e9)
    system = System(contact_cases.standing(contact_cases.block((2, 2, 1)), ball))
    tangent, x, history = Tangent(system, "rslab", 1), np.zeros(system.size), system.history()
    for factor in (0.25, 0.5, 0.75, 1.0):
        start = Start(x, system.stresses(system.evaluate(x, factor)))
        step = load_control(system, history=history)
        result = newton_with_contact(step, tangent, start, factor, NewtonSettings(), silent)
        assert result.converged
        x = result.evaluation.unknowns
        if factor < 1:
            history = system.history(system.remembered(result.evaluation))
    x = x.copy()
    bump = np.random.default_rng(4).normal(0, 1e-4, 3 * system.node_count)
    x[: len(bump)] += np.where(system.prescribed[: len(bump)], 0.0, bump)
    return system, x, history


def test_newton_is_quadratic_with_friction(record_verification):
    system, x, history = _slid()
    free, norms = np.flatnonzero(~system.prescribed), []
    for _ in range(8):
        residual = system.residual(x, 1.0, history)[free]
        norms.append(float(np.linalg.norm(residual)))
        x[free] -= splu(system.tangent(x, 1.0, history)[free][:, free].tocsc()).solve(residual)
    norms = np.array(norms)
    last = norms[norms > 1e-11 * norms[0]][-3:]
    order = float(np.log(last[2] / last[1]) / np.log(last[1] / last[0]))
    record_verification(
        claim="Newton's method with friction that slides: order from the last residuals",
        source="V24, quadratic",
        expected=2.0,
        got=order,
        tolerance="1.8 or more",
    )
    assert norms[-1] < 1e-10 * norms[0]
    assert order >= 1.8


def _fallen(system, unknowns, history=None):
    step, tangent = load_control(system, history=history), Tangent(system, "rslab", 1)
    return inertia_corrected(step, tangent, unknowns, 1.0, NewtonSettings(), silent)


def test_inertia_correction_ends_stable_and_leaves_friction_as_it_was():
    system, unknowns, history = _rubbing()
    result = _fallen(system, unknowns, history)
    assert result.converged
    assert result.unstable_modes == 0
    assert [each.friction for each in result.evaluation.contacts.gaps] == list(history.friction)
    assert result.evaluation.history is history


def test_inertia_correction_needs_contact_and_stays_near():
    """Nothing is found without contact, nor where the plate lies 2.6 mm deep, farther than half an edge of 5 mm."""
    far = contact_cases.pushed(Plane(point=(0, 0, 6 * MM), normal=(0, 0, -1)))
    system = System(contact_cases.standing(contact_cases.block((2, 2, 1)), far))
    assert not _fallen(system, np.zeros(system.size)).converged
    deep = contact_cases.pushed(Plane(point=(0, 0, 2.4 * MM), normal=(0, 0, -1)), stiffness=1e10)
    system = System(contact_cases.standing(contact_cases.block((2, 2, 1)), deep))
    assert not _fallen(system, np.zeros(system.size)).converged


@pytest.mark.slow
def test_a_fold_closes_under_vacuum(record_verification):
    mesh = tg.mesh(tg.actuators.BellowsOfRevolution(folds=1).build(), size=6 * MM, cells="hexahedra")
    rubber = tg.Material(name="rubber", law=tg.laws.NeoHooke(C10=0.12e6), density=1100.0)
    model = tg.Model(mesh, dict.fromkeys(mesh.regions, rubber), [tg.Fixed("fixed")], [tg.Pressure("cavity", -6e3)])
    solution = tg.solve(model, throw=False)
    record_verification(
        claim="bellows under vacuum whose fold closes: iterations",
        source="V16",
        expected=0,
        got=solution.iterations,
        tolerance="at most 110",
    )
    assert solution.complete, solution.message
    assert solution.iterations <= 110
    assert all(touch.share < 1.05 for state in solution.states for touch in state.touches.values())
