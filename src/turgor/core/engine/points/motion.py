"""PointMotion: how a reference point has moved, and what holds it; put back into the unknowns."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.points.point_unknowns import Carrier

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class PointMotion:
    """Motion of a reference point, and what supports and springs do to it.

    Parameters
    ----------
    displacement : (3,) array [m]
    rotation : (3, 3) array [-]
        Rotation matrix from rest.
    force : (3,) array [N]
        Reaction: force of its supports and springs on the point of the whole actuator; zero where nothing holds it.
    moment : (3,) array [N m]
        Reaction moment of its supports and springs about the point, of the whole actuator.
    multipliers : (k, 3) array [N]
        Those of the rigid body, of the ties of an averaging point, and of a bearing.
    """

    displacement: Array
    rotation: Array
    force: Array
    moment: Array
    multipliers: Array


def carrier_displacement(
    carriers: Sequence[Carrier],
    scales: tuple[float, float],
    displacement: Array,
    known: Mapping[str, PointMotion],
) -> Array:
    """Scaled values (e, 3) of the nodes of reference points: those known, else of the motion of their faces.

    Parameters
    ----------
    carriers : sequence of Carrier
    scales : (length, stress)
    displacement : (n, 3) array [m]
        Of the nodes of the mesh.
    known : mapping of str to PointMotion

    Returns
    -------
    array
    """
    length, stress = scales
    out = [np.zeros((0, 3))]
    for each in carriers:
        values, motion = np.zeros((each.count, 3)), known.get(each.point.name)
        place, rotation = (
            _fitted(each, displacement[each.nodes]) if motion is None else (motion.displacement, motion.rotation)
        )
        values[0] = place / length
        values[1:4] = (rotation.T - np.eye(3)) * each.radius / length
        if motion is not None and len(motion.multipliers) == len(each.multipliers):
            values[each.multipliers - each.node] = motion.multipliers / (stress * length**2)
        out.append(values)
    return np.concatenate(out)


def _fitted(carrier: Carrier, displacement: Array) -> tuple[Array, Array]:
    """Displacement of the point [m] and rotation (3, 3) that bring its face nearest to where it is."""
    arms = carrier.arms - carrier.center
    now = arms + displacement
    middle = carrier.weights @ now
    left, _, right = np.linalg.svd((now - middle).T @ (np.abs(carrier.weights)[:, None] * arms))
    rotation = left @ np.diag([1.0, 1.0, np.linalg.det(left @ right)]) @ right
    middle[list(carrier.blocked)] = 0.0
    for axis in carrier.unturned:
        rotation = _about(rotation, axis)
    return middle - (rotation - np.eye(3)) @ carrier.center, rotation


def carrier_velocity(
    carriers: Sequence[Carrier], points: Array, length: float, displacement: Array, velocity: Array
) -> Array:
    """Scaled rates (e, 3) of the nodes of reference points that are nearest to the velocity of their faces.

    Parameters
    ----------
    carriers : sequence of Carrier
    points : (n + e, 3) array
        Scaled positions at rest.
    length : float [m]
        Scale.
    displacement : (n + e, 3) array
        Scaled displacements.
    velocity : (n, 3) array [m/s]

    Returns
    -------
    array
    """
    out = [np.zeros((0, 3))]
    for each in carriers:
        values, weights = np.zeros((each.count, 3)), np.abs(each.weights) / np.abs(each.weights).sum()
        x = (points[each.nodes] + displacement[each.nodes]) * length
        place = (points[each.node] + displacement[each.node]) * length
        about, moved = x - weights @ x, velocity[each.nodes]
        inertia = (weights @ (about**2).sum(axis=1)) * np.eye(3) - (weights[:, None] * about).T @ about
        spin = np.linalg.solve(inertia, weights @ np.cross(about, moved))
        spin[[k for k in range(3) if k not in each.turning]] = 0.0
        values[0] = (weights @ moved + np.cross(spin, place - weights @ x)) / length
        values[0, list(each.blocked)] = 0.0
        arrows = displacement[each.arrows] + each.radius / length * np.eye(3)
        values[1:4] = np.cross(spin, arrows)
        out.append(values)
    return np.concatenate(out)


def _about(rotation: Array, axis: int) -> Array:
    """The rotation about an axis that is nearest to another one."""
    b, c = (axis + 1) % 3, (axis + 2) % 3
    angle = np.arctan2(rotation[c, b] - rotation[b, c], rotation[b, b] + rotation[c, c])
    out = np.eye(3)
    out[b, b] = out[c, c] = np.cos(angle)
    out[c, b], out[b, c] = np.sin(angle), -np.sin(angle)
    return out
