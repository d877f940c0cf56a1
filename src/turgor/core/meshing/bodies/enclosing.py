"""Whether the sides of a face enclose a cavity, or are an open surface."""

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from turgor.core.geometry.shapes.tolerances import TOLERANCE
from turgor.core.meshing.cells import side_type

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


def encloses_cavity(points: Array, sides: Ints, mirrors: Mapping[int, float], at_mirror: NDArray[np.bool_]) -> bool:
    """Whether sides with normals out of the solid enclose a cavity: closed, or open like a pocket, not like a plane.

    A closed surface always does, even where it holds nothing yet, as a slit that the pressure opens.

    Parameters
    ----------
    points : (n, 3) array [m]
    sides : (f, 6), (f, 8) or (f, 9) int array
    mirrors : mapping of int to float
        Position of each mirror plane by the axis along its normal [m].
    at_mirror : (n,) bool array
        Nodes in mirror planes, where a surface may end.

    Returns
    -------
    bool

    Examples
    --------
    >>> points = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0.5, 0, 0], [0.5, 0.5, 0], [0, 0.5, 0]])
    >>> encloses_cavity(points, np.arange(6)[None], {}, np.zeros(6, dtype=bool))
    False
    """
    kind = side_type(sides.shape[1])
    corners = points[sides[:, : kind.corners]]
    edges = np.sort(np.concatenate([sides[:, [a, b]] for a, b in kind.edges]), axis=1)
    ends, count = np.unique(edges, axis=0, return_counts=True)
    rim = ends[count == 1]
    rim = rim[~at_mirror[rim].all(axis=1)]
    if not len(rim):
        return True
    origin = points[rim].mean(axis=(0, 1))
    for axis, level in mirrors.items():
        origin[axis] = level  # seen from there the missing walls enclose nothing
    p = corners - origin
    first, second = (
        (p[:, 2] - p[:, 0], p[:, 3] - p[:, 1]) if kind.corners == 4 else (p[:, 1] - p[:, 0], p[:, 2] - p[:, 0])
    )
    areas = np.cross(first, second) / 2
    volume = -float(np.einsum("fi,fi->", p.mean(axis=1), areas)) / 3
    return volume > TOLERANCE.round_off * float(np.linalg.norm(areas, axis=1).sum()) ** 1.5
