"""Contacts of a grasped object in a state: where it is touched, along which normals, and with which forces."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from turgor.core.geometry.cad.symmetry.whole import MirrorPlane, images_of
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
    part = _on_obstacle(at, name) if is_obstacle else _on_body(at, name)
    pressing = np.einsum("ki,ki->k", part.forces, part.normals)
    chosen = pressing > GRASP.least_share * pressing.max(initial=0.0)
    images = images_of(_cuts(at, part), at.mesh.wedge)
    points = np.concatenate([image.of(part.points[chosen]) for image in images])
    normals, forces = (
        np.concatenate([vectors[chosen] @ image.turn.T for image in images]) for vectors in (part.normals, part.forces)
    )
    center = part.center.copy()
    for plane in _cuts(at, part):
        center[plane.axis] = plane.position
    return replace(part, points=points, normals=normals, forces=forces, center=center)


def _cuts(at: StateFields, part: GraspContacts) -> list[MirrorPlane]:
    """Mirror planes through the object; an image behind another one is another object."""
    return [plane for plane in at.facts.mirrors if abs(part.center[plane.axis] - plane.position) < part.length]


def contact_force_on(at: StateFields, name: str) -> Array:
    """Force of all contacts on a body of the mesh, (3,) [N]: on the whole of it where mirror planes cut it."""
    nodes, planes = nodes_of_body(at.mesh, name), zip(at.mesh.symmetry_faces, at.facts.mirrors, strict=True)
    cuts = [plane for face, plane in planes if np.isin(nodes, at.mesh.face_nodes(face)).any()]
    force = sum((touch.force[nodes].sum(axis=0) for touch in at.state.touches.values()), np.zeros(3))
    return np.asarray(sum(force @ image.turn.T for image in images_of(cuts, at.mesh.wedge)))


def _on_obstacle(at: StateFields, name: str) -> GraspContacts:
    (obstacle,) = (each for each in at.model.contact.obstacles if each.name == name)
    touch, pose = at.state.touches.get(name), pose_of(at, obstacle)
    nodes = np.zeros(0, dtype=np.int64) if touch is None else np.flatnonzero(touch.force.any(axis=1))
    points, center = at.points[nodes], pose.moved(np.array(obstacle.shape.middle))
    if touch is None or obstacle.shape.surface() is not None:
        normals = _normals(at)[nodes]  # into the object, out of the actuator
    else:
        normals = -pose.turned(obstacle.shape.signed_distance(pose.at_first(points))[1])
    return GraspContacts(
        points=points,
        normals=normals,
        forces=np.zeros((0, 3)) if touch is None else -touch.force[nodes],
        friction=obstacle.friction,
        center=center,
        length=float(np.linalg.norm(points - center, axis=1).max(initial=0.0)),
    )


def _on_body(at: StateFields, name: str) -> GraspContacts:
    nodes = nodes_of_body(at.mesh, name)
    touch, own = at.state.touches.get(SELF), at.model.contact.self_contact
    center = at.points[nodes].mean(axis=0)
    touched = nodes[:0] if touch is None else nodes[touch.force[nodes].any(axis=1)]
    return GraspContacts(
        points=at.points[touched],
        normals=-_normals(at)[touched],
        forces=np.zeros((0, 3)) if touch is None else touch.force[touched],
        friction=0.0 if own is None else own.friction,
        center=center,
        length=float(np.linalg.norm(at.points[nodes] - center, axis=1).max()),
    )


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
