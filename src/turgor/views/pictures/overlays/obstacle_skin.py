"""Obstacles in pictures: gray, translucent bodies."""

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from turgor.core.geometry.cad.symmetry.whole import ITSELF, MirrorPlane
from turgor.core.meshing.bodies.groups import groups_of
from turgor.core.results.fields.contact import drawn_obstacles, pose_of
from turgor.core.results.fields.state_fields import MeshFacts, StateFields
from turgor.views.pictures.raycast import Camera, Hits
from turgor.views.pictures.settings import LOOK, RENDERING
from turgor.views.pictures.shading import Bytes, draw_lines, find_lines
from turgor.views.pictures.skin import Skin, with_images

Array = NDArray[np.float64]
Ints = NDArray[np.int64]

#: Color of obstacles, and color of their edges.
GRAY, EDGE = (124, 135, 149), (100, 109, 120)


def obstacle_skin(at: StateFields, extents: Mapping[str, Array]) -> Skin | None:
    """Build the skin of all obstacles at their places in a state, and of their mirror images.

    Parameters
    ----------
    at : StateFields
        The state.
    extents : mapping of str to (2, 3) array [m]
        Bounding boxes of the actuator and its faces, see `turgor.core.results.fields.contact.extents_of`.

    Returns
    -------
    Skin or None
        None where the model has no obstacle.
    """
    skins = []
    for obstacle in drawn_obstacles(at.model):
        surface = obstacle.outline(pose_of(at, obstacle), extents[obstacle.face or ""])
        skins.append(_mirrored(_skin(*surface), at.facts))
    return joined(skins) if skins else None


def _skin(points: Array, triangles: Ints) -> Skin:
    """Skin of a surface of flat triangles, with smooth normals except at sharp edges."""
    corners = points[triangles]
    twice = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    flat = twice / np.maximum(np.linalg.norm(twice, axis=1, keepdims=True), 1e-30)
    edges = np.sort(np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), axis=1)
    owner = np.tile(np.arange(len(triangles)), 3)
    order = np.lexsort((edges[:, 1], edges[:, 0]))
    same = (edges[order[1:]] == edges[order[:-1]]).all(axis=1)
    a, b = owner[order[:-1][same]], owner[order[1:][same]]
    smooth = np.einsum("ei,ei->e", flat[a], flat[b]) > np.cos(RENDERING.sharp_edge)
    patch = groups_of(len(triangles), a[smooth], b[smooth])
    # a point has one copy for each patch that meets there, so that normals jump at sharp edges only
    key, corner = np.unique(patch[:, None] * len(points) + triangles, return_inverse=True)
    corner = corner.reshape(triangles.shape)
    normals = np.zeros((len(key), 3))
    np.add.at(normals, corner, twice[:, None])
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-30)
    return Skin(points=points[key % len(points)], normals=normals, values=np.zeros(len(key)),
                triangles=corner, patch=patch)  # fmt: skip


def _mirrored(skin: Skin, facts: MeshFacts) -> Skin:
    """Add the images of an obstacle in the mirror planes, unless it is its own image."""
    for plane in facts.mirrors:
        if not _own_image(skin, plane):
            skin = with_images(skin, (ITSELF, plane.image()))
    return skin


def _own_image(skin: Skin, plane: MirrorPlane) -> bool:
    """Whether an obstacle is its own image in a mirror plane: the ends of both differ so little that no one sees it."""
    across = skin.points[:, plane.axis] - plane.position
    return bool(abs(across.min() + across.max()) < RENDERING.unseen * float(np.ptp(skin.points, axis=0).max()))


def joined(skins: list[Skin]) -> Skin:
    """Concatenate skins into one, with separate patch numbers."""
    starts = np.cumsum([0, *(len(skin.points) for skin in skins)])
    numbers = np.cumsum([0, *(int(skin.patch.max()) + 1 for skin in skins)])
    return Skin(
        points=np.concatenate([skin.points for skin in skins]),
        normals=np.concatenate([skin.normals for skin in skins]),
        values=np.concatenate([skin.values for skin in skins]),
        triangles=np.concatenate([skin.triangles + start for skin, start in zip(skins, starts, strict=False)]),
        patch=np.concatenate([skin.patch + number for skin, number in zip(skins, numbers, strict=False)]),
    )


def draw_obstacles(image: Bytes, skin: Skin, hits: Hits, nearer: NDArray[np.bool_], eye: Camera, width: float) -> None:
    """Blend obstacles into an image where they are in front of the actuator.

    Parameters
    ----------
    image : (h, w, 3) array
        Changed in place.
    skin : Skin
        The obstacles.
    hits : Hits
        First hit of each ray on the obstacles.
    nearer : (h, w) array
        Samples in which the obstacles are in front.
    eye : Camera
        Camera of the picture.
    width : float
        Width of the outlines of obstacles, in samples.
    """
    hit = hits.triangle >= 0
    corners = skin.triangles[hits.triangle[hit]]
    normal = skin.normals[corners[:, 0]] * (1 - hits.u - hits.v)[:, None]
    normal += skin.normals[corners[:, 1]] * hits.u[:, None] + skin.normals[corners[:, 2]] * hits.v[:, None]
    facing = np.abs(normal @ eye.forward) / np.maximum(np.linalg.norm(normal, axis=1), 1e-12)
    shade = np.zeros(hit.shape)
    shade[hit] = 0.62 + 0.5 * facing
    color = np.clip(np.array(GRAY) * shade[nearer][:, None], 0, 255)
    image[nearer] = (image[nearer] * (1 - LOOK.overlay) + color * LOOK.overlay).astype(np.uint8)
    outside, inner = find_lines(skin, hits)
    draw_lines(image, (outside & nearer, inner & nearer), EDGE, width)
