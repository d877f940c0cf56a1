"""Holes in a surface of triangles: found by their rims, and closed where they are plane or small."""

import numpy as np
from manifold3d import triangulate
from numpy.typing import NDArray

from turgor.core.geometry.cad.surface.settings import SURFACE
from turgor.foundation.errors import TurgorError

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


def close_holes(points: Array, triangles: Ints, name: str) -> tuple[Array, Ints, list[str]]:
    """Close the holes of a surface with plane caps.

    Parameters
    ----------
    points : (n, 3) array
    triangles : (t, 3) int array
        Neighbors need not look the same way.
    name : str
        Name of the file, for messages.

    Returns
    -------
    points, triangles : arrays
        With the caps.
    places : list of str
        Where each hole was, in units of the file.

    Raises
    ------
    TurgorError
        If a hole is neither plane nor small, or an edge has three, five, … triangles.
    """
    edges = np.sort(triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    edges, count = np.unique(edges, axis=0, return_counts=True)
    odd = edges[(count > 2) & (count % 2 == 1)]
    if len(odd):
        x, y, z = points[odd].mean(axis=(0, 1))
        raise TurgorError(
            f"'{name}' is no closed surface: {len(odd)} edges belong to an odd number of triangles above two, around "
            f"({x:.4g}, {y:.4g}, {z:.4g}) in units of the file; repair it, or export STEP instead."
        )
    extent, caps, places = float(np.ptp(points, axis=0).max()), [triangles], []
    for loop in _loops(edges[count == 1], points, name):
        at, size = points[loop].mean(axis=0), float(np.ptp(points[loop], axis=0).max())
        where = f"around ({at[0]:.4g}, {at[1]:.4g}, {at[2]:.4g})"
        flat = points[loop] - at
        _, _, axes = np.linalg.svd(flat, full_matrices=False)
        off = float(np.abs(flat @ axes[2]).max())
        if off > SURFACE.flat_rim * size and size > SURFACE.small_hole * extent:
            raise TurgorError(
                f"'{name}' is open {where} in units of the file: the hole is {size:.3g} wide and its rim is not plane "
                f"(it leaves its plane by {off:.2g}), so that a cap would be a guess; close it where the part was made."
            )
        caps.append(_cap(loop, flat @ axes[:2].T))
        places.append(where)
    return points, np.concatenate(caps), places


def _cap(loop: Ints, plane: Array) -> Ints:
    """Triangles across a rim, whose positions in a plane are given."""
    x, y = plane.T
    area = float(x @ np.roll(y, -1) - y @ np.roll(x, -1))
    order = np.arange(len(loop)) if area > 0 else np.arange(len(loop))[::-1]
    return np.asarray(loop[order][np.asarray(triangulate([np.ascontiguousarray(plane[order])]), dtype=np.int64)])


def _loops(edges: Ints, points: Array, name: str) -> list[Ints]:
    """Order the free edges of a surface into closed rims."""
    after: dict[int, list[int]] = {}
    for a, b in edges.tolist():
        after.setdefault(a, []).append(b)
        after.setdefault(b, []).append(a)
    knots = [node for node, others in after.items() if len(others) != 2]
    if knots:
        x, y, z = points[knots[0]]
        raise TurgorError(
            f"'{name}' is open around ({x:.4g}, {y:.4g}, {z:.4g}) in units of the file, and the holes there touch each "
            "other; close them where the part was made."
        )
    loops, remaining = [], set(after)
    while remaining:
        start = min(remaining)
        loop, last, at = [start], -1, start
        while True:
            following = next((node for node in after[at] if node != last), start)
            if following == start:
                break
            loop.append(following)
            last, at = at, following
        remaining -= set(loop)
        loops.append(np.array(loop, dtype=np.int64))
    return loops
