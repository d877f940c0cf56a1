"""Checks of fitted laws: range (M01), undetermined constants (M02), stretch for the order (M03), stability (M06)."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from turgor.core.materials.fitting.settings import FIT
from turgor.core.materials.laws.laws import StretchLaw
from turgor.core.materials.library.doubt_checks import unstable_law
from turgor.core.materials.material import Material
from turgor.foundation.finding import Finding, Severity

if TYPE_CHECKING:  # a job loads this file, and its laws are fitted already
    from turgor.core.materials.experiments.material_test import MaterialTest
    from turgor.core.materials.fitting.result import Fit

#: Advice of M02. The numbers come from ``tests/validation/fits/test_fit_one_mode.py``.
_MORE_MODES = (
    "Add tests of another mode, equibiaxial or planar. Laws of the first invariant leave nothing open but are no "
    "substitute: fitted to uniaxial tension of three measured rubbers, Yeoh's law is 12 to 48 % off in equibiaxial "
    "tension, neo-Hooke and Gent 8 to 27 %."
)


def check_stretch_range(material: Material, stretch: tuple[float, float]) -> tuple[Finding, ...]:
    """Check whether a law is used beyond the stretches of its tests (M01).

    Parameters
    ----------
    material : Material
        Material with a ``stretch_range``; without a range there is no finding.
    stretch : (float, float) [-]
        Smallest and largest stretch in use.

    Examples
    --------
    >>> from turgor.core.materials.laws.laws import NeoHooke
    >>> rubber = Material(name="rubber", law=NeoHooke(C10=0.1e6), stretch_range=(1.0, 2.0))
    >>> [finding.code for finding in check_stretch_range(rubber, (1.0, 3.0))], check_stretch_range(rubber, (1.0, 1.5))
    (['M01'], ())
    """
    if material.stretch_range is None:
        return ()
    (low, high), (least, most) = material.stretch_range, stretch
    beyond = []
    if most > high * (1 + FIT.range_slack):
        beyond.append(f"up to stretch {most:.3g}, but its tests end at {high:.3g}")
    if least < low * (1 - FIT.range_slack):
        beyond.append(f"down to stretch {least:.3g}, but its tests begin at {low:.3g}")
    if not beyond:
        return ()
    return (
        Finding(
            code="M01",
            severity=Severity.WARNING,
            message=f"The law of '{material.name}' is used {' and '.join(beyond)}.",
            advice="Do not trust the law there: test the rubber at these stretches, or use results within the tests.",
        ),
    )


def check_modes(law: Any, modes: Sequence[str]) -> tuple[Finding, ...]:
    """Check whether a law in principal stretches or the second invariant was fitted to tests of one mode alone (M02).

    Planar tests and simple shear count as one mode: I₁ = I₂ in both.

    Parameters
    ----------
    law : Law
        The law.
    modes : sequence of str
        Modes of the tests that it was fitted to.

    Examples
    --------
    >>> from turgor.core.materials.laws.laws import MooneyRivlin, Yeoh
    >>> [finding.code for finding in check_modes(MooneyRivlin(C10=1e5, C01=1e4), ["uniaxial"])]
    ['M02']
    >>> check_modes(Yeoh(C10=1e5, C20=1e3), ["uniaxial"])
    ()
    """
    message = _one_mode(law, modes)
    return (_too_few_modes(message),) if message else ()


def first_invariant_alone(law: Any) -> bool:
    """Return whether a law depends on the first invariant alone, so that one mode fixes it in all others.

    Examples
    --------
    >>> from turgor.core.materials.laws.laws import MooneyRivlin, NeoHooke
    >>> first_invariant_alone(NeoHooke(C10=1e5)), first_invariant_alone(MooneyRivlin(C10=1e5, C01=1e4))
    (True, False)
    """
    return not isinstance(law, StretchLaw) and bool(law.energy(4.0, 4.0) == law.energy(4.0, 5.0))


def _one_mode(law: Any, modes: Sequence[str]) -> str:
    """Sentence about a law that one mode cannot determine and that was fitted to one mode; empty otherwise."""
    paths = {"planar" if mode == "simple_shear" else mode for mode in modes}
    if len(paths) != 1 or paths == {"biaxial"}:
        return ""
    if first_invariant_alone(law):
        return ""
    what = f"{type(law).__name__} constants" if isinstance(law, StretchLaw) else "coefficients of the second invariant"
    tests = " and ".join(dict.fromkeys(mode.replace("_", " ") for mode in modes)).capitalize()
    return f"{tests} tests alone do not determine {what}: the stress in other modes is a guess."


def _too_few_modes(message: str) -> Finding:
    return Finding(code="M02", severity=Severity.WARNING, message=message, advice=_MORE_MODES)


def _check_determined(fit: "Fit") -> tuple[Finding, ...]:
    """Check whether the tests determine the law and each of its constants (M02)."""
    message = _one_mode(fit.law, [test.mode for test in fit.tests])
    if fit.unconstrained:
        names = " and ".join(filter(None, (", ".join(fit.unconstrained[:-1]), fit.unconstrained[-1])))
        only = f"they determine only {fit.combination}" if fit.combination else "they determine only a combination"
        constants = f"The tests do not determine {names} separately; {only}."
        message = f"{message} {constants}".strip()
    return (_too_few_modes(message),) if message else ()


def _check_stability(fit: "Fit") -> tuple[Finding, ...]:
    """Check whether the nominal stress rises in the usual range of soft actuators, as for records (M06)."""
    return tuple(
        Finding(
            code=doubt.code,
            severity=doubt.severity,
            message=doubt.message,
            advice="Stay below the stated stretch, or fit with a wider range of stretches, within which a law is "
            "kept stable.",
        )
        for doubt in unstable_law(fit.law)
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
        Whether fibers or chambers prevent ballooning; the finding is then a note, because laws of low order hold up to
        larger stretches.

    Examples
    --------
    >>> from turgor.core.materials.laws.laws import NeoHooke
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


def covered_range(tests: "Sequence[MaterialTest]", stretch: tuple[float, float]) -> tuple[float, float]:
    """Return the part of a range that tests cover, extended to the undeformed state [-].

    Parameters
    ----------
    tests : sequence of MaterialTest
        Whole tests, before points outside the range are left out.
    stretch : (float, float) [-]
        The requested range.
    """
    ranges = [test.range for test in tests if test.mode != "simple_shear"] or [stretch]
    low, high = min(low for low, _ in ranges), max(high for _, high in ranges)
    return min(max(low, stretch[0]), 1.0), max(min(high, stretch[1]), 1.0)


def check_working_range(tests: "Sequence[MaterialTest]") -> tuple[Finding, ...]:
    """Check whether enough of the points lie where most soft actuators work (P11).

    Parameters
    ----------
    tests : sequence of MaterialTest
        As they are fitted.
    """
    stretches = [float(each) for test in tests if test.mode not in ("simple_shear", "biaxial") for each in test.stretch]
    working = sum(1.0 <= each <= FIT.working for each in stretches)
    if not stretches or working >= FIT.working_share * len(stretches) or max(stretches) <= FIT.working:
        return ()
    return (
        Finding(
            code="P11",
            severity=Severity.NOTE,
            message=f"Only {working} of {len(stretches)} points lie up to stretch {FIT.working:g}, where most soft "
            f"actuators work; the others, up to {max(stretches):.3g}, decide the fit.",
            advice=f"Fit for the stretches that the actuator sees, such as 1 to {FIT.working:g}: stretch=(…) and "
            f"weights='even' in Python, --for 'stretch 1:{FIT.working:g}' or --for RUN on the command line.",
        ),
    )


def fit_findings(fit: "Fit", tests: "Sequence[MaterialTest]") -> tuple[Finding, ...]:
    """Return the findings of all checks about a fit.

    Parameters
    ----------
    fit : Fit
        The fit, with the requested range of stretch.
    tests : sequence of MaterialTest
        Whole tests, before points outside the range were left out.
    """
    material = Material(name=fit.spec.name, law=fit.law, stretch_range=covered_range(tests, fit.stretch))
    return (
        *check_stretch_range(material, fit.stretch),
        *_check_determined(fit),
        *check_order(fit.law, fit.stretch[1]),
        *_check_stability(fit),
    )
