"""The first steps: no second factorization at rest, and extrapolations although their residual is larger."""

import numpy as np
import pytest

import meshes
import problems
import turgor as tg
from turgor.core.engine.algebra.tangent import Tangent
from turgor.core.engine.runtime import MIXED, NEWTON
from turgor.core.engine.system import System
from turgor.core.solvers.constraints.loads import load_control
from turgor.core.solvers.continuation.load_control import load_run
from turgor.core.solvers.continuation.path_run import Point
from turgor.core.solvers.continuation.predictor import Extrapolation, predicted
from turgor.core.solvers.newton import newton as newton_module
from turgor.core.solvers.problem import Problem
from turgor.units import kPa


def block() -> tg.Model:
    """A block that is pulled a little."""
    mesh = meshes.box((0.02, 0.01, 0.01), (2, 1, 1))
    return tg.Model(
        mesh, {"body": problems.rubber(problems.YEOH)}, [tg.Fixed("x0")], [tg.loads.Traction("x1", (5 * kPa, 0.0, 0.0))]
    )


@pytest.mark.parametrize(("iteration", "expected"), [(MIXED, 2.0), (NEWTON, 1.0)])
def test_an_extrapolation_is_better_than_to_stay_if_stresses_are_linearized(iteration: str, expected: float) -> None:
    system = System(block())
    rest = system.stresses(system.evaluate(np.zeros(system.size), 0.0))
    points = []
    for number in range(2):
        unknowns = np.where(system.prescribed, 0.0, 1e-6 * number)
        points.append(Point(float(number), unknowns, np.empty(0), rest, None, None, None, None))
    # a residual that grows with the displacement, as that of a stiff wall that is stretched
    measure = Extrapolation(lambda _, at: float(np.abs(at.unknowns).max()), 0.0, True, False)
    tangent = Tangent(system, "rslab", 1, iteration)
    result = predicted(load_control(system), tangent, points, 2.0, measure)
    assert result.unknowns.max() / 1e-6 == pytest.approx(expected)


@pytest.mark.parametrize(("first_step", "expected"), [(1.0, [False]), (0.1, [True])])
def test_a_long_first_step_uses_the_factors_of_the_state_at_rest(
    monkeypatch: pytest.MonkeyPatch, first_step: float, expected: list[bool]
) -> None:
    begun = []
    begin = newton_module._begin

    def watched(run, start):
        begun.append(start.fresh)
        return begin(run, start)

    monkeypatch.setattr(newton_module, "_begin", watched)
    solution = problems.solve(block(), tg.Static(first_step=first_step))
    assert begun[:1] == expected
    assert all(begun[1:])
    assert solution.complete


def test_a_prediction_leaves_no_trace_for_the_next_one() -> None:
    """Whose factors the tangent has is known to the tangent, not noted by who asked before."""
    system = System(block())
    problem = Problem(system=system, tangent=Tangent(system, "rslab", 1))
    run = load_run(problem, tg.Static(first_step=1.0), patient=True)
    before = run.memory
    starts = [run.task.strategy.predict(run, 1.0) for _ in range(2)]
    assert [start.fresh for start in starts] == [False, False]
    assert run.memory is before
    at = system.evaluate(np.zeros(system.size), 0.0)
    problem.tangent.factor(at)
    assert run.task.strategy.predict(run, 1.0).fresh
