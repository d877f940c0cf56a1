"""A step shorter than the first one is solved to a smaller tolerance, so that noise is no large part of it."""

from types import SimpleNamespace

import pytest

import turgor as tg
from turgor.core.solvers.continuation.path_points import _for_short, settings_of
from turgor.core.solvers.continuation.settings import STEP_CONTROL


@pytest.mark.parametrize(
    ("length", "tolerance"),
    [(0.4, 1e-6), (0.1, 1e-6), (0.05, 5e-7), (0.001, 1e-8), (1e-5, STEP_CONTROL.smallest_tolerance)],
)
def test_the_tolerance_shrinks_with_the_step(length, tolerance):
    procedure = tg.Static(first_step=0.1)
    run = SimpleNamespace(task=SimpleNamespace(procedure=procedure, settings=settings_of(procedure)))
    assert _for_short(run, length).tolerance == pytest.approx(tolerance)


def test_a_tolerance_that_is_smaller_stays():
    procedure = tg.Static(tolerance=1e-11)
    run = SimpleNamespace(task=SimpleNamespace(procedure=procedure, settings=settings_of(procedure)))
    assert _for_short(run, 1e-3).tolerance == 1e-11
