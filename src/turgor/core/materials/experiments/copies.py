"""Copies: series of measurements that are equal to the last digit, as where a curve was digitized or pasted twice."""

from collections.abc import Iterator, Sequence

import numpy as np

from turgor.core.materials.experiments.material_test import Array, MaterialTest
from turgor.core.materials.experiments.settings import EXPERIMENTS
from turgor.foundation.finding import Finding, Severity


def check_copies(tests: Sequence[MaterialTest]) -> tuple[Finding, ...]:
    """Check whether two series of measurements are copies of each other (P08).

    A series is a whole test; of a biaxial one the points at one stretch of an axis.

    Parameters
    ----------
    tests : sequence of MaterialTest

    Examples
    --------
    >>> stretch = [1.0, 1.2, 1.4, 1.6]
    >>> tests = [MaterialTest(mode=mode, stretch=stretch, nominal_stress=stretch, name=mode) for mode in
    ...          ("uniaxial", "planar")]
    >>> check_copies(tests)[0].message
    'uniaxial and planar hold the same numbers to the last digit.'
    """
    first: dict[bytes, str] = {}
    copied: dict[str, str] = {}
    for test in tests:
        for name, values in _series(test):
            key = values.tobytes()
            if key in first:
                copied.setdefault(name, first[key])
            first.setdefault(key, name)
    return tuple(
        Finding(
            code="P08",
            severity=Severity.WARNING,
            message=f"{one} and {other} hold the same numbers to the last digit.",
            advice="Measurements never agree so well: look whether one was pasted in place of another.",
        )
        for other, one in copied.items()
    )


def _series(test: MaterialTest) -> Iterator[tuple[str, Array]]:
    """Names and numbers of the series of a test."""
    stress = [each for each in (test.nominal_stress, test.nominal_stress_2) if each is not None]
    if test.stretch_2 is None:
        if len(test.stretch) >= EXPERIMENTS.shortest_series:
            yield test.name, np.array([test.stretch, *stress])
        return
    for axis, constant, free in ((2, test.stretch_2, test.stretch), (1, test.stretch, test.stretch_2)):
        for value in np.unique(constant):
            at = constant == value
            if at.sum() >= EXPERIMENTS.shortest_series:
                yield (
                    f"{test.name} at stretch {axis} = {value:.4g}",
                    np.array([free[at], *(each[at] for each in stress)]),
                )
