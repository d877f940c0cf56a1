"""Foams in mixed cells: a small share of their resistance to a change of volume is that of the mean stress.

The energy of a mixed cell, W + p (J − 1) − p²/(2κ), is W + ½ κ (J − 1)² where p follows from it. A foam whose energy
W(λ₁, λ₂, λ₃) has the change of volume is therefore exactly W − ½ κ₀ (J − 1)² and a bulk modulus κ₀, whatever κ₀ is.
Nothing locks in it, so κ₀ is small: cells are then nearly those with displacements alone.
"""

import numpy as np
from numpy.typing import NDArray

from turgor.core.materials.laws.derivatives import stretch_derivatives
from turgor.core.materials.laws.laws import FoamLaw
from turgor.foundation.symmetric import PAIRS

Array = NDArray[np.float64]

#: κ₀ over the initial shear modulus: small against the least bulk modulus of a foam, ⅔ μ at a Poisson's ratio of zero,
#: so that the rest stays stable; large enough for a well conditioned tangent.
SHARE = 0.05


def foam_bulk(law: FoamLaw) -> float:
    """Bulk modulus κ₀ [Pa] that mixed cells of a foam have.

    Examples
    --------
    >>> from turgor.core.materials.laws.laws import BlatzKo
    >>> foam_bulk(BlatzKo(mu=30e3))
    1500.0
    """
    return SHARE * law.shear_modulus


def less_volume_energy(law: FoamLaw, stretches: Array) -> Array:
    """W − ½ κ₀ (J − 1)² [Pa] at principal stretches (3, ...)."""
    J = stretches.prod(axis=0)
    return np.asarray(stretch_derivatives(law, *stretches)[0] - 0.5 * foam_bulk(law) * (J - 1) ** 2)


def less_volume(law: FoamLaw, stretches: Array, W: Array, stress: float) -> Array:
    """First and second derivatives (9, ...) of W by the stretches, less those of ½ κ₀ (J − 1)², all over a stress."""
    kappa, out, J = foam_bulk(law) / stress, W.copy(), stretches.prod(axis=0)
    for i in range(3):
        out[i] -= kappa * (J - 1) * J / stretches[i]
    for k, (i, j) in enumerate(PAIRS, 3):
        slope = J if i == j else 2 * J - 1  # ∂(J − 1)J/∂λⱼ over J/(λᵢλⱼ), less what 1/λᵢ gives where i = j
        out[k] -= kappa * slope * J / (stretches[i] * stretches[j])
    return out
