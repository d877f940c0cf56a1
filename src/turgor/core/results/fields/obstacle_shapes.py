"""Obstacles as triangles, for pictures and for ParaView."""

from itertools import product

import numpy as np
from numpy.typing import NDArray

from turgor.core.model.obstacles import Box, Cylinder, Plane, RigidSurface, Shape, Sphere

Array = NDArray[np.float64]
Ints = NDArray[np.int64]

#: Number of segments of a circle.
AROUND = 96

#: Margin on each side by which infinite shapes exceed the actuator, as a share of its size.
BEYOND = 0.15


def outline(shape: Shape, place: Array, extent: Array) -> tuple[Array, Ints]:
    """Triangulate the surface of an obstacle.

    Planes and infinite cylinders end a little beyond the extent of the actuator.

    Parameters
    ----------
    shape : Plane, Sphere, Cylinder, Box or RigidSurface
    place : (3,) array [m]
        Displacement of the obstacle.
    extent : (2, 3) array [m]
        Least and greatest coordinates of the actuator.

    Returns
    -------
    points : (p, 3) array [m]
    triangles : (t, 3) int array
        Counterclockwise seen from outside.

    Examples
    --------
    >>> import numpy as np
    >>> ground = Plane(point=(0, 0, -1e-3), normal=(0, 0, 1))
    >>> points, triangles = outline(ground, np.zeros(3), np.array([[0, 0, 0], [0.1, 0.02, 0.02]]))
    >>> np.ptp(points, axis=0).round(6).tolist()
    [0.13, 0.05, 0.0]
    """
    match shape:
        case Plane():
            points, triangles = _rectangle(shape, place, extent)
        case Sphere():
            points, triangles = _rounded_block(np.full(3, shape.radius), shape.radius)
            points = points + shape.center
        case Cylinder():
            points, triangles = _cylinder(shape, place, extent)
        case Box():
            points, triangles = _rounded_block(np.array(shape.size) / 2, shape.rounding)
            points = points + shape.center
        case RigidSurface():
            points, triangles = shape.points, shape.triangles
    return points + place, triangles


def _frame(direction: Array) -> tuple[Array, Array]:
    """Two unit vectors perpendicular to a direction; the first lies as close to x, y or z as possible."""
    first = np.eye(3)[np.abs(direction).argmin()]
    first = first - (first @ direction) * direction
    first /= np.linalg.norm(first)
    return first, np.cross(direction, first)


def _rectangle(shape: Plane, place: Array, extent: Array) -> tuple[Array, Ints]:
    """Rectangle of a plane that covers the projection of the actuator, with a margin."""
    normal, origin = np.array(shape.normal), np.array(shape.point) + place
    axes = np.stack(_frame(normal))
    corners = np.array(list(product(*extent.T)))
    shadow = (corners - origin) @ axes.T
    margin = BEYOND * float(np.ptp(extent, axis=0).max())
    low, high = shadow.min(axis=0) - margin, shadow.max(axis=0) + margin
    across = np.array([[low[0], low[1]], [high[0], low[1]], [high[0], high[1]], [low[0], high[1]]])
    return np.array(shape.point) + across @ axes, np.array([[0, 1, 2], [0, 2, 3]])


def _cylinder(shape: Cylinder, place: Array, extent: Array) -> tuple[Array, Ints]:
    """A cylinder with flat ends; an infinite cylinder ends a little beyond the actuator."""
    axis, center = np.array(shape.axis), np.array(shape.center)
    if shape.length is None:
        along = (np.array(list(product(*extent.T))) - center - place) @ axis
        margin = BEYOND * float(np.ptp(extent, axis=0).max())
        ends = np.array([along.min() - margin, along.max() + margin])
    else:
        ends = np.array([-0.5, 0.5]) * shape.length
    first, second = _frame(axis)
    angle = 2 * np.pi * np.arange(AROUND) / AROUND
    ring = center + shape.radius * (np.outer(np.cos(angle), first) + np.outer(np.sin(angle), second))
    middle = center + np.outer(ends, axis)
    points = np.concatenate([ring + ends[0] * axis, ring + ends[1] * axis, middle])
    here = np.arange(AROUND)
    there = (here + 1) % AROUND
    below, above = np.full(AROUND, 2 * AROUND), np.full(AROUND, 2 * AROUND + 1)
    faces = ((here, there, there + AROUND), (here, there + AROUND, here + AROUND),
             (below, there, here), (above, here + AROUND, there + AROUND))  # fmt: skip
    return points, np.concatenate([np.stack(face, axis=1) for face in faces])


def _rounded_block(half: Array, radius: float) -> tuple[Array, Ints]:
    """A block of half lengths ``half`` with rounded edges; a sphere if each half length equals the radius."""
    core = half - radius
    angles = np.tan(np.linspace(-np.pi / 4, np.pi / 4, AROUND // 4 + 1))
    points, triangles, count = [], [], 0
    for axis, side in product(range(3), (-1, 1)):
        i, j = (axis + 1) % 3, (axis + 2) % 3
        u, v = (_lines(core[k], radius, angles) for k in (i, j))
        grid = np.empty((len(u), len(v), 3))
        grid[..., axis], grid[..., i], grid[..., j] = side * half[axis], u[:, None], v[None, :]
        number = count + np.arange(len(u) * len(v)).reshape(len(u), len(v))
        a, b, c, d = (part.ravel() for part in (number[:-1, :-1], number[1:, :-1], number[1:, 1:], number[:-1, 1:]))
        around = (a, b, c, d) if side > 0 else (a, d, c, b)
        triangles += [np.stack([around[k] for k in corners], axis=1) for corners in ((0, 1, 2), (0, 2, 3))]
        points.append(grid.reshape(-1, 3))
        count += len(points[-1])
    cube = np.concatenate(points)
    inner = np.clip(cube, -core, core)
    away = cube - inner
    length = np.linalg.norm(away, axis=1, keepdims=True)
    return _welded(inner + radius * away / np.where(length > 0, length, 1.0), np.concatenate(triangles))


def _lines(core: float, radius: float, angles: Array) -> Array:
    """Grid coordinates over one side of a block: the ends of the flat part, and equal angles over the rounded edges."""
    upper = core + radius * angles[angles >= 0]
    return np.unique(np.concatenate([-upper, upper]).round(12)) if radius > 0 else np.array([-core, core])


def _welded(points: Array, triangles: Ints) -> tuple[Array, Ints]:
    """Merge coincident points, so that normals are continuous over seams, and drop triangles without area."""
    fine = 1e-9 * float(np.abs(points).max())
    _, first, same = np.unique((points / fine / 100).round(), axis=0, return_index=True, return_inverse=True)
    triangles = same.ravel()[triangles]
    whole = (triangles != np.roll(triangles, 1, axis=1)).all(axis=1)
    return points[first], triangles[whole]
