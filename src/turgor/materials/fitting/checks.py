"""Checks of fitted laws: range of the fit (M01), modes of the tests (M02), largest stretch for the order (M03)."""

from collections.abc import Sequence
from typing import Any

from turgor.finding import Finding, Severity
from turgor.materials.experiments.material_test import MaterialTest
from turgor.materials.laws.laws import StretchLaw
from turgor.materials.material import Material

#: Tolerance of the ends of a range, as a share, because digitized curves have no sharp ends.
SLACK = 0.02


def check_stretch_range(material: Material, stretch: tuple[float, float]) -> tuple[Finding, ...]:
    """Check whether a law is used beyond the stretches of its tests (M01).

    Parameters
    ----------
    material : Material
        Its ``stretch_range`` is compared; without one there is no finding.
    stretch : (float, float) [-]
        Smallest and largest stretch in use.

    Examples
    --------
    >>> from turgor.materials.laws.laws import NeoHooke
    >>> rubber = Material(name="rubber", law=NeoHooke(C10=0.1e6), stretch_range=(1.0, 2.0))
    >>> [finding.code for finding in check_stretch_range(rubber, (1.0, 3.0))], check_stretch_range(rubber, (1.0, 1.5))
    (['M01'], ())
    """
    if material.stretch_range is None:
        return ()
    (low, high), (least, most) = material.stretch_range, stretch
    beyond = []
    if most > high * (1 + SLACK):
        beyond.append(f"up to stretch {most:.3g}, but its tests end at {high:.3g}")
    if least < low * (1 - SLACK):
        beyond.append(f"down to stretch {least:.3g}, but its tests begin at {low:.3g}")
    if not beyond:
        return ()
    return (
        Finding(
            code="M01",
            severity=Severity.WARNING,
            message=f"The law of '{material.name}' is used {' and '.join(beyond)}.",
            advice="Do not trust it there: test the rubber over that range, or use the results below it.",
        ),
    )


def check_modes(law: Any, modes: Sequence[str]) -> tuple[Finding, ...]:
    """Check whether a law in principal stretches or the second invariant was fitted to uniaxial tests alone (M02).

    Parameters
    ----------
    law : Law
        The law.
    modes : sequence of str
        Modes of the tests that it was fitted to.

    Examples
    --------
    >>> from turgor.materials.laws.laws import MooneyRivlin, Yeoh
    >>> [finding.code for finding in check_modes(MooneyRivlin(C10=1e5, C01=1e4), ["uniaxial"])]
    ['M02']
    >>> check_modes(Yeoh(C10=1e5, C20=1e3), ["uniaxial"])
    ()
    """
    if set(modes) != {"uniaxial"} or not (isinstance(law, StretchLaw) or law.energy(4.0, 4.0) != law.energy(4.0, 5.0)):
        return ()
    what = f"{type(law).__name__} constants" if isinstance(law, StretchLaw) else "coefficients of the second invariant"
    return (
        Finding(
            code="M02",
            severity=Severity.WARNING,
            message=f"Uniaxial tests alone do not determine {what}: the stress in other modes is a guess.",
            advice="Add an equibiaxial or planar test, or use the Yeoh law, which predicts other modes reasonably well "
            "from uniaxial data.",
        ),
    )


def check_order(law: Any, stretch: float, *, reinforced: bool = False) -> tuple[Finding, ...]:
    """Check whether a law of low order is used at stretches where rubber stiffens more than the law (M03).

    The neo-Hookean law and the Mooney–Rivlin law state a ``max_stretch_hint``; so may a law of your own.

    Parameters
    ----------
    law : Law
        The law.
    stretch : float [-]
        Largest stretch in use.
    reinforced : bool
        Whether fibers or chambers prevent ballooning; the finding is then a note, because laws of low order are good to
        larger stretches.

    Examples
    --------
    >>> from turgor.materials.laws.laws import NeoHooke
    >>> [finding.code for finding in check_order(NeoHooke(C10=1e5), 3.0)], check_order(NeoHooke(C10=1e5), 1.4)
    (['M03'], ())
    """
    limit = getattr(law, "max_stretch_hint", None)
    if limit is None or stretch <= limit:
        return ()
    return (
        Finding(
            code="M03",
            severity=Severity.NOTE if reinforced else Severity.WARNING,
            message=f"The law {type(law).__name__} suits strains up to {100 * (limit - 1):.0f} %, "
            f"but {100 * (stretch - 1):.0f} % is wanted.",
            advice="Use the Yeoh law, or Ogden's with tests in more than one mode, above all where walls balloon.",
        ),
    )


def covered_range(tests: Sequence[MaterialTest], stretch: tuple[float, float]) -> tuple[float, float]:
    """Return the part of a range that tests cover; the undeformed state belongs to it [-].

    Parameters
    ----------
    tests : sequence of MaterialTest
        Whole tests, before points outside the range are left out.
    stretch : (float, float) [-]
        The range that is wanted.
    """
    ranges = [test.range for test in tests if test.mode != "simple_shear"] or [stretch]
    low, high = min(low for low, _ in ranges), max(high for _, high in ranges)
    return min(max(low, stretch[0]), 1.0), max(min(high, stretch[1]), 1.0)


def fit_findings(
    law: Any, name: str, tests: Sequence[MaterialTest], stretch: tuple[float, float]
) -> tuple[Finding, ...]:
    """Return the findings of all checks about a fit for a range of stretch.

    Parameters
    ----------
    law : Law
        The fitted law.
    name : str
        Name of the law in messages.
    tests : sequence of MaterialTest
        Tests of the fit.
    stretch : (float, float) [-]
        The range that is wanted.
    """
    material = Material(name=name, law=law, stretch_range=covered_range(tests, stretch))
    return (
        *check_stretch_range(material, stretch),
        *check_modes(law, [test.mode for test in tests]),
        *check_order(law, stretch[1]),
    )
