"""Reasons of rejected steps, load control without a scalar, and what acts in a state."""

from dataclasses import fields

import numpy as np
import pytest
from solver_cases import bar, model

from refused import refused
from turgor.core.engine.algebra.tangent import Tangent
from turgor.core.engine.system import System
from turgor.core.model.loads import Pressure
from turgor.core.model.model import Model
from turgor.core.solvers.constraints.loads import load_control
from turgor.core.solvers.listeners import silent
from turgor.core.solvers.newton.newton import newton
from turgor.core.solvers.newton.newton_values import NewtonSettings, Start
from turgor.core.solvers.procedures.gas_mass import GasMass
from turgor.core.solvers.procedures.static import Static
from turgor.core.solvers.procedures.step_options import StepOptions, fields_in_order
from turgor.core.solvers.solve import solve
from turgor.core.solvers.step_reasons import TEXTS, Cause, Reason


def test_steps_alone_are_no_procedure():
    with refused("StepOptions"):
        solve(model(), StepOptions())


def test_every_cause_has_a_sentence_and_numbers_come_last():
    assert set(TEXTS) == set(Cause)
    assert str(Reason(Cause.TOO_MANY_ITERATIONS, 15)) == "no convergence in 15 iterations"
    assert str(Reason(Cause.SINGULAR_TANGENT, detail="a pivot is zero")) == "a pivot is zero"


def test_a_rejected_step_tells_its_cause():
    solution = solve(model(1e6), Static(first_step=1.0, max_step=1.0, max_iterations=2, min_step=0.5), throw=False)
    rejected = [step for step in solution.steps if not step.accepted]
    assert rejected
    assert all(step.cause is not None and step.reason == str(step.why) for step in rejected)


def test_load_control_has_no_scalar():
    system = System(model())
    start = Start(np.zeros(system.size), None)
    result = newton(load_control(system), Tangent(system, "rslab", 1), start, 1.0, NewtonSettings(), silent)
    assert result.converged
    assert result.unstable_modes == 0
    assert len(result.scalars) == 0


def test_states_of_load_control_hold_what_acts():
    base = model()
    pressed = Model(bar(), base.materials, base.supports, [Pressure("top", 2e3)])
    for state in solve(pressed, Static(at=(0.5,))).states:
        assert state.pressures == {"top": pytest.approx(2e3 * state.load_factor)}
    assert all(not state.pressures for state in solve(base).states)


def test_steps_are_stated_once_and_read_after_what_is_asked():
    steps = [each.name for each in fields(StepOptions)]
    assert [each.name for each in fields_in_order(GasMass)][:2] == ["mass_ratio", "exponent"]
    assert [each.name for each in fields_in_order(Static)] == ["remesh", *steps, "duration"]
