"""Modes of the tests behind a fit: which are there, which are missing, and how far the laws differ in those."""

from collections.abc import Sequence

import numpy as np

from turgor.core.materials.fitting.checks import first_invariant_alone
from turgor.core.materials.fitting.result import Fit, stress_text
from turgor.core.materials.fitting.settings import FIT
from turgor.core.materials.laws.homogeneous import equibiaxial, nominal_stress, planar, uniaxial

#: The modes that pin a law down, with their deformations.
_MODES = {"uniaxial": uniaxial, "equibiaxial": equibiaxial, "planar": planar}


def missing_modes(fits: Sequence[Fit]) -> tuple[str, ...]:
    """Return sentences on the modes of tests: those that are there, and what the laws predict in the others.

    Parameters
    ----------
    fits : sequence of Fit
        Of several laws to the same tests, the best first.

    Returns
    -------
    tuple of str
        Empty where uniaxial and equibiaxial tests are there, or biaxial ones: all others lie between them.
    """
    tests = fits[0].tests
    counts = {mode: sum(test.mode == mode for test in tests) for mode in dict.fromkeys(test.mode for test in tests)}
    if "biaxial" in counts or {"uniaxial", "equibiaxial"} <= set(counts):
        return ()
    there = ", ".join(f"{count} {mode.replace('_', ' ')}" for mode, count in counts.items())
    sheared = {"planar" if mode == "simple_shear" else mode for mode in counts}
    missing = [mode for mode in _MODES if mode not in sheared]
    limit = max(FIT.alike * min(each.relative for each in fits), FIT.close)
    close = [each for each in fits if each.relative <= limit]
    text = f"Tests that are there: {there}. Missing: {' and '.join(missing)}"
    # walls of the same first invariant as in the pull are where the law is used
    stretch = max(min(fits[0].stretch_range[1], FIT.trade_stretch), 1.0)
    if len(close) < 2 or stretch == 1.0:
        return (f"{text}; no second law fits as well, so that nothing says how uncertain the stress is there.",)
    names = ", ".join(each.spec.name for each in close)
    if all(first_invariant_alone(each.law) for each in close):
        agree = (
            "depend on the first invariant alone and agree there without a test: measured rubbers were 8 to 48 % off"
        )
        return (f"{text}. Laws that fit as well ({names}) {agree} (M02).",)
    parts = [_differ(close, mode, stretch) for mode in missing]
    return (f"{text}. Laws that fit as well ({names}) differ {' and '.join(parts)}.",)


def _differ(fits: Sequence[Fit], mode: str, stretch: float) -> str:
    """How far laws differ in a mode, at the stretch where the first invariant is that of a pull."""
    invariant = stretch**2 + 2 / stretch
    tried = np.linspace(1.0, stretch, 400)
    F = _MODES[mode](tried)
    place = int(np.argmin(np.abs((F**2).sum(axis=(1, 2)) - invariant)))
    stresses = [float(nominal_stress(fit.law, F[[place]])[0, 0, 0]) for fit in fits]
    low, high = min(stresses), max(stresses)
    spans = f"{stress_text(low)} to {stress_text(high)}"
    share = f"a factor of {high / low:.2g}" if low > 0 and high > 1.5 * low else f"{100 * (high - low) / high:.2g} %"
    return f"by {share} in {mode} tension at stretch {tried[place]:.3g} ({spans})"
