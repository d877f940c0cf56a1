"""Places: points of a mesh that coincide."""

import numpy as np
from numpy.typing import NDArray

from turgor.core.geometry.shapes.tolerances import TOLERANCE
from turgor.core.meshing.bodies.groups import groups_of

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


def same_places(points: Array) -> tuple[Ints, Ints]:
    """Number points such that those in the same place share a number; the first of each place stands for it.

    Returns
    -------
    number : (p,) int array
        New number of each point.
    first : (n,) int array
        The point that stands for each number.

    Examples
    --------
    >>> number, first = same_places(np.array([[0.0, 1.0], [2.0, 1.0], [0.0, 1.0 + 1e-15]]))
    >>> number.tolist(), first.tolist()
    ([0, 1, 0], [0, 1])
    """
    from scipy.spatial import cKDTree  # slow to load, and the engine imports this file

    pairs = cKDTree(points).query_pairs(
        TOLERANCE.round_off * float(np.ptp(points, axis=0).max()), output_type="ndarray"
    )
    label = groups_of(len(points), pairs[:, 0], pairs[:, 1])
    _, first, number = np.unique(label, return_index=True, return_inverse=True)
    return number, first
