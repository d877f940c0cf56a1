"""Pairs of triangles that make good quadrilaterals together."""

import numpy as np
from numpy.typing import NDArray

from turgor.core.meshing.sweeping.settings import SECTION

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


def paired(points: Array, triangles: Ints, segments: Ints) -> tuple[Ints, Ints]:
    """Join triangles two by two into quadrilaterals, the squarest first; some triangles stay alone.

    Parameters
    ----------
    points : (n, 2) array
    triangles : (t, 3) int array
        Counterclockwise.
    segments : (s, 2) int array
        Edges that must stay.

    Returns
    -------
    triangles : (k, 3) int array
        Those that found no partner.
    quads : (q, 4) int array
        Counterclockwise.

    Examples
    --------
    >>> square = np.array([[0.0, 0], [1, 0], [1, 1], [0, 1]])
    >>> alone, quads = paired(square, np.array([[0, 1, 2], [0, 2, 3]]), np.zeros((0, 2), dtype=int))
    >>> len(alone), quads.tolist()
    (0, [[0, 1, 2, 3]])
    """
    edges = np.concatenate([triangles[:, [i, (i + 1) % 3]] for i in range(3)])
    size = len(triangles)
    keys = np.sort(edges, axis=1) @ np.array([len(points), 1])
    order = np.argsort(keys, kind="stable")
    same = np.flatnonzero(keys[order[1:]] == keys[order[:-1]])
    same = same[~np.isin(keys[order[same]], np.sort(segments, axis=1) @ np.array([len(points), 1]))]
    a, b = order[same], order[same + 1]
    opposite = np.concatenate([triangles[:, (i + 2) % 3] for i in range(3)])
    # a goes from p to q along the shared edge, b back: around them q, the third of a, p, the third of b
    quads = np.stack([edges[a, 1], opposite[a], edges[a, 0], opposite[b]], axis=1)
    quads = quads[:, [2, 3, 0, 1]]
    worth = corner_sines(points, quads).min(axis=1, initial=1.0)
    free, chosen = np.ones(size, dtype=bool), []
    for i in np.argsort(-worth, kind="stable"):
        first, second = a[i] % size, b[i] % size
        if worth[i] > SECTION.good_pair and free[first] and free[second]:
            free[first] = free[second] = False
            chosen.append(i)
    return triangles[free], quads[chosen].reshape(-1, 4)


def corner_sines(points: Array, cells: Ints) -> Array:
    """Sine of the angle at each corner of straight cells, (c, corners); negative where a corner is turned in."""
    corners = points[cells]
    ahead, back = np.roll(corners, -1, axis=1) - corners, np.roll(corners, 1, axis=1) - corners
    cross = ahead[..., 0] * back[..., 1] - ahead[..., 1] * back[..., 0]
    return np.asarray(cross / (np.linalg.norm(ahead, axis=2) * np.linalg.norm(back, axis=2)))
