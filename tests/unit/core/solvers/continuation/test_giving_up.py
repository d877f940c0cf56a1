"""When attempts end, and what they say: the iterations of a row, round-off, and steps that creep."""

from dataclasses import replace
from types import SimpleNamespace

from turgor.core.solvers.continuation.step_control import in_vain
from turgor.core.solvers.newton import contact_newton
from turgor.core.solvers.newton.contact_newton import newton_with_contact
from turgor.core.solvers.newton.newton_values import NewtonResult, NewtonSettings, Start
from turgor.core.solvers.solution import Step
from turgor.core.solvers.step_reasons import Cause, Reason

FAILED = NewtonResult(
    evaluation=None, iterations=6, residual=0.8, converged=False,
    reason=Reason(Cause.TOO_MANY_ITERATIONS, 6, ": walls touch, and 6 updates did not halve the residual"),
)  # fmt: skip


def test_a_failure_counts_all_iterations_of_its_row(monkeypatch):
    """Newton's method gave up after six iterations, and inertia correction took one more."""
    more = replace(FAILED, iterations=1, reason=Reason(Cause.INERTIA_CORRECTION_FAILED))
    monkeypatch.setattr(contact_newton, "newton", lambda *_: FAILED)
    monkeypatch.setattr(contact_newton, "inertia_corrected", lambda *_: more)
    system = SimpleNamespace(contact=SimpleNamespace(parts=[1]))
    constraint = SimpleNamespace(scalar_unknowns=SimpleNamespace(system=system))
    result = newton_with_contact(
        constraint, SimpleNamespace(plain=False), Start(None, None), 1.0, NewtonSettings(), None
    )
    assert result.iterations == result.reason.value == 7
    assert str(result.reason) == (
        "no convergence in 7 iterations: walls touch, and 6 updates did not halve the residual"
    )


def steps(count, increment, every):
    """Attempts of which every so many succeeds."""
    return [
        Step(
            load_factor=0.5, increment=increment, iterations=5, residual=0.0, accepted=n % every == 0, seconds=0.0,
            why=None if n % every == 0 else Reason(Cause.INVERTED_CELL),
        )
        for n in range(count)
    ]  # fmt: skip


def test_steps_that_creep_are_in_vain():
    assert in_vain(steps(100, 1e-6, 3))
    assert not in_vain(steps(40, 1e-6, 3))  # too few to say
    assert not in_vain(steps(100, 1e-4, 3))  # as short as usual smallest steps
    assert not in_vain(steps(100, 1e-6, 1))  # none failed


def test_shorter_steps_do_not_help_against_round_off():
    last = replace(steps(1, 0.05, 1)[0], accepted=False, why=Reason(Cause.ROUND_OFF, 3e-11))
    assert in_vain([last])
    assert last.reason == "the residual stagnates at 3e-11, the round-off of the equations"
