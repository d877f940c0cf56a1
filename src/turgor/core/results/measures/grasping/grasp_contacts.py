"""Contacts of a grasped object in a state: where it is touched, along which normals, and with which forces."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.faces import surfaces
from turgor.core.meshing.bodies.named import nodes_of_body
from turgor.core.model.contact import SELF
from turgor.core.results.fields.contact import pose_of
from turgor.core.results.fields.state_fields import StateFields
from turgor.core.results.measures.grasping.settings import GRASP

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class GraspContacts:
    """What touches an object in a state.

    Parameters
    ----------
    points : (k, 3) array [m]
        Of the whole actuator, its mirror images included.
    normals : (k, 3) array
        Into the object.
    forces : (k, 3) array [N]
        On the object.
    friction : float [-]
        Coulomb's coefficient.
    center : (3,) array [m]
        Middle of the object.
    length : float [m]
        Largest distance of its surface from there; of an obstacle, of the points that are touched.
    """

    points: Array
    normals: Array
    forces: Array
    friction: float
    center: Array
    length: float


def grasp_contacts(at: StateFields, name: str) -> GraspContacts:
    """Read the contacts of an object: an obstacle, or a body of the mesh that other bodies touch.

    Parameters
    ----------
    at : StateFields
    name : str

    Returns
    -------
    GraspContacts

    Raises
    ------
    TurgorError
        If there is neither an obstacle nor a body of this name.
    """
    is_obstacle = any(each.name == name for each in at.model.contact.obstacles)
    points, normals, forces, friction, center, length = (_on_obstacle if is_obstacle else _on_body)(at, name)
    pressing = np.einsum("ki,ki->k", forces, normals)
    chosen = pressing > GRASP.least_share * pressing.max(initial=0.0)
    images = at.facts.images
    whole = [[image.of(points[chosen]), image.turned(normals[chosen]), image.turned(forces[chosen])] for image in images]
    points, normals, forces = (np.concatenate(part) for part in zip(*whole, strict=True))
    if not length:
        length = float(np.linalg.norm(points - center, axis=1).max(initial=0.0))
    return GraspContacts(
        points=points, normals=normals, forces=forces, friction=friction, center=center, length=length
    )  # fmt: skip


def contact_force_on(at: StateFields, name: str) -> Array:
    """Force of all contacts on a body of the mesh, of the modeled part, (3,) [N]."""
    nodes = nodes_of_body(at.mesh, name)
    return np.sum([touch.force[nodes].sum(axis=0) for touch in at.state.touches.values()], axis=0, initial=0.0) * (
        np.ones(3)
    )


def _on_obstacle(at: StateFields, name: str) -> tuple[Array, Array, Array, float, Array, float]:
    (obstacle,) = (each for each in at.model.contact.obstacles if each.name == name)
    touch, pose = at.state.touches.get(name), pose_of(at, obstacle)
    center = pose.moved(np.array(obstacle.shape.middle))
    if touch is None:
        return np.empty((0, 3)), np.empty((0, 3)), np.empty((0, 3)), obstacle.friction, center, 0.0
    nodes = np.flatnonzero(touch.force.any(axis=1))
    points = at.points[nodes]
    triangles = obstacle.shape.surface()
    if triangles is None:
        _, outward, _ = obstacle.shape.signed_distance(pose.at_first(points))
        normals = -pose.turned(outward)
    else:  # the actuator touches it with its own normals
        normals = _normals(at)[nodes]
    return points, normals, -touch.force[nodes], obstacle.friction, center, 0.0


def _on_body(at: StateFields, name: str) -> tuple[Array, Array, Array, float, Array, float]:
    nodes = nodes_of_body(at.mesh, name)
    touch, own = at.state.touches.get(SELF), at.model.contact.self_contact
    center = at.points[nodes].mean(axis=0)
    length = float(np.linalg.norm(at.points[nodes] - center, axis=1).max())
    friction = 0.0 if own is None else own.friction
    if touch is None:
        return np.empty((0, 3)), np.empty((0, 3)), np.empty((0, 3)), friction, center, length
    nodes = nodes[touch.force[nodes].any(axis=1)]
    return at.points[nodes], -_normals(at)[nodes], touch.force[nodes], friction, center, length


def _normals(at: StateFields) -> Array:
    """Outward unit normals of the deformed surface at the nodes (n, 3), zero within the body."""

    def make() -> Array:
        sides = at.facts.surface
        corners = at.points[sides[:, : at.mesh.cell_type.side.corners]]
        if corners.shape[1] == 3:
            area = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        else:
            area = np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
        total = np.zeros_like(at.points)
        np.add.at(total, sides, np.broadcast_to(area[:, None], (*sides.shape, 3)))
        return total / np.maximum(np.linalg.norm(total, axis=1, keepdims=True), np.finfo(float).tiny)

    return at.once("outward normals", make)
