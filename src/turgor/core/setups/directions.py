"""Directions in a model that is cut at mirror planes."""

import numpy as np
from numpy.typing import NDArray

from turgor.core.meshing.mesh import Mesh
from turgor.foundation.errors import TurgorError


def mirrored_axes(mesh: Mesh) -> tuple[int, ...]:
    """Return the axes across which a half or quarter model is cut: 0, 1 or 2 for every face ``symmetry_*``."""
    return tuple(axis for axis, _ in mesh.mirror_planes)


def unmirrored(mesh: Mesh, vector: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return a vector (3,) without the parts that the mirror images of the modeled part take back."""
    out = np.array(vector, dtype=np.float64)
    out[list(mirrored_axes(mesh))] = 0.0
    return out


def check_unmirrored(mesh: Mesh, what: str, direction: str) -> None:
    """Refuse a direction across a mirror plane."""
    if "xyz".index(direction[1]) in mirrored_axes(mesh):
        raise TurgorError(
            f"{what} is '{direction}', across the mirror plane of a half model; model the whole actuator "
            "(symmetric=False), or choose a direction in the plane."
        )
