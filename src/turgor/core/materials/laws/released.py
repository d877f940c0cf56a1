"""Homogeneous tests of a foam: the stretches across that leave the free directions without traction."""

import numpy as np
from numpy.typing import NDArray

from turgor.core.materials.laws.derivatives import STRETCH_PAIRS, stretch_derivatives
from turgor.core.materials.laws.laws import FoamLaw
from turgor.foundation.errors import TurgorError
from turgor.foundation.round_off import ROUND_OFF

Array = NDArray[np.float64]

#: Newton steps until a traction is zero; the start is exact for terms of one Poisson's ratio, and five do elsewhere.
_STEPS = 60

#: Largest change of a logarithmic stretch in one step [-].
_STEP = 0.3


def released(law: FoamLaw, F: Array) -> Array:
    """Deformation gradients of a test of a foam, from those of the same test at constant volume.

    The third direction is free of traction; so is the second where its stretch equals the third one without shear, as
    in uniaxial tension.

    Parameters
    ----------
    law : FoamLaw
    F : (..., 3, 3) array [-]
        As from `turgor.core.materials.laws.homogeneous.uniaxial`.

    Returns
    -------
    (..., 3, 3) array [-]

    Examples
    --------
    >>> from turgor.core.materials.laws.laws import BlatzKo
    >>> released(BlatzKo(mu=30e3), np.diag([16.0, 0.25, 0.25])).diagonal()  # across λ^(−1/4)
    array([16. ,  0.5,  0.5])
    """
    C = F.swapaxes(-1, -2) @ F
    tied = np.isclose(C[..., 1, 1], C[..., 2, 2], rtol=ROUND_OFF.same, atol=0.0) & (F[..., 0, 1] == 0)
    plane = np.sqrt(np.linalg.eigvalsh(C[..., :2, :2]))
    first = np.where(tied, np.sqrt(C[..., 0, 0]), plane[..., 1])
    across = across_stretch(law, first, plane[..., 0], tied)
    out = np.array(F, dtype=np.float64)
    out[..., 2, 2] = across
    out[..., 1, 1] = np.where(tied, across, out[..., 1, 1])
    return out


def across_stretch(law: FoamLaw, first: Array, second: Array, tied: Array) -> Array:
    """Stretch of the free directions of a foam.

    Parameters
    ----------
    law : FoamLaw
    first, second : array [-]
        Stretches that are prescribed; the second only where ``tied`` is false.
    tied : array of bool
        Where the second direction is free like the third.

    Returns
    -------
    array [-]

    Raises
    ------
    TurgorError
        If the traction across cannot be made zero.
    """
    nu = initial_poisson(law)
    z = np.where(tied, -nu * np.log(first), -nu / (1 - nu) * np.log(first * second))
    for _ in range(_STEPS):
        traction, slope = _traction(law, first, second, z, tied)
        step = np.clip(-traction / slope, -_STEP, _STEP)
        z = z + np.where(slope > 0, step, -np.sign(traction) * _STEP)
        if not np.abs(step).max(initial=0.0) > ROUND_OFF.zero:
            return np.asarray(np.exp(z))
    worst = float(first.flat[np.abs(step).argmax()])
    raise TurgorError(
        f"{type(law).__name__}: at a stretch of {worst:g} no stretch across makes the traction there zero; the law is "
        "unstable there."
    )


def foam_path(
    law: FoamLaw, powers: tuple[float, float, float], stretch: Array
) -> tuple[list[Array], list[Array], list[Array]]:
    """The three stretches of a foam along a test, and their first and second derivatives by the stretch.

    Parameters
    ----------
    law : FoamLaw
    powers : tuple of float
        Those of the stretches at constant volume; a direction with a negative one is free, and so is its traction.
    stretch : (n,) array [-]

    Returns
    -------
    three lists of (n,) arrays
        Second derivatives are zero: a free direction has no traction, so that its second derivative does no work.
    """
    tied = np.full(stretch.shape, powers[1] < 0)
    second = stretch ** max(powers[1], 0.0)
    at = [stretch, second, across_stretch(law, stretch, second, tied)]
    first = [np.ones_like(stretch), np.full(stretch.shape, max(powers[1], 0.0)), np.zeros_like(stretch)]
    at[1] = np.where(tied, at[2], at[1])
    H = dict(zip(STRETCH_PAIRS, stretch_derivatives(law, *at)[4:], strict=True))
    free = H[(2, 2)] + np.where(tied, H[(1, 1)] + 2 * H[(1, 2)], 0.0)
    pulled = H[(0, 2)] + H[(1, 2)] * first[1] + np.where(tied, H[(0, 1)], 0.0)
    first[2] = -pulled / free
    first[1] = np.where(tied, first[2], first[1])
    return at, first, [np.zeros_like(stretch)] * 3


def initial_poisson(law: FoamLaw) -> float:
    """Poisson's ratio of a foam at rest [-].

    Examples
    --------
    >>> from turgor.core.materials.laws.laws import BlatzKo
    >>> round(initial_poisson(BlatzKo(mu=30e3)), 9)
    0.25
    """
    ratio = law.bulk_modulus / law.shear_modulus
    return (3 * ratio - 2) / (2 * (3 * ratio + 1))


def _traction(law: FoamLaw, first: Array, second: Array, z: Array, tied: Array) -> tuple[Array, Array]:
    """∂W/∂z of the stretch e^z across, and its derivative, both over the shear modulus."""
    across = np.exp(z)
    l = (first, np.where(tied, across, second), across)
    W = stretch_derivatives(law, *l)
    H = dict(zip(STRETCH_PAIRS, W[4:], strict=True))
    force = W[3] * l[2] + np.where(tied, W[2] * l[1], 0.0)
    slope = force + H[(2, 2)] * l[2] ** 2
    slope = slope + np.where(tied, H[(1, 1)] * l[1] ** 2 + 2 * H[(1, 2)] * l[1] * l[2], 0.0)
    return force / law.shear_modulus, slope / law.shear_modulus
