"""Where walls touch, Newton's method gives up early if its updates do not help, and late if it is nearly there."""

from types import SimpleNamespace

import numpy as np
import pytest

import contact_cases
import turgor as tg
from turgor.core.solvers.newton import contact_newton
from turgor.core.solvers.newton.newton import _Newton
from turgor.core.solvers.newton.settings import FACTORS
from turgor.core.solvers.step_reasons import Cause
from turgor.units import mm

SHORT, FULL = (1.0, 1.0, 0.6, 0.25, 0.3), (1.0, 1.0, 0.6, 1.0, 0.3)


def _ended(residuals, lengths, touch=True):
    system = SimpleNamespace(contact=SimpleNamespace(parts=(1,)))
    case = SimpleNamespace(
        constraint=SimpleNamespace(scalar_unknowns=SimpleNamespace(system=system)),
        settings=SimpleNamespace(tolerance=1e-6, enough=1e-6),
    )
    at = SimpleNamespace(contacts=SimpleNamespace(touch=touch))
    now = SimpleNamespace(residuals=residuals, lengths=lengths, jump=np.zeros(1), at=at)
    return _Newton.ended(case, now, len(residuals) - 1)


def test_four_shortened_updates_that_do_not_halve_the_residual_are_enough():
    reason = _ended((3.9, 3.1, 3.3, 3.2, 3.1), SHORT)
    assert (reason.cause, reason.value) == (Cause.TOO_MANY_ITERATIONS, 4)


@pytest.mark.parametrize(
    ("residuals", "lengths", "touch"),
    [
        ((3.9, 3.1, 3.3, 3.2, 1.9), SHORT, True),  # halved
        ((3.9, 3.1, 3.3, 3.2, 3.1), FULL, True),  # a full update among them
        ((3.9, 3.1, 3.3, 3.2, 3.1), SHORT, False),  # no walls
        ((3.9, 3.1, 3.3, 3.2), SHORT[:4], True),  # three
    ],
)
def test_otherwise_it_goes_on(residuals, lengths, touch):
    assert _ended(residuals, lengths, touch) is None


def test_a_step_that_is_nearly_there_has_some_more_updates(monkeypatch):
    ball = tg.obstacles.Sphere(center=(5 * mm, 5 * mm, 9.1 * mm), radius=4 * mm)
    model = contact_cases.standing(contact_cases.block(), contact_cases.pushed(ball, (0.0, 0.0, -1.0)))
    once, taken = contact_newton.newton, []

    def noted(*arguments):
        result = once(*arguments)
        taken.append((result.converged, result.iterations))
        return result

    monkeypatch.setattr(contact_newton, "newton", noted)
    tg.solve(model, tg.Static(first_step=0.25, max_step=0.25, max_iterations=4))
    assert max(updates for converged, updates in taken if converged) in range(5, 5 + FACTORS.last_updates)
    assert all(updates <= 4 + FACTORS.last_updates for _, updates in taken)
