"""Mass and weight of reference points: constant matrices and vectors on their nodes."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.algebra.pattern import Pattern, locate, scatter_add
from turgor.core.engine.points.point_unknowns import Carrier
from turgor.core.model.model import Model

Array = NDArray[np.float64]


def add_point_masses(data: Array, pattern: Pattern, model: Model, carriers: Sequence[Carrier], scale: float) -> None:
    """Add the masses of the points and of what hangs from them to the lower triangle of a mass matrix, in place.

    With the velocity Ṗ + Σ Xⱼ ẏⱼ / r of every particle the kinetic energy is quadratic with a constant matrix.

    Parameters
    ----------
    data : (nnz,) array
    pattern : Pattern
    model : Model
    carriers : sequence of Carrier
    scale : float [1/kg]
        Scaled mass of 1 kg.
    """
    shared = scale / model.mesh.symmetry_factor
    for each in carriers:
        hanging = sum(load.attached_mass for load in model.loads if load.place == each.point.name)
        local = shared * _matrix(each)
        local[0, 0] += shared * hanging
        if not local.any():
            continue
        a, b = np.tril_indices(4)
        for axis in range(3):
            rows, columns = 3 * (each.node + a) + axis, 3 * (each.node + b) + axis
            scatter_add(data, locate(pattern.indptr, pattern.indices, rows, columns), local[a, b])


def attached_mass(model: Model) -> float:
    """Return the mass of all reference points and of what hangs from them [kg].

    Parameters
    ----------
    model : Model

    Returns
    -------
    float
    """
    hanging = sum(load.attached_mass for load in model.loads)
    return hanging + sum(point.mass for point in model.points.values())


def _matrix(carrier: Carrier) -> Array:
    """Masses (4, 4) [kg] of place and arrows."""
    point, arm = carrier.point, offset(carrier)
    euler = np.diag(0.5 * sum(point.inertia) - np.array(point.inertia)) + point.mass * np.outer(arm, arm)
    out = np.zeros((4, 4))
    out[0, 0] = point.mass
    out[0, 1:] = out[1:, 0] = point.mass * arm / carrier.radius
    out[1:, 1:] = euler / carrier.radius**2
    return out


def weights_of(carrier: Carrier) -> Array:
    """Masses (4,) [kg] of place and arrows under gravity."""
    return carrier.point.mass * np.concatenate([[1.0], offset(carrier) / carrier.radius])


def offset(carrier: Carrier) -> Array:
    """From the point to its center of mass at rest (3,) [m]."""
    if carrier.point.center is None:
        return np.zeros(3)
    arm = np.array(carrier.point.center) - carrier.at
    arm[list(carrier.blocked)] = 0.0  # that of the whole plate
    return arm
