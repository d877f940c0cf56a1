"""Contact patches in pictures: the surfaces in contact, seen through the actuator."""

from dataclasses import replace

import numpy as np
from matplotlib.colors import Colormap
from numpy.typing import NDArray

from turgor.core.results.fields.state_fields import StateFields
from turgor.views.pictures.raycast import Camera, Hits
from turgor.views.pictures.settings import LOOK, RENDERING
from turgor.views.pictures.shading import Bytes
from turgor.views.pictures.skin import Skin, drawn_triangles, visible_skin

Array = NDArray[np.float64]


def contact_skin(at: StateFields) -> Skin:
    """Return the skin where surfaces touch, with a smooth contact pressure, finely divided.

    The pressure at the nodes, interpolated in sides of cells, has ragged borders. It is averaged around each point with
    a Gauss bell that is narrower than a cell, within one smooth surface, so that the force stays the same.

    Parameters
    ----------
    at : StateFields

    Returns
    -------
    Skin
        Without triangles where nothing touches.
    """
    return at.once("contact skin", lambda: _contact_skin(at))


def _contact_skin(at: StateFields) -> Skin:
    triangles, _ = drawn_triangles(at.mesh)
    touched = at.contact_pressure > 0
    chosen: NDArray[np.bool_] = np.zeros(len(triangles), dtype=bool)
    for _ in range(2):  # with the sides around those that touch
        chosen = np.asarray(touched[triangles].any(axis=1))
        touched[triangles[chosen]] = True
    skin = visible_skin(at, at.contact_pressure, chosen=chosen, parts=RENDERING.parts)
    if not chosen.any():
        return skin
    from scipy.spatial import cKDTree  # slow to load, and few states have walls that touch

    corners = at.points[triangles[chosen][:, :3]]
    edge = float(np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).mean())
    reach = edge / RENDERING.parts  # the pressure between nodes has ragged borders
    area = np.bincount(skin.triangles.ravel(), np.repeat(skin.areas / 3, 3), minlength=len(skin.points))
    patch, values = np.empty(len(skin.points), dtype=np.int64), np.zeros(len(skin.points))
    patch[skin.triangles] = skin.patch[:, None]
    for number in np.unique(patch):
        own = np.flatnonzero(patch == number)
        tree = cKDTree(skin.points[own])
        near = tree.sparse_distance_matrix(tree, 2.5 * reach, output_type="coo_matrix").tocsr()
        near.data = np.exp(-0.5 * (near.data / reach) ** 2)
        near = near.multiply(area[own][None]).tocsr()
        values[own] = near @ skin.values[own] / np.maximum(np.asarray(near.sum(axis=1)).ravel(), 1e-300)
    return replace(skin, values=values)


def pressed(skin: Skin, limit: float, eye: Camera) -> tuple[Skin, ...]:
    """Return the parts of a skin whose contact pressure exceeds a small share of a limit.

    Walls in contact lie in the same place, so rounding would decide for each sample which wall is in front. Therefore
    the triangles that face the camera are a separate part, which is drawn in front of the other triangles.

    Parameters
    ----------
    skin : Skin
        Skin whose values are the contact pressure [Pa].
    limit : float [Pa]
        Upper end of the colors.
    eye : Camera
        Camera of the picture.

    Returns
    -------
    tuple of Skin
        Triangles that face away from the camera, then triangles that face the camera; empty parts are left out.
    """
    pressed = skin.values[skin.triangles].max(axis=1) > LOOK.faint_pressure * limit
    a, b, c = (skin.points[skin.triangles[:, k]] for k in range(3))
    facing = np.cross(b - a, c - a) @ eye.forward < 0
    parts = (pressed & ~facing, pressed & facing)
    return tuple(skin.part(p) for p in parts if p.any())


def visible_values(skin: Skin, hits: Hits, limit: float) -> Array:
    """Return the pressure on the skin in each sample, (h, w) [Pa]; zero where there is no skin or little pressure."""
    out = np.zeros(hits.triangle.shape)
    hit = hits.triangle >= 0
    corners = skin.values[skin.triangles[hits.triangle[hit]]]
    out[hit] = corners[:, 0] * (1 - hits.u - hits.v) + corners[:, 1] * hits.u + corners[:, 2] * hits.v
    return np.where(out > LOOK.faint_pressure * limit, out, 0.0)


def laid_over(below: tuple[Array, Array], above: tuple[Array, Array], thin: float) -> tuple[Array, Array]:
    """Composite two layers of patches; where both lie in the same place (walls in contact), the larger value counts.

    Parameters
    ----------
    below, above : ((h, w) array [Pa], (h, w) array [m])
        Pressure in each sample, zero where there is no patch, and position of the patch along the view.
    thin : float [m]
        Layers closer to each other than this count as lying in the same place.

    Returns
    -------
    (h, w) array [Pa], (h, w) array [m]
    """
    same = (np.abs(below[1] - above[1]) < thin) & (below[0] > above[0])
    chosen = (above[0] > 0) & ~same
    return np.where(chosen, above[0], below[0]), np.where(chosen, above[1], below[1])


def draw_patches(image: Bytes, value: Array, behind: NDArray[np.bool_], colors: Colormap, limit: float) -> None:
    """Draw patches without shading, so that a color means one pressure; patches behind the actuator are paler.

    Parameters
    ----------
    image : (h, w, 3) array
        Changed in place.
    value : (h, w) array [Pa]
        Pressure in each sample.
    behind : (h, w) array
        Samples where the actuator hides the patch.
    colors : Colormap
        Colors of the pressure.
    limit : float [Pa]
        Upper end of the colors.
    """
    shown = value > 0
    table = colors(np.linspace(0, 1, 1024))[:, :3] * 255
    color = table[np.clip(value[shown] * (1023 / limit), 0, 1023).astype(np.int32)]
    share = np.where(behind[shown], LOOK.overlay, 1.0)[:, None]
    image[shown] = (image[shown] * (1 - share) + color * share + 0.5).astype(np.uint8)
