"""Shapes: how far points are from a rigid body of simple shape, with the first and second derivatives.

The distance is positive outside. Inside, the nearest part of the surface counts, so that the distance is smooth across
the surface wherever the surface is. All lengths are in one unit, whichever; `scaled` brings a shape to another.
"""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from turgor.core.model.obstacles import Box, Cylinder, Plane, RigidSurface, Shape, Sphere, Vector
from turgor.foundation.round_off import ROUND_OFF

Array = NDArray[np.float64]

#: Distance, gradient, Hessian.
Distances = tuple[Array, Array, Array]

#: The shapes whose distance is a formula.
Formula = Plane | Sphere | Cylinder | Box


def signed_distance(shape: Formula, points: Array) -> Distances:
    """Compute the signed distance of points to a rigid body.

    The Hessian is exact wherever the distance is twice differentiable; on the planes between two regions, such as
    those through the ends of a cylinder, it is that of one of them.

    Parameters
    ----------
    shape : Plane, Sphere, Cylinder or Box
    points : (k, 3) array
        In the unit of the shape's lengths, and where the shape has not moved.

    Returns
    -------
    distance : (k,) array
        Positive outside, negative inside; in the same unit.
    gradient : (k, 3) array [-]
        The unit normal at the nearest point of the surface, out of the body.
    hessian : (k, 3, 3) array [1/length]

    Examples
    --------
    >>> distance, gradient, hessian = signed_distance(Sphere(center=(0, 0, 0), radius=2.0), np.array([[5.0, 0, 0]]))
    >>> distance, gradient
    (array([3.]), array([[1., 0., 0.]]))
    >>> hessian[0].diagonal()
    array([0. , 0.2, 0.2])
    """
    match shape:
        case Plane():
            return _plane(shape, points)
        case Sphere():
            return _sphere(shape, points)
        case Cylinder():
            return _cylinder(shape, points)
        case Box():
            return _box(shape, points)


def scaled(shape: Shape, length: float) -> Shape:
    """Return a shape whose lengths are in units of a length.

    Parameters
    ----------
    shape : Plane, Sphere, Cylinder, Box or RigidSurface
        In meters.
    length : float [m]
        The new unit.

    Returns
    -------
    Plane, Sphere, Cylinder, Box or RigidSurface

    Examples
    --------
    >>> scaled(Sphere(center=(0, 0, 0.002), radius=0.004), 0.001)
    Sphere(center=(0.0, 0.0, 2.0), radius=4.0)
    """
    match shape:
        case Plane():
            return replace(shape, point=_over(shape.point, length))
        case Sphere():
            return replace(shape, center=_over(shape.center, length), radius=shape.radius / length)
        case Cylinder():
            end = None if shape.length is None else shape.length / length
            return replace(shape, center=_over(shape.center, length), radius=shape.radius / length, length=end)
        case Box():
            size = _over(shape.size, length)
            rounding = min(shape.rounding / length, min(size) / 2)  # half a size may round to less than the rounding
            return replace(shape, center=_over(shape.center, length), size=size, rounding=rounding)
        case RigidSurface():
            return replace(shape, points=shape.points / length)


def _over(vector: Vector, length: float) -> Vector:
    x, y, z = vector
    return x / length, y / length, z / length


def _plane(shape: Plane, points: Array) -> Distances:
    normal = np.array(shape.normal)
    distance = (points - np.array(shape.point)) @ normal
    return distance, np.tile(normal, (len(points), 1)), np.zeros((len(points), 3, 3))


def _sphere(shape: Sphere, points: Array) -> Distances:
    length, out, bend = _from_center(points - np.array(shape.center), np.eye(3), ROUND_OFF.zero * shape.radius)
    return length - shape.radius, out, bend


def _cylinder(shape: Cylinder, points: Array) -> Distances:
    axis = np.array(shape.axis)
    from_center = points - np.array(shape.center)
    along = from_center @ axis
    across = np.eye(3) - np.outer(axis, axis)
    radial, out, bend = _from_center(from_center @ across, across, ROUND_OFF.zero * shape.radius)
    side = radial - shape.radius
    if shape.length is None:
        return side, out, bend
    beyond = np.abs(along) - shape.length / 2
    end = np.where(along < 0, -1.0, 1.0)[:, None] * axis
    on_end = beyond > side
    distance = np.where(on_end, beyond, side)
    gradient = np.where(on_end[:, None], end, out)
    hessian = np.where(on_end[:, None, None], 0.0, bend)
    rim = np.flatnonzero((side > 0) & (beyond > 0))  # nearest is the edge between the side and an end
    a, b = side[rim], beyond[rim]
    distance[rim] = np.hypot(a, b)
    a, b = (a / distance[rim])[:, None], (b / distance[rim])[:, None]
    gradient[rim] = a * out[rim] + b * end[rim]
    turned = b * out[rim] - a * end[rim]
    around = a[:, :, None] * bend[rim]
    hessian[rim] = _outer(turned, turned) / distance[rim, None, None] + around
    return distance, gradient, hessian


def _box(shape: Box, points: Array) -> Distances:
    """Distance to a smaller box with sharp edges, less the rounding."""
    from_center = points - np.array(shape.center)
    outward = np.where(from_center < 0, -1.0, 1.0)
    beyond = np.abs(from_center) - (np.array(shape.size) / 2 - shape.rounding)
    face = np.eye(3)[beyond.argmax(axis=1)]
    distance, gradient, hessian = beyond.max(axis=1), outward * face, np.zeros((len(points), 3, 3))
    outside = np.flatnonzero(distance > ROUND_OFF.zero * min(shape.size))
    over = np.maximum(beyond[outside], 0.0)
    free = (over > 0)[:, :, None] * np.eye(3)  # one direction next to a face, two next to an edge, three at a corner
    length = np.linalg.norm(over, axis=1)
    distance[outside] = length
    gradient[outside] = outward[outside] * over / length[:, None]
    hessian[outside] = (free - _outer(gradient[outside], gradient[outside])) / length[:, None, None]
    return distance - shape.rounding, gradient, hessian


def _from_center(vectors: Array, plane: Array, shortest: float) -> Distances:
    """Lengths of vectors in a plane, or in space, with derivatives; the plane is given by its projector, (3, 3)."""
    length = np.linalg.norm(vectors, axis=1)
    aimless = length <= shortest
    column = plane[:, np.linalg.norm(plane, axis=0).argmax()]
    safe = np.where(aimless, 1.0, length)
    out = np.where(aimless[:, None], column / np.linalg.norm(column), vectors / safe[:, None])
    bend = (plane - _outer(out, out)) / safe[:, None, None]
    bend[aimless] = 0.0
    return length, out, bend


def _outer(a: Array, b: Array) -> Array:
    return np.asarray(a[:, :, None] * b[:, None, :])
