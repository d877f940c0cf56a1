"""Sections of straight edges: one grid whose lines follow all of them."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from turgor.core.geometry.shapes.sections import Outline
from turgor.core.meshing.sweeping.section import (
    SAME_LINE,
    Fineness,
    SectionMesh,
    divided,
    feature_lines,
    lattice_quads,
)

Array = NDArray[np.float64]


def grid_section(outlines: Sequence[Outline], fine: Fineness) -> SectionMesh | None:
    """Mesh outlines whose edges run along one axis, and otherwise along lines that never cross.

    Rectangles are the common case; slanted walls in a row and tapering outlines are others.

    Parameters
    ----------
    outlines : sequence of Outline
        What the lines must follow.
    fine : Fineness
        Longest edge; cells between two near lines are as short as these are apart.

    Returns
    -------
    SectionMesh or None
        None where the outlines are of another kind.

    Examples
    --------
    >>> from turgor.core.geometry.shapes.sections import rectangle
    >>> len(grid_section([rectangle((0, 4), (0, 2)), rectangle((1, 3), (0, 1))], Fineness(size=1.5)).quads)
    10
    """
    for axis in (1, 0):
        lines = _lines(outlines, axis)
        if lines is not None:
            return _ruled(*lines, axis, fine)
    return None


def _lines(outlines: Sequence[Outline], axis: int) -> tuple[Array, Array] | None:
    """Values of coordinate ``axis`` where edges run along the other one, and the lines of the other edges.

    Each line (2,) is where it passes the lowest and the highest of these values. None if lines cross.
    """
    corners = np.array([corner for outline in outlines for corner in outline.corners])
    scale = float(np.ptp(corners, axis=0).max())
    low, high = corners[:, axis].min(), corners[:, axis].max()
    levels, lines = [], []
    for outline in outlines:
        for a, b, arc in outline.edges:
            rise = b[axis] - a[axis]
            if arc:
                return None
            if abs(rise) <= SAME_LINE * scale:
                levels.append(a[axis])
            else:
                slope = (b[1 - axis] - a[1 - axis]) / rise
                lines.append([a[1 - axis] + slope * (end - a[axis]) for end in (low, high)])
    ends = np.array(lines)[np.lexsort(np.round(np.array(lines).T[::-1] / (SAME_LINE * scale)))]
    ends = ends[np.abs(np.diff(ends, axis=0, prepend=-np.inf)).max(axis=1) > 10 * SAME_LINE * scale]
    if (np.diff(ends, axis=0) < 10 * SAME_LINE * scale).any():
        return None
    # corners inside the box must lie on a level, or cells would not end there
    apart = np.abs(corners[:, axis][:, None] - feature_lines(np.array(levels), scale)).min(axis=1)
    return None if apart.max() > 10 * SAME_LINE * scale else (feature_lines(np.array(levels), scale), ends)


def _ruled(levels: Array, lines: Array, axis: int, fine: Fineness) -> SectionMesh:
    """Cells between levels of one coordinate and lines through the other."""
    across = divided(levels, fine)
    share = ((across - levels[0]) / (levels[-1] - levels[0]))[:, None]
    gaps = np.append(0.0, np.cumsum(np.diff(lines, axis=0).max(axis=1)))
    along = divided(gaps, fine)
    first, last = (np.interp(along, gaps, lines[:, end]) for end in (0, 1))
    places = (1 - share) * first + share * last  # (levels, lines)
    if axis == 1:
        u, v = places.T, np.broadcast_to(across, places.T.shape)
    else:
        u, v = np.broadcast_to(across[:, None], places.shape), places
    return SectionMesh(points=np.stack([u.ravel(), v.ravel()], axis=1), quads=lattice_quads(*u.shape))
