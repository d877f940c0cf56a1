"""A block that only contact holds comes to rest under `Stabilized`, on a floor, where a plate pushes it along.

Problem: a block of rubber, 10 × 10 × 5 mm, without supports, on a floor or 0.2 mm above it; its weight grows and stays,
then a plate that stands 0.5 mm beside it moves by 1.5 mm and pushes it, with Coulomb friction of 0.4 or none.
Exact: the floor bears the weight m g, and the plate pushes with 0.4 m g; the block moves by 1 mm; friction takes
0.4 m g times the way.
Source: statics. Tolerance: 1e-5 for the weight; 0.5 % for the push, since points at rest bear any force up to the
limit; 2 % for what friction takes.
"""

import numpy as np
import pytest

import contact_cases
import turgor as tg
from problems import MM
from refused import refused
from turgor.core.engine.algebra.tangent import Tangent
from turgor.core.engine.system import System
from turgor.core.model.contact import Contact
from turgor.core.model.obstacles import Obstacle, Plane
from turgor.core.solvers.checks.supports import check_supports, free_motions
from turgor.core.solvers.energies import imbalance, too_viscous
from turgor.core.solvers.problem import Problem

RUBBER = tg.Material(name="rubber", law=tg.laws.NeoHooke(C10=50e3), density=1100.0, bulk_modulus=5e6)
WEIGHT = 1100 * 9.80665 * 10 * 10 * 5 * MM**3
GROWS = ((0, 0), (0.3, 1), (1, 1))
AWAY, PUSHED = (0.0, 0.0, 0.0), (1.5 * MM, 0.0, 0.0)


def block(friction=0.0, gap=0.0, supports=()):
    mesh = contact_cases.block((2, 2, 2))
    floor = Obstacle(name="floor", shape=Plane(point=(0, 0, -gap), normal=(0, 0, 1)), friction=friction)
    path = ((0, AWAY), (0.3, AWAY), (1, PUSHED))
    plate = Obstacle(name="plate", shape=Plane(point=(-0.5 * MM, 0, 0), normal=(1, 0, 0)), path=path)
    contact = Contact(self_contact=False, obstacles=(floor, plate))
    return tg.Model(mesh, {"body": RUBBER}, supports, [tg.Gravity((0, 0, -1), history=GROWS)], contact=contact)


def stabilized(model):
    """States, outcome and number of steps of the procedure."""
    system = System(model, ())
    states, steps = [], []
    problem = Problem(system=system, tangent=Tangent(system, "rslab", 1), states=states, steps=steps)
    outcome = tg.Stabilized().follow(problem)
    return states, outcome, len(steps)


@pytest.mark.parametrize(("friction", "gap"), [(0.4, 0.0), (0.4, 0.2 * MM), (0.0, 0.0)])
def test_a_block_is_pushed_along(friction, gap, record_verification):
    states, outcome, steps = stabilized(block(friction, gap))
    assert outcome.status == "converged", outcome.message
    assert "unstable" not in outcome.message
    assert steps < 60
    last = states[-1]
    assert last.unstable_modes == 0
    floor, plate = (contact_cases.push(last.touches[name]) for name in ("floor", "plate"))
    moved = float(last.displacement[:, 0].mean())
    record_verification(
        claim=f"free block, friction {friction:g}, {gap / MM:g} mm above the floor: what the floor bears, push of the "
        "plate [weights], way [mm]",
        source="statics",
        expected=[1.0, friction, 1.0],
        got=[floor[2] / WEIGHT, plate[0] / WEIGHT, moved / MM],
        tolerance="1e-5, 0.5 %, 0.001",
    )
    assert floor[2] == pytest.approx(WEIGHT, rel=1e-5)
    assert plate[0] == pytest.approx(friction * WEIGHT, rel=5e-3, abs=1e-5 * WEIGHT)
    assert moved == pytest.approx(1 * MM, abs=1e-3 * MM)
    assert last.displacement[:, 2].mean() == pytest.approx(-gap, abs=1e-3 * MM)
    assert np.abs(last.displacement[:, 1].mean()) < 1e-6 * MM
    assert last.energies.lasting == pytest.approx(friction * WEIGHT * moved, rel=0.02, abs=1e-12)
    assert imbalance(states) < 0.01
    (told,) = too_viscous(states)
    assert "slid or fell" in told.advice


def test_a_block_that_only_stands_takes_nothing():
    """The floor bears it from the first step on: what the viscous forces take is nothing to speak of."""
    model = block()
    still = Contact(self_contact=False, obstacles=model.contact.obstacles[:1])
    states, outcome, _ = stabilized(tg.Model(model.mesh, model.materials, [], model.loads, contact=still))
    assert outcome.status == "converged"
    assert too_viscous(states) == ()
    assert states[-1].energies.viscous < 1e-3 * states[-1].energies.strain
    assert contact_cases.push(states[-1].touches["floor"])[2] == pytest.approx(WEIGHT, rel=1e-5)


def test_which_procedures_need_supports():
    model = block()
    alone = tg.Model(model.mesh, model.materials, [], model.loads)
    assert [each.may_be_free(model) for each in (tg.Static(), tg.Stabilized(), tg.Dynamic(duration=1.0))] == [
        False, True, True,
    ]  # fmt: skip
    assert not tg.Stabilized().may_be_free(alone)
    assert [free_motions(block(supports=each)) for each in ((), [tg.Fixed("z0", "z")], [tg.Fixed("z0")])] == [6, 3, 0]
    with refused("6 of 6", "'floor', 'plate'", "stabilized", "dynamic"):
        check_supports(model)
    check_supports(model, inertia=tg.Stabilized().may_be_free(model))


def test_solve_takes_a_block_that_only_contact_holds():
    """In a sequence, too: it is pushed along, then it is left alone."""
    free = tg.Stabilized()
    solution = tg.solve(block(0.4), tg.Stages([tg.Stage("push", free), tg.Stage("wait", free)]))
    pushed, waited = ([s for s in solution.states if s.stage == name][-1] for name in ("push", "wait"))
    assert contact_cases.push(waited.touches["floor"])[2] == pytest.approx(WEIGHT, rel=1e-5)
    assert contact_cases.apart(waited.displacement, pushed.displacement) < 1e-4
    with refused("B01", "'floor', 'plate'"):
        tg.solve(block(0.4), tg.Static())
