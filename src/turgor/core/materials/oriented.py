"""Materials with directions: their families of fibers at points of a body, and their stress in a homogeneous test."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from turgor.core.materials.laws.derivatives import energy_derivatives
from turgor.core.materials.laws.fiber_family import Family, family_response
from turgor.core.materials.laws.laws import FiberLaw
from turgor.core.materials.material import Material
from turgor.foundation.errors import TurgorError
from turgor.foundation.round_off import ROUND_OFF
from turgor.foundation.symmetric import COLUMNS, PAIRS, ROWS

Array = NDArray[np.float64]
Fibers = tuple[tuple[Family, Array], ...]


def families_at(material: Material, points: Array) -> Fibers:
    """Return each family of fibers of a material with its tensors H (..., 6) at points (..., 3) of the body [m].

    Parameters
    ----------
    material : Material
    points : (..., 3) array [m]
        At rest.
    """
    if not isinstance(material.law, FiberLaw) or material.orientation is None:
        return ()
    frames = material.orientation.frames(points)
    return tuple((each, each.tensor(frames)) for each in material.law.families(material.orientation.angle))


def oriented_stress(material: Material, F: Array, at: ArrayLike = (0.0, 0.0, 0.0)) -> Array:
    """Cauchy stress of an incompressible material with directions whose z direction is free of traction.

    Parameters
    ----------
    material : Material
        With a law such as `HolzapfelGasserOgden` or `Orthotropic`.
    F : (..., 3, 3) array [-]
        Deformation gradients of determinant 1, in the axes of the body.
    at : (float, float, float) [m]
        Where in the body, which matters for an orientation around an axis.

    Returns
    -------
    (..., 3, 3) array [Pa]

    Examples
    --------
    >>> from turgor.core.materials.laws.homogeneous import uniaxial
    >>> from turgor.core.materials.laws.laws import Orthotropic
    >>> from turgor.core.materials.orientation import Orientation
    >>> strands = Orientation(along=(1, 0, 0), across=(0, 1, 0))
    >>> printed = Material(name="print", law=Orthotropic(C10=1e6, a1=0.5e6), orientation=strands)
    >>> strain = 1e-6
    >>> round(float(oriented_stress(printed, uniaxial(1 + strain))[0, 0]) / strain / 1e6, 3)  # 6 C10 + 4 a1
    8.0
    """
    if not isinstance(material.law, FiberLaw):
        raise TurgorError(f"material '{material.name}' has no directions; take the stress of its law.")
    F = np.asarray(F, dtype=np.float64)
    worst = float(np.abs(np.linalg.det(F) - 1.0).max(initial=0.0))
    if not worst <= ROUND_OFF.same:
        raise TurgorError(f"det F differs from 1 by {worst:.3g}; the stress is for volume-preserving deformations.")
    C = F.swapaxes(-1, -2) @ F
    I1 = np.trace(C, axis1=-2, axis2=-1)
    I2 = 0.5 * (I1**2 - np.trace(C @ C, axis1=-2, axis2=-1))
    W1, W2, *_ = (w[..., None, None] for w in energy_derivatives(material.law.matrix, I1, I2))
    B = F @ F.swapaxes(-1, -2)
    extra = 2.0 * W1 * B + 2.0 * W2 * (I1[..., None, None] * B - B @ B)
    components = np.ascontiguousarray(C[..., ROWS, COLUMNS])
    points = np.broadcast_to(np.asarray(at, dtype=np.float64), (*F.shape[:-2], 3))
    for family, H in families_at(material, points):
        S, _ = family_response(family, H, components)
        second = np.empty(F.shape)
        for v, (i, j) in enumerate(PAIRS):
            second[..., i, j] = second[..., j, i] = S[..., v]
        extra = extra + F @ second @ F.swapaxes(-1, -2)
    return np.asarray(extra - extra[..., 2, 2][..., None, None] * np.eye(3))
