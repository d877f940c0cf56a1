"""Where a mold parts: along which axis its two halves are pulled, and from which plane."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

#: Facets are walls along the pull if the sine of their slope is below this: the facets of a curved wall round as much.
SLOPE = 1e-3

#: Heights at which a plane is tried, between the lowest and the highest facet.
PLANES = 400


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Parting:
    """Plane across an axis from which two halves come off, and what holds them back.

    Parameters
    ----------
    axis : int
        Axis of the pull: 0, 1 or 2.
    height : float [CAD units]
        Place of the plane on that axis.
    undercut : float [CAD units²]
        Area that looks away from the pull of its half.
    place : (3,) float array [CAD units]
        Middle of that area; of the part where there is none.
    """

    axis: int
    height: float
    undercut: float
    place: Array


def partings(corners: Array) -> list[Parting]:
    """Return the best plane across each axis, the one with the least undercut first; of equal ones z before y before x.

    Every line along the pull must leave the casting once. So above the plane no facet may look down, and below it
    none up.

    Parameters
    ----------
    corners : (t, 3, 3) float array [CAD units]
        Facets of the outside of the casting, with normals that point out.

    Examples
    --------
    >>> square = np.array([[[0, 0, 0], [0, 1, 0], [1, 0, 0]], [[0, 0, 1], [1, 0, 1], [0, 1, 1]]], dtype=float)
    >>> best = partings(square)[0]
    >>> best.axis, best.height, best.undercut
    (2, 0.0, 0.0)
    """
    return sorted((_parting(corners, axis) for axis in (2, 1, 0)), key=lambda each: round(each.undercut, 6))


def areas(corners: Array) -> tuple[Array, Array]:
    """Return the areas and unit normals of facets."""
    double = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    length = np.linalg.norm(double, axis=1)
    return length / 2, double / np.where(length > 0, length, 1.0)[:, None]


def undercut_of(corners: Array, axis: int, height: float) -> float:
    """Return the area of facets that look away from the pull of their half [CAD units²].

    Parameters
    ----------
    corners : (t, 3, 3) float array [CAD units]
        Facets of the outside of the casting, with normals that point out.
    axis : int
        Axis of the pull.
    height : float [CAD units]
        Place of the parting plane on that axis.

    Examples
    --------
    >>> roof = np.array([[[0, 0, 1], [1, 0, 1], [0, 1, 1]]], dtype=float)
    >>> undercut_of(roof, 2, 0.0), undercut_of(roof, 2, 2.0)
    (0.0, 0.5)
    """
    area, normal = areas(corners)
    at, slope = corners.mean(axis=1)[:, axis], normal[:, axis]
    return float(area[_wrong(at, slope > SLOPE, slope < -SLOPE, height)].sum())


def _parting(corners: Array, axis: int) -> Parting:
    area, normal = areas(corners)
    middle, slope = corners.mean(axis=1), normal[:, axis]
    at, up, down = middle[:, axis], slope > SLOPE, slope < -SLOPE
    low, high = corners[..., axis].min(), corners[..., axis].max()
    # a plane at an end makes a flat half; between the highest facet that looks down and the lowest that looks up
    # every plane does, and the middle of them is the equator of a round part
    between = (at[down].max(initial=low) + at[up].min(initial=high)) / 2
    heights = np.array([low, high, between, *np.linspace(low, high, PLANES)]).round(6)
    wrong = [float(area[_wrong(at, up, down, height)].sum()) for height in heights]
    best = int(np.argmin(np.round(wrong, 6)))
    rows = _wrong(at, up, down, heights[best])
    weight = area[rows] if rows.any() else area
    place = np.average(middle[rows] if rows.any() else middle, axis=0, weights=weight)
    return Parting(axis=axis, height=float(heights[best]), undercut=wrong[best], place=place)


def _wrong(at: Array, up: NDArray[np.bool_], down: NDArray[np.bool_], height: float) -> NDArray[np.bool_]:
    """Facets that look away from the pull of their half."""
    return np.asarray((down & (at > height)) | (up & (at < height)))
