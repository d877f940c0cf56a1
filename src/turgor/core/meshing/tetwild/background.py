"""Sizes of cells in space: a lattice of tetrahedra around a part, small near faces with a size of their own."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from turgor.core.geometry.cad.surface.shape import SurfaceShape
from turgor.core.meshing.tetwild.settings import TETWILD

Array = NDArray[np.float64]
Ints = NDArray[np.int64]

#: The six tetrahedra of a cube whose corners are numbered by their bits (Kuhn 1960).
_KUHN = ((0, 1, 3, 7), (0, 1, 5, 7), (0, 2, 3, 7), (0, 2, 6, 7), (0, 4, 5, 7), (0, 4, 6, 7))


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Background:
    """Sizes at the corners of tetrahedra: points (n, 3), cells (m, 4) and values (n,), all in CAD units."""

    points: Array
    cells: Ints
    values: Array


def background(shape: SurfaceShape, size: float, face_sizes: Mapping[str, float], grading: float) -> Background:
    """Sizes that grow away from faces with a size of their own.

    Parameters
    ----------
    shape : SurfaceShape
    size : float [CAD units]
        Largest size.
    face_sizes : mapping of str to float [CAD units]
    grading : float [-]
        By how much the size grows over a distance, per length.
    """
    low, high = shape.points.min(axis=0) - size, shape.points.max(axis=0) + size
    spacing = max(min(face_sizes.values()), (float(np.prod(high - low)) / TETWILD.background_points) ** (1 / 3))
    count = np.ceil((high - low) / spacing).astype(int) + 1
    axes = [np.linspace(low[i], high[i], count[i]) for i in range(3)]
    points = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)
    number = np.arange(len(points)).reshape(count)
    corners = np.stack(
        [
            number[i : count[0] - 1 + i, j : count[1] - 1 + j, k : count[2] - 1 + k].ravel()
            for k in (0, 1)
            for j in (0, 1)
            for i in (0, 1)
        ],
        axis=1,
    )
    values = np.full(len(points), size)
    for name, own in face_sizes.items():
        rows = np.isin(shape.face, [i for i, face in enumerate(shape.faces) if face.name == name])
        distance = cKDTree(shape.corners[rows].mean(axis=1)).query(points)[0]
        values = np.minimum(values, np.maximum(own, own + grading * (distance - spacing)))
    return Background(points=points, cells=corners[:, np.array(_KUHN)].reshape(-1, 4), values=values)
