"""Stability of a law in the tests of a rubber: where its stress stops rising, and where Drucker's postulate fails.

All of it from the first and second derivatives of the energy along the path of a test; no differences are taken.
"""

from collections.abc import Callable
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from turgor.core.materials.laws.derivatives import STRETCH_PAIRS, stretch_derivatives
from turgor.core.materials.laws.laws import FoamLaw, Law
from turgor.core.materials.laws.released import foam_path
from turgor.foundation.errors import TurgorError, unknown
from turgor.foundation.round_off import ROUND_OFF

Array = NDArray[np.float64]
Mode = Literal["uniaxial", "equibiaxial", "planar"]
Criterion = Literal["nominal", "cauchy", "drucker"]

#: Powers of λ that make the three stretches of a test, and how many directions are pulled.
MODES: dict[str, tuple[tuple[float, float, float], int]] = {
    "uniaxial": ((1.0, -0.5, -0.5), 1),
    "equibiaxial": ((1.0, 1.0, -2.0), 2),
    "planar": ((1.0, 0.0, -1.0), 1),
}
CRITERIA = ("nominal", "cauchy", "drucker")

#: Stretches at which a sign is looked for, evenly spaced in ln λ, in each of tension and compression.
_SAMPLES = 1000


def first_instability(
    law: Law, mode: Mode, upper: float = 8.0, lower: float = 0.2, criterion: Criterion = "nominal"
) -> float | None:
    """Find the stretch nearest to 1 at which a law loses its stability in a test.

    Parameters
    ----------
    law : Law
        Any law, in invariants or in stretches.
    mode : {"uniaxial", "equibiaxial", "planar"}
        The test.
    upper, lower : float [-]
        Range of stretch that is searched; 1 leaves out tension or compression.
    criterion : {"nominal", "cauchy", "drucker"}
        What fails: ``"nominal"``, dP/dλ ≤ 0, where a specimen under a dead load runs away; ``"cauchy"``, dσ/dλ ≤ 0;
        ``"drucker"``, dτ : dε > 0 for every small change of the two free stretches, which finite element programs
        check. Drucker's postulate fails no later than the Cauchy stress falls, but the nominal stress may fall
        before; see `instabilities`.

    Returns
    -------
    float or None [-]
        None where the law is stable in the whole range.

    Examples
    --------
    >>> from turgor.core.materials.laws.laws import NeoHooke, Ogden
    >>> first_instability(NeoHooke(C10=0.12e6), "equibiaxial") is None
    True
    >>> wrong = Ogden(mu=(24361.0, 66.703, 453.81), alpha=(1.7138, 7.0679, -3.3659))
    >>> round(first_instability(wrong, "equibiaxial", lower=1.0), 3)
    1.643
    """
    if mode not in MODES:
        raise unknown("mode", mode, MODES)
    if criterion not in CRITERIA:
        raise unknown("criterion", criterion, CRITERIA)
    if not 0 < lower <= 1 <= upper < np.inf:
        raise TurgorError(f"the range {lower:g} to {upper:g} must hold stretch 1, with both ends positive and finite.")
    initial = float(_margin(law, mode, criterion, np.ones(1))[0])
    stretches = [s for s in (_first(law, mode, criterion, initial, end) for end in (upper, lower)) if s is not None]
    return min(stretches, key=lambda stretch: abs(np.log(stretch)), default=None)


def instabilities(law: Law, mode: Mode, upper: float = 8.0, lower: float = 0.2) -> dict[Criterion, float]:
    """Find the stretch at which each criterion first fails in a test, the strictest criterion first.

    Parameters
    ----------
    law, mode, upper, lower
        See `first_instability`.

    Returns
    -------
    dict of str to float [-]
        Criteria that fail, in the order of the distance of their stretch from 1; empty where the law is stable.

    Examples
    --------
    The nominal stress of this law falls before Drucker's postulate fails:

    >>> from turgor.core.materials.laws.laws import MooneyRivlin
    >>> law = MooneyRivlin(C10=35.68e3, C01=-9.17e3)
    >>> {name: round(at, 3) for name, at in instabilities(law, "equibiaxial", lower=1.0).items()}
    {'nominal': 1.389, 'drucker': 1.485, 'cauchy': 1.485}
    """
    first: dict[Criterion, float] = {}
    for criterion in ("nominal", "drucker", "cauchy"):
        at = first_instability(law, mode, upper, lower, criterion)
        if at is not None:
            first[criterion] = at
    # equal but for round-off: Drucker's postulate implies that the Cauchy stress rises
    return dict(sorted(first.items(), key=lambda item: round(abs(float(np.log(item[1]))), 9)))


def _first(law: Law, mode: Mode, criterion: Criterion, initial: float, end: float) -> float | None:
    """First stretch between 1 and an end where the margin is zero; beyond a locking stretch there is none."""
    stretches = np.exp(np.linspace(0.0, np.log(end), _SAMPLES))
    margin = _margin(law, mode, criterion, stretches)
    bad = np.flatnonzero(margin <= ROUND_OFF.zero * initial)
    if end == 1 or not len(bad):
        return None
    at = int(bad[0])
    if at == 0:
        return 1.0

    def of_stretch(stretch: float) -> float:
        return float(_margin(law, mode, criterion, np.array([stretch]))[0])

    return _root(of_stretch, float(stretches[at - 1]), float(stretches[at]))


def _root(function: Callable[[float], float], before: float, after: float) -> float:
    if function(after) >= 0:
        return after
    from scipy.optimize import brentq  # slow to load, and few laws lose their stability

    return float(brentq(function, min(before, after), max(before, after), xtol=1e-12))


def _margin(law: Law, mode: Mode, criterion: Criterion, stretch: Array) -> Array:
    """Moduli that are positive as long as the law is stable [Pa]."""
    if criterion == "drucker":
        return _drucker(law, mode, stretch)
    return _cauchy_slope(law, mode, stretch) if criterion == "cauchy" else _pull(law, mode, stretch)[1]


def _pull(law: Law, mode: Mode, stretch: Array) -> tuple[Array, Array]:
    """Nominal stress and its slope along the path of a test, by pulled direction."""
    _, pulled = MODES[mode]
    at, first, second = _path(law, mode, stretch)
    W = stretch_derivatives(law, *at)
    nominal = sum(W[1 + i] * first[i] for i in range(3))
    slope = sum(W[1 + i] * second[i] for i in range(3))
    for value, (i, j) in zip(W[4:], STRETCH_PAIRS, strict=True):
        slope = slope + (1 if i == j else 2) * value * first[i] * first[j]
    return np.asarray(nominal / pulled), np.asarray(slope / pulled)


def _path(law: Law, mode: Mode, stretch: Array) -> tuple[list[Array], list[Array], list[Array]]:
    """The three stretches along a test, and their first and second derivatives by the stretch.

    A foam has no traction across, so that second derivatives of those stretches do no work; they are left out.
    """
    powers, _ = MODES[mode]
    if isinstance(law, FoamLaw):
        return foam_path(law, powers, stretch)
    at = [stretch**n for n in powers]
    first = [n * stretch ** (n - 1) for n in powers]
    second = [n * (n - 1) * stretch ** (n - 2) for n in powers]
    return at, first, second


def _cauchy_slope(law: Law, mode: Mode, stretch: Array) -> Array:
    """Slope of the Cauchy stress times the area that it acts on, which is positive."""
    at, first, _ = _path(law, mode, stretch)
    nominal, slope = _pull(law, mode, stretch)
    return np.asarray(slope - nominal * (first[1] / at[1] + first[2] / at[2]))


def _drucker(law: Law, mode: Mode, stretch: Array) -> Array:
    """Smallest eigenvalue of ∂²W/∂εᵢ∂εⱼ for two free logarithmic strains, ε₃ = −ε₁ − ε₂; for all three of a foam."""
    at, _, _ = _path(law, mode, stretch)
    W = stretch_derivatives(law, *at)
    H = np.empty((3, 3, *stretch.shape))
    for value, (i, j) in zip(W[4:], STRETCH_PAIRS, strict=True):
        H[i, j] = H[j, i] = value * at[i] * at[j] + (W[1 + i] * at[i] if i == j else 0.0)
    if isinstance(law, FoamLaw):
        return np.asarray(np.linalg.eigvalsh(np.moveaxis(H, -1, 0))[..., 0])
    a = H[0, 0] - 2 * H[0, 2] + H[2, 2]
    b = H[1, 1] - 2 * H[1, 2] + H[2, 2]
    c = H[0, 1] - H[0, 2] - H[1, 2] + H[2, 2]
    return np.asarray(0.5 * (a + b) - np.sqrt(0.25 * (a - b) ** 2 + c**2))
