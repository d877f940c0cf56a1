"""Supports as prescribed displacement components."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.errors import TurgorError
from turgor.meshing.mesh import Mesh
from turgor.meshing.surface import outer_triangles
from turgor.model.model import Model
from turgor.model.supports import Displacement, Fixed, Support, Symmetry

AXES = "xyz"


@dataclass(frozen=True, slots=True, eq=False)
class Held:
    """Which displacement components are prescribed, and the functions that move some of them.

    Parameters
    ----------
    mask : (n, 3) bool array
    moving : tuple of (nodes, axes, Displacement)
    """

    mask: NDArray[np.bool_]
    moving: tuple[tuple[NDArray[np.int64], list[int], Displacement], ...]

    def values(self, points: NDArray[np.float64], load_factor: float) -> NDArray[np.float64]:
        """Prescribed displacement (n, 3) [m] at a load factor, zero where nothing is prescribed."""
        out = np.zeros_like(points)
        for nodes, axes, support in self.moving:
            value = np.asarray(support.value(points[nodes], load_factor), dtype=np.float64)
            out[nodes[:, None], axes] = np.broadcast_to(value, (len(nodes), 3))[:, axes]
        return out


def held_components(model: Model) -> Held:
    """Collect what the supports of a model prescribe."""
    mask = np.zeros((len(model.mesh.points), 3), dtype=bool)
    moving = []
    for support in model.supports:
        nodes = np.unique(outer_triangles(model.mesh)) if support.face == "*" else model.mesh.face_nodes(support.face)
        axes = _axes(model.mesh, support)
        mask[nodes[:, None], axes] = True
        if isinstance(support, Displacement):
            moving.append((nodes, axes, support))
    return Held(mask, tuple(moving))


def _axes(mesh: Mesh, support: Support) -> list[int]:
    if isinstance(support, Symmetry):
        extent = np.ptp(mesh.points[mesh.face_nodes(support.face)], axis=0)
        axis = int(extent.argmin())
        if extent[axis] > 1e-6 * extent.max():
            raise TurgorError(f"face '{support.face}' is not a coordinate plane; a mirror plane must be one.")
        return [axis]
    unknown = set(support.directions) - set(AXES)
    if unknown or not support.directions:
        raise TurgorError(
            f"{type(support).__name__} of '{support.face}': directions is '{support.directions}'; "
            "allowed are the letters x, y and z."
        )
    assert isinstance(support, Fixed | Displacement)
    return [AXES.index(letter) for letter in support.directions]
