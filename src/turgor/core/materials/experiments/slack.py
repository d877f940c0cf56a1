"""Slack: a curve that meets zero stress at another stretch than 1, because the specimen hung loose or was preloaded."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from turgor.core.materials.experiments.material_test import Array, MaterialTest
from turgor.core.materials.experiments.settings import SLACK
from turgor.foundation.finding import Finding, Severity

#: Power of the transverse term of the nominal stress of a neo-Hookean rubber, λ − λ⁻ᵖ, in each mode.
_POWERS = {"uniaxial": 2, "planar": 3, "equibiaxial": 5}


def zero_stretch(test: MaterialTest) -> float | None:
    """Return the stretch at which the beginning of a curve meets zero stress; None where it cannot be determined.

    The beginning is fitted by a neo-Hookean rubber whose length at rest is free.

    Parameters
    ----------
    test : MaterialTest

    Examples
    --------
    >>> x = np.linspace(1.06, 2.0, 30) / 1.05
    >>> test = MaterialTest(mode="uniaxial", stretch=1.05 * x, nominal_stress=1e5 * (x - x**-2), name="a slack strip")
    >>> round(zero_stretch(test), 3)
    1.05
    """
    power = _POWERS.get(test.mode)
    if power is None or test.stretch.min() < 1.0:
        return None
    beginning = _beginning(test)
    if beginning.sum() < SLACK.points or not (test.nominal_stress[beginning] > 0).any():
        return None
    from scipy.optimize import minimize_scalar  # slow to load, and every job loads this file

    stretch, stress = test.stretch[beginning], test.nominal_stress[beginning]
    weight = 1 / np.maximum(np.abs(stress), SLACK.floor * np.abs(stress).max())

    def misfit(zero: float) -> float:
        shape = _neo_hooke(stretch / zero, power) * weight
        target = stress * weight
        return float(target @ target - (shape @ target) ** 2 / (shape @ shape))

    best = minimize_scalar(misfit, bounds=SLACK.searched, method="bounded", options={"xatol": 1e-4})
    return float(best.x)


def _beginning(test: MaterialTest) -> NDArray[np.bool_]:
    """Mask of the points within some stretch of the first one that bears a stress; a loose specimen bears none."""
    stretch, stress = test.stretch, test.nominal_stress
    within = stretch <= stretch.min() + SLACK.beginning
    bears = stress > SLACK.floor * stress[within].max()
    first = float(stretch[bears].min()) if bears.any() else float(stretch.min())
    return np.asarray(bears & (stretch <= first + SLACK.beginning))


def _neo_hooke(stretch: Array, power: int) -> Array:
    return np.asarray(stretch - stretch**-power)


def check_slack(tests: Sequence[MaterialTest]) -> tuple[Finding, ...]:
    """Check whether curves meet zero stress at a stretch above 1 (P10).

    Parameters
    ----------
    tests : sequence of MaterialTest
        As they are fitted.
    """
    slack = [(test, zero) for test in tests if (zero := zero_stretch(test)) is not None and zero > SLACK.least]
    return tuple(
        Finding(
            code="P10",
            severity=Severity.WARNING,
            message=f"{test.name} meets zero stress at a stretch of about {zero:.3f}: the specimen hung loose, or "
            "slipped. Fitted laws are too soft at small stretches.",
            advice="Count the stretch from where the specimen is taut: remove_slack in Python, --preload with a small "
            "stress on the command line.",
        )
        for test, zero in slack
    )
