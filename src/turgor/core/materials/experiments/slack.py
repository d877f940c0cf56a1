"""Slack, preload and slip: curves whose stretch is not that of the rubber."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from turgor.core.materials.experiments.material_test import Array, MaterialTest
from turgor.core.materials.experiments.settings import SLACK, SLIP
from turgor.core.materials.experiments.test_edits import set_zero_length, thin
from turgor.foundation.display import listed
from turgor.foundation.errors import TurgorError
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
    if power is None or test.stretch.min() < SLACK.shortest:
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


def count_from_zero(test: MaterialTest, zero: float | None = None) -> MaterialTest:
    """Count the stretch from where the stress is zero; points below it are left out where the specimen hung loose.

    Parameters
    ----------
    test : MaterialTest
        One loading curve.
    zero : float, optional [-]
        The stretch without stress; by default `zero_stretch` estimates it.

    Raises
    ------
    TurgorError
        If it cannot be estimated, because the test is one of shear or compression, or its beginning has few points.

    Examples
    --------
    >>> x = np.linspace(1.06, 2.0, 30) / 1.05
    >>> test = MaterialTest(mode="uniaxial", stretch=1.05 * x, nominal_stress=1e5 * (x - x**-2), name="a slack strip")
    >>> count_from_zero(test).range
    (1.0095..., 1.9047...)
    """
    estimated = zero is None
    zero = zero_stretch(test) if zero is None else zero
    if zero is None:
        raise TurgorError(
            f"the stretch without stress of test '{test.name}' cannot be estimated: its beginning has too few "
            "points in tension.",
            python="State it as zero.", command="State it, such as --zero 1.03.",
        )  # fmt: skip
    counted = set_zero_length(test, zero)
    loose = counted.stretch < 1.0
    how = "estimated" if estimated else "stated"
    return counted.keeping(~loose, f"Below the {how} zero of stress") if loose.any() and zero > 1 else counted


def check_slack(tests: Sequence[MaterialTest]) -> tuple[Finding, ...]:
    """Check whether curves meet zero stress at a stretch above 1 (P10).

    Parameters
    ----------
    tests : sequence of MaterialTest
        As they are fitted.
    """
    slack = {
        test.name: f"{test.name} ({zero:.3f})"
        for test in tests
        if (zero := zero_stretch(test)) is not None and zero > SLACK.least
    }
    if not slack:
        return ()
    each = "" if len(slack) == 1 else " each"
    return (
        Finding(
            code="P10",
            severity=Severity.WARNING,
            message=f"{listed(slack.values())} meet{'s' * (len(slack) == 1)} zero stress at a stretch above 1: the "
            f"specimen{'s' * (len(slack) > 1)} hung loose, or slipped. Fitted laws are too soft at small stretches.",
            advice=f"Count the stretch from there{each}: count_from_zero in Python, --zero auto on the command line; "
            "or from a small stress, with remove_slack or --preload.",
        ),
    )


def check_preload(tests: Sequence[MaterialTest]) -> tuple[Finding, ...]:
    """Check whether curves bear a stress where their stretch is counted as 1 (P12).

    Parameters
    ----------
    tests : sequence of MaterialTest
        As they were measured, before points were averaged or left out.
    """
    findings = []
    for test in tests:
        at_rest = np.abs(test.stretch - 1.0) <= SLACK.at_rest
        zero = zero_stretch(test) if at_rest.any() else None
        if zero is None or zero >= 1.0 - (SLACK.least - 1.0):
            continue
        stress = float(np.median(test.nominal_stress[at_rest]))
        # a rubber that is stiff at first has no stress at rest; one that was preloaded has that of its strain
        expected = float(np.interp(2.0 - zero, *_sorted(test))) - stress
        if stress > SLACK.preload_share * expected:
            findings.append(
                Finding(
                    code="P12",
                    severity=Severity.WARNING,
                    message=f"{test.name} bears {stress / 1e3:.3g} kPa where its stretch counts as 1, and would meet "
                    f"zero stress at {zero:.3f}: the specimen was preloaded. Fitted laws are too stiff at small "
                    "stretches.",
                    advice="Count the stretch from where the stress is zero: count_from_zero in Python, --zero auto on "
                    "the command line; or measure the length before the preload.",
                )
            )
    return tuple(findings)


def check_slip(tests: Sequence[MaterialTest]) -> tuple[Finding, ...]:
    """Check whether the stress falls and rises again during a pull, as where a specimen slips in its grips (P13).

    Parameters
    ----------
    tests : sequence of MaterialTest
        As they were measured, before points were averaged or left out.
    """
    findings = []
    for test in tests:
        if test.mode not in _POWERS or test.first_turn() is not None:
            continue
        stretch, stress = _sorted(thin(test, SLIP.points))
        noise = float(np.median(np.abs(np.diff(stress, 2)))) if len(stress) > SLACK.points else 0.0
        slips = _slips(stress, SLIP.noise * noise)
        if slips:
            at = ", ".join(f"{stretch[top]:.3g}" for top, _ in slips[:3]) + (" …" if len(slips) > 3 else "")
            worst = max(1 - stress[bottom] / stress[top] for top, bottom in slips)
            findings.append(
                Finding(
                    code="P13",
                    severity=Severity.WARNING,
                    message=f"The stress of {test.name} falls by up to {100 * worst:.2g} % and rises again, at "
                    f"stretch {at}: the specimen slipped in its grips, or tore a little. A compliant machine gives way "
                    "in proportion to the force, without such steps.",
                    advice="Use the curve up to there only, with crop or --range, or measure the stretch on the "
                    "specimen.",
                )
            )
    return tuple(findings)


def _slips(stress: Array, least: float) -> list[tuple[int, int]]:
    """Rows between which the stress falls, although it rises beyond its former value later."""
    slips, top, bottom = [], 0, 0
    for row, value in enumerate(stress):
        if value >= stress[top]:
            fall = stress[top] - stress[bottom]
            if fall > max(least, SLIP.share * stress[top]) and stress[top] > SLIP.above * stress.max():
                slips.append((top, bottom))
            top = bottom = row
        elif value < stress[bottom]:
            bottom = row
    return slips


def _sorted(test: MaterialTest) -> tuple[Array, Array]:
    order = np.argsort(test.stretch, kind="stable")
    return test.stretch[order], test.nominal_stress[order]
