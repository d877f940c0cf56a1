"""Outlines: triangles of round and endless shapes, for pictures and for ParaView."""

from itertools import product

import numpy as np

from turgor.core.model.obstacles.rigid_shape import Array, Ints

#: Number of segments of a circle.
AROUND = 96

#: Margin on each side by which endless shapes exceed the actuator, as a share of its size.
BEYOND = 0.15


def span(origin: Array, axes: Array, extent: Array) -> tuple[Array, Array]:
    """Return the ends along axes (n, 3) of the box around the actuator, seen from an origin, with a margin."""
    shadow = (np.array(list(product(*extent.T))) - origin) @ axes.T
    margin = BEYOND * float(np.ptp(extent, axis=0).max())
    return shadow.min(axis=0) - margin, shadow.max(axis=0) + margin


def frame(direction: Array) -> tuple[Array, Array]:
    """Return two unit vectors perpendicular to a direction; the first lies as close to x, y or z as possible."""
    first = np.eye(3)[np.abs(direction).argmin()]
    first = first - (first @ direction) * direction
    first /= np.linalg.norm(first)
    return first, np.cross(direction, first)


def rounded_block(half: Array, radius: float) -> tuple[Array, Ints]:
    """Return triangles of a block of half lengths with rounded edges; a sphere if each is the radius."""
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
