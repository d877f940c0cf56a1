"""Check of a fitted law against the sets of the same rubber in the library (M20)."""

import re
from typing import Any

import numpy as np

from turgor.core.materials.fitting.result import stress_text
from turgor.core.materials.fitting.settings import FIT
from turgor.core.materials.laws.homogeneous import nominal_stress, uniaxial
from turgor.core.materials.library.record_files import library
from turgor.core.materials.library.spread import sound_laws
from turgor.foundation.finding import Finding, Severity


def rubber_of(name: str) -> str:
    """Return the library material that a name of a test contains; empty where there is none.

    Parameters
    ----------
    name : str

    Examples
    --------
    >>> rubber_of("Ecoflex 00-30 batch 2"), rubber_of("dragon_skin_10_medium_uniaxial"), rubber_of("strip")
    ('ecoflex-00-30', 'dragon-skin-10', '')
    """
    words = f"-{re.sub(r'[^a-z0-9]+', '-', name.lower())}-"
    return max((each for each in library() if f"-{each}-" in words), key=len, default="")


def check_library(law: Any, rubber: str, stretch: float) -> tuple[Finding, ...]:
    """Compare a law with the sound sets of a rubber in the library, at rest and at a stretch (M20).

    Parameters
    ----------
    law : Law
        A fitted one.
    rubber : str
        One of `turgor.library()`.
    stretch : float [-]
        Largest stretch of its tests; stresses are compared there, but at no more than 2.

    Returns
    -------
    tuple of Finding
        A note, or a warning where the modulus at rest lies outside all sets, or the stress far from their median.

    Examples
    --------
    >>> from turgor.core.materials.laws.laws import NeoHooke
    >>> (finding,) = check_library(NeoHooke(C10=4e3), "ecoflex-00-30", 2.0)
    >>> print(finding.severity, finding.message.split(" is ")[0])
    warning E = 24 kPa
    """
    laws = [law for _, law in sound_laws(rubber)]
    if not laws:
        return ()
    at = min(FIT.trade_stretch, stretch)
    rows = [("E", 3 * law.shear_modulus, [3 * each.shear_modulus for each in laws])]
    pulls = [_pull(each, at) for each in laws]
    rows.append((f"The stress at stretch {at:.3g}", _pull(law, at), [each for each in pulls if each > 0]))
    texts, far = [], False
    for what, own, others in rows:
        low, middle, high = (float(np.quantile(others, share)) for share in (0, 0.5, 1))
        texts.append(
            f"{what} = {stress_text(own)} is {_times(own / middle)} the median of {len(others)} sets of {rubber} in "
            f"the library, {stress_text(middle)} ({stress_text(low)} to {stress_text(high)})"
        )
        far = far or not low <= own <= high or not 1 / FIT.far_from_library < own / middle < FIT.far_from_library
    return (
        Finding(
            code="M20",
            severity=Severity.WARNING if far else Severity.NOTE,
            message=f"{'. '.join(texts)}.",
            advice="Check the zero of the stretch, the section of the specimen and the unit of the stress, then "
            "mixing, cure and batch; laboratories differ by a third without an error."
            if far
            else "It is within what laboratories measure.",
        ),
    )


def _pull(law: Any, stretch: float) -> float:
    return float(nominal_stress(law, uniaxial(np.array([stretch])))[0, 0, 0])


def _times(ratio: float) -> str:
    """Ratio in words.

    Examples
    --------
    >>> _times(0.5), _times(1.4), _times(1.0)
    ('1/2.0 of', '1.4 times', '1.0 times')
    """
    return f"1/{1 / ratio:.1f} of" if ratio < FIT.one_to_two_digits else f"{ratio:.1f} times"
