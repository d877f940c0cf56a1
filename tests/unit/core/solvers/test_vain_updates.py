"""Newton's method gives up early where walls touch, if the line search shortened the updates and they did not help."""

from types import SimpleNamespace
from unittest.mock import patch

import numpy as np
import pytest

from turgor.core.solvers.newton.newton import _Newton
from turgor.core.solvers.step_reasons import Cause

SHORT, FULL = (1.0, 1.0, 0.6, 0.25, 0.3), (1.0, 1.0, 0.6, 1.0, 0.3)


def _ended(residuals, lengths, touch=True):
    system = SimpleNamespace(contact=SimpleNamespace(parts=(1,)))
    case = SimpleNamespace(
        constraint=SimpleNamespace(scalar_unknowns=SimpleNamespace(system=system)),
        settings=SimpleNamespace(tolerance=1e-6, enough=1e-6),
    )
    at = SimpleNamespace(contacts=SimpleNamespace(touch=touch))
    now = SimpleNamespace(residuals=residuals, lengths=lengths, jump=np.zeros(1), at=at)
    with patch("turgor.core.solvers.newton.convergence.nothing_acts", return_value=False):
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


@pytest.mark.parametrize(("updates", "least", "ends"), [(9, 0.45, False), (10, 0.45, True), (10, 0.35, False)])
def test_ten_updates_shall_bring_a_tenth(updates, least, ends):
    reason = _ended((4.0, 3.0, least, *[3.0] * (updates - 2)), (1.0,) * (updates + 1))
    assert (reason is not None) == ends
    assert not ends or "10 updates did not bring the residual far down" in str(reason)
