"""Rig: what stands before a blocked tip, a plate or the button of a load cell, at its place and angle."""

import numpy as np
from numpy.typing import NDArray

from turgor.core.geometry.directions import DIRECTIONS
from turgor.core.meshing.mesh import Mesh
from turgor.core.model.obstacles import Plane, Sphere, Vector
from turgor.core.setups.free_tip import outward
from turgor.core.setups.settings import BLOCKED_TIP
from turgor.core.setups.setup_values import BlockedForce
from turgor.foundation.errors import TurgorError
from turgor.units import mm

Array = NDArray[np.float64]


def pushed_along(setup: BlockedForce, direction: str) -> Array:
    """Return the unit vector out of the tip along which the load cell measures: square to its plate, (3,).

    A plate is turned about y, or about x where the tip pushes along y; a positive angle brings the side at larger x (or
    larger z) nearer to the actuator.

    Parameters
    ----------
    setup : BlockedForce
    direction : str
        As stated, or found where it is free.
    """
    push = np.array(DIRECTIONS[direction])
    if not setup.tilt:
        return push
    across = np.array(DIRECTIONS["+x" if direction[1] == "z" else "+z"])
    return np.asarray(np.cos(setup.tilt) * push + np.sin(setup.tilt) * across)


def rig_position(mesh: Mesh, setup: BlockedForce, direction: str, sides: NDArray[np.int64]) -> float:
    """Return where the rig stands: its coordinate along the axis of the direction, in front of the tip [m].

    Parameters
    ----------
    mesh : Mesh
    setup : BlockedForce
    direction : str
    sides : (f, k) array
        Sides of the actuator that can touch it.
    """
    if setup.position is not None:
        return setup.position
    axis = "xyz".index(direction[1])
    return float(_touching(mesh, setup, direction, sides, setup.distance or 0.0)[axis]) + 0.0


def rig_shape(
    mesh: Mesh, setup: BlockedForce, direction: str, sides: NDArray[np.int64]
) -> tuple[Plane | Sphere, float]:
    """Return the shape of the rig where it does not press yet, and how far it is then pushed into the tip [m].

    Parameters
    ----------
    mesh, setup, direction, sides
        See `rig_position`.
    """
    axis, sign = "xyz".index(direction[1]), sum(DIRECTIONS[direction])
    front = _touching(mesh, setup, direction, sides, 0.0)
    gap = sign * (rig_position(mesh, setup, direction, sides) - front[axis])
    front[axis] += sign * max(gap, 0.0)
    along = pushed_along(setup, direction)
    if setup.sensor_radius is None:
        return Plane(point=_vector(front), normal=_vector(-along)), max(-gap, 0.0)
    push = np.array(DIRECTIONS[direction])
    return Sphere(center=_vector(front + setup.sensor_radius * push), radius=setup.sensor_radius), max(-gap, 0.0)


def _touching(mesh: Mesh, setup: BlockedForce, direction: str, sides: NDArray[np.int64], gap: float) -> Array:
    """Front of the rig at a gap from the actuator at rest: a point of its plate, or the top of its button, (3,) [m]."""
    push, along = np.array(DIRECTIONS[direction]), pushed_along(setup, direction)
    tip = mesh.face_nodes(setup.face)
    middle = mesh.points[tip].mean(axis=0)
    for axis, plane in mesh.mirror_planes:
        middle[axis] = plane
    if setup.sensor_radius is None:
        reached = float((mesh.points[np.unique(sides)] @ along).max()) + gap
        axis = "xyz".index(direction[1])
        others = np.delete(np.arange(3), axis)
        middle[axis] = (reached - middle[others] @ along[others]) / along[axis]
        return np.asarray(middle)
    radius = setup.sensor_radius
    middle = middle - (setup.behind_tip or 0.0) * outward(mesh, setup.face)
    middle = middle - push * (push @ middle)
    points = _surface_points(mesh, sides)
    away = points - middle
    across = np.linalg.norm(away - np.outer(away @ push, push), axis=1)
    over = across < radius
    if not over.any():
        raise TurgorError(
            f"blocked_force: a sensor of radius {radius / mm:g} mm that stands {(setup.behind_tip or 0.0) / mm:g} mm "
            f"behind the tip meets no part of it along {direction}; change behind_tip, or take a larger sensor_radius."
        )
    centers = points[over] @ push + np.sqrt(np.maximum((radius + gap) ** 2 - across[over] ** 2, 0.0))
    return np.asarray(middle + push * (float(centers.max()) - radius))


def _surface_points(mesh: Mesh, sides: NDArray[np.int64]) -> Array:
    """Nodes of sides, and points between their corners: a small button stands between nodes, (n, 3) [m]."""
    corners = mesh.cell_type.side.corners
    steps = np.linspace(0.0, 1.0, BLOCKED_TIP.between)
    u, v = (each.ravel() for each in np.meshgrid(steps, steps))
    if corners == 3:
        u, v = u[u + v <= 1], v[u + v <= 1]
        weights = np.stack([1 - u - v, u, v])
    else:
        weights = np.stack([(1 - u) * (1 - v), u * (1 - v), u * v, (1 - u) * v])
    between = np.einsum("kn,fkx->fnx", weights, mesh.points[sides[:, :corners]]).reshape(-1, 3)
    return np.concatenate([mesh.points[np.unique(sides)], between])


def _vector(values: Array) -> Vector:
    x, y, z = (float(value) + 0.0 for value in values)
    return x, y, z
