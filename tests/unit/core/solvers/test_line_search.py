"""When contact makes an update too long: the force along it reverses, a little with friction, many times without."""

from types import SimpleNamespace

import numpy as np
import pytest

from turgor.core.solvers.newton.line_search import length_allowed
from turgor.core.solvers.newton.settings import LINE_SEARCH

SYSTEM = SimpleNamespace(
    contact=SimpleNamespace(shortening=lambda old, new: 1.0),
    terms=SimpleNamespace(remembering=()),
    moving=np.array([True, True, False]),
    prescribed=np.array([False, True, False]),
)
UPDATE = np.array([2.0, 5.0, 5.0])


def evaluation(force, rubs=False, same=True):
    contacts = SimpleNamespace(rubs=rubs, touch_as=lambda other: same)
    return SimpleNamespace(residual=np.array([force, 1e6, 1e6]), contacts=contacts)


@pytest.mark.parametrize(
    ("rubs", "same", "most"),
    [
        (True, True, LINE_SEARCH.overshot),
        (True, False, LINE_SEARCH.overshot),
        (False, False, LINE_SEARCH.overshot_touching),
    ],
)
def test_a_force_that_reverses_is_allowed_up_to_a_share(rubs, same, most):
    shares = [
        length_allowed(SYSTEM, evaluation(-1.0), evaluation(after, rubs, same), UPDATE)
        for after in (0.99 * most, 1.01 * most, -1.01 * most)
    ]
    assert shares == [1.0, 0.5, 1.0]


def test_without_contact_that_changes_nothing_is_too_long():
    assert length_allowed(SYSTEM, evaluation(-1.0), evaluation(1e6), UPDATE) == 1.0
