"""Homogeneous deformations of an incompressible solid: the four tests of a rubber, and the stress of any law in them.

A deformation gradient comes in, a stress goes out, derived from the law's energy by one chain rule; the hydrostatic
multiplier follows from the third direction being free of traction. Of a foam, the stretches across follow from that
(`turgor.core.materials.laws.released`). Fitting, curves and verification share this.
"""

from collections.abc import Callable, Mapping
from types import MappingProxyType

import numpy as np
from numpy.typing import ArrayLike, NDArray

from turgor.core.materials.laws.derivatives import energy_derivatives, require_isotropic, stretch_derivatives
from turgor.core.materials.laws.laws import FoamLaw, InvariantLaw, Law, StretchLaw
from turgor.core.materials.laws.released import released
from turgor.foundation.errors import TurgorError
from turgor.foundation.round_off import ROUND_OFF

Array = NDArray[np.float64]


def uniaxial(stretch: ArrayLike) -> Array:
    """Deformation gradient of uniaxial tension or compression along the first axis.

    Parameters
    ----------
    stretch : (n,) array or float [-]
        Length over initial length, positive.

    Returns
    -------
    (n, 3, 3) array, or (3, 3) for a single stretch

    Examples
    --------
    >>> uniaxial(4.0).diagonal()
    array([4. , 0.5, 0.5])
    """
    stretch = _positive(stretch)
    return _diagonal(stretch, stretch**-0.5, stretch**-0.5)


def equibiaxial(stretch: ArrayLike) -> Array:
    """Deformation gradient of equal tension along the first and second axis, as in a balloon.

    Parameters
    ----------
    stretch : (n,) array or float [-]
        Length over initial length, positive.

    Returns
    -------
    (n, 3, 3) array, or (3, 3) for a single stretch

    Examples
    --------
    >>> equibiaxial(2.0).diagonal()
    array([2.  , 2.  , 0.25])
    """
    stretch = _positive(stretch)
    return _diagonal(stretch, stretch, stretch**-2.0)


def planar(stretch: ArrayLike) -> Array:
    """Deformation gradient of planar tension (pure shear) along the first axis, at constant width along the second.

    Parameters
    ----------
    stretch : (n,) array or float [-]
        Length over initial length, positive.

    Returns
    -------
    (n, 3, 3) array, or (3, 3) for a single stretch

    Examples
    --------
    >>> planar(2.0).diagonal()
    array([2. , 1. , 0.5])
    """
    stretch = _positive(stretch)
    return _diagonal(stretch, np.ones_like(stretch), 1.0 / stretch)


def biaxial(first: ArrayLike, second: ArrayLike) -> Array:
    """Deformation gradient of general biaxial tension along the first and second axis, the third free.

    Parameters
    ----------
    first, second : (n,) array or float [-]
        Length over initial length along the two axes, positive.

    Returns
    -------
    (n, 3, 3) array, or (3, 3) for single stretches

    Examples
    --------
    >>> biaxial(2.0, 1.25).diagonal()
    array([2.  , 1.25, 0.4 ])
    """
    first, second = _positive(first), _positive(second)
    return _diagonal(first, second, 1.0 / (first * second))


def simple_shear(amount: ArrayLike) -> Array:
    """Deformation gradient of simple shear x = X + γ Y.

    Parameters
    ----------
    amount : (n,) array or float [-]
        Amount of shear γ, any sign.

    Returns
    -------
    (n, 3, 3) array, or (3, 3) for a single amount

    Examples
    --------
    >>> simple_shear(0.5)
    array([[1. , 0.5, 0. ],
           [0. , 1. , 0. ],
           [0. , 0. , 1. ]])
    """
    amount = np.asarray(amount, dtype=np.float64)
    F = _diagonal(np.ones_like(amount), np.ones_like(amount), np.ones_like(amount))
    F[..., 0, 1] = amount
    return F


#: Deformation of each test of a rubber that one number describes, by the name of its mode.
DEFORMATIONS: Mapping[str, Callable[[ArrayLike], Array]] = MappingProxyType(
    {"uniaxial": uniaxial, "equibiaxial": equibiaxial, "planar": planar, "simple_shear": simple_shear}
)


def cauchy_stress(law: Law, F: Array) -> Array:
    """Cauchy stress of an incompressible solid, or of a foam, whose third direction is free of traction.

    From W(I₁, I₂): σ = 2 W₁ B + 2 W₂ (I₁ B − B²) − p 1 with B = F Fᵀ, and p such that σ₃₃ = 0. From W(λ₁, λ₂, λ₃):
    σ = Σ λᵢ ∂W/∂λᵢ nᵢ⊗nᵢ − p 1 in the principal frame of B, which any frame is where stretches are equal. A foam has
    σ = Σ λᵢ ∂W/∂λᵢ nᵢ⊗nᵢ / J at the stretches across that its test leaves free.

    Parameters
    ----------
    law : Law
        Any law, in invariants or in stretches.
    F : (..., 3, 3) array [-]
        Deformation gradients of determinant 1, as from `uniaxial` or `simple_shear`.

    Returns
    -------
    (..., 3, 3) array [Pa]

    Raises
    ------
    TurgorError
        If a deformation changes the volume, or the law is none of a rubber.

    Examples
    --------
    >>> from turgor.core.materials.laws.laws import NeoHooke
    >>> stress = cauchy_stress(NeoHooke(C10=0.12e6), simple_shear(1.0))
    >>> [round(float(s), 6) for s in (stress[0, 1], stress[0, 0], stress[1, 1])]
    [240000.0, 240000.0, 0.0]
    """
    require_isotropic(type(law))
    if not isinstance(law, Law):
        raise TurgorError(
            f"{type(law).__name__} has no energy in invariants or stretches; give a law such as NeoHooke or Ogden."
        )
    F = np.asarray(F, dtype=np.float64)
    determinant = np.linalg.det(F)
    worst = float(np.abs(determinant - 1.0).max(initial=0.0))
    if not worst <= ROUND_OFF.same:
        raise TurgorError(
            f"det F differs from 1 by {worst:.3g}; these stresses are for volume-preserving deformations."
        )
    if isinstance(law, FoamLaw):
        F = released(law, F)
        return np.asarray(_from_stretches(law, F @ F.swapaxes(-1, -2)) / np.linalg.det(F)[..., None, None])
    B = F @ F.swapaxes(-1, -2)
    extra = _from_stretches(law, B) if isinstance(law, StretchLaw) else _from_invariants(law, B)
    return np.asarray(extra - extra[..., 2, 2][..., None, None] * np.eye(3))


def nominal_stress(law: Law, F: Array) -> Array:
    """Nominal (first Piola–Kirchhoff) stress P = J σ F⁻ᵀ [Pa], force per initial area; see `cauchy_stress`.

    The pull of a tension test is ``[..., 0, 0]``; the force that holds the width in planar tension ``[..., 1, 1]``.

    Parameters
    ----------
    law : Law
        Any law, in invariants or in stretches.
    F : (..., 3, 3) array [-]
        Deformation gradients of determinant 1.

    Returns
    -------
    (..., 3, 3) array [Pa]

    Examples
    --------
    >>> from turgor.core.materials.laws.laws import Yeoh
    >>> law = Yeoh(C10=0.11e6, C20=0.02e6)
    >>> nominal_stress(law, uniaxial([1.5, 2.0]))[:, 0, 0].round(1)
    array([281481.5, 665000. ])
    """
    stress = cauchy_stress(law, F)
    if isinstance(law, FoamLaw):
        F = released(law, np.asarray(F, dtype=np.float64))
        stress = np.linalg.det(F)[..., None, None] * stress
    return np.asarray(stress @ np.linalg.inv(F).swapaxes(-1, -2))


def _from_invariants(law: InvariantLaw, B: Array) -> Array:
    """Cauchy stress but for its mean, of a law in invariants."""
    I1 = np.trace(B, axis1=-2, axis2=-1)
    I2 = 0.5 * (I1**2 - np.trace(B @ B, axis1=-2, axis2=-1))
    W1, W2, *_ = (w[..., None, None] for w in energy_derivatives(law, I1, I2))
    return np.asarray(2.0 * W1 * B + 2.0 * W2 * (I1[..., None, None] * B - B @ B))


def _from_stretches(law: StretchLaw, B: Array) -> Array:
    """Σ λᵢ ∂W/∂λᵢ nᵢ⊗nᵢ of a law in stretches: the Cauchy stress but for its mean, or J σ of a foam."""
    squares, directions = np.linalg.eigh(B)
    stretches = np.sqrt(squares)
    slopes = stretch_derivatives(law, stretches[..., 0], stretches[..., 1], stretches[..., 2])[1:4]
    principal = stretches * np.stack(slopes, axis=-1)
    return np.asarray((directions * principal[..., None, :]) @ directions.swapaxes(-1, -2))


def _diagonal(*stretches: Array) -> Array:
    values = np.stack(np.broadcast_arrays(*stretches), axis=-1)
    return np.asarray(values[..., None] * np.eye(3))


def _positive(stretch: ArrayLike) -> Array:
    values = np.asarray(stretch, dtype=np.float64)
    if not (values > 0).all():
        raise TurgorError(f"stretch is {float(values.min()):g}; a stretch is length over initial length, more than 0.")
    return values
