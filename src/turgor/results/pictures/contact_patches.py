"""Contact patches in pictures: the surfaces in contact, seen through the actuator."""

from dataclasses import replace

import numpy as np
from matplotlib.colors import Colormap
from numpy.typing import NDArray

from turgor.results.pictures.raycast import Camera, Hits
from turgor.results.pictures.shading import Bytes
from turgor.results.pictures.skin import Skin

Array = NDArray[np.float64]

#: Below this share of the upper end of the colors nothing is drawn: patches fade out over the last cells.
FAINT = 0.06

#: How much of a patch is seen where the actuator is before it.
THROUGH = 0.72


def pressed(skin: Skin, limit: float, eye: Camera) -> tuple[Skin, ...]:
    """Keep the parts of a skin whose values rise above a faint share of a limit.

    Walls that press each other lie in the same place, so that which is seen first changes from sample to sample. So
    what faces the eye comes by itself, to be shown before what is averted.

    Parameters
    ----------
    skin : Skin
        With the contact pressure as its values.
    limit : float [Pa]
        Upper end of the colors.
    eye : Camera

    Returns
    -------
    tuple of Skin
        What is averted from the eye, then what faces it; left out where there is none.
    """
    kept = skin.values[skin.triangles].max(axis=1) > FAINT * limit
    a, b, c = (skin.points[skin.triangles[:, k]] for k in range(3))
    facing = np.cross(b - a, c - a) @ eye.forward < 0
    parts = (kept & ~facing, kept & facing)
    return tuple(replace(skin, triangles=skin.triangles[p], patch=skin.patch[p]) for p in parts if p.any())


def values_seen(skin: Skin, hits: Hits, limit: float) -> Array:
    """Values that the samples see of a skin, (h, w); zero where they see nothing of it or the value is faint."""
    out = np.zeros(hits.triangle.shape)
    seen = hits.triangle >= 0
    corners = skin.values[skin.triangles[hits.triangle[seen]]]
    out[seen] = corners[:, 0] * (1 - hits.u - hits.v) + corners[:, 1] * hits.u + corners[:, 2] * hits.v
    return np.where(out > FAINT * limit, out, 0.0)


def laid_over(below: tuple[Array, Array], above: tuple[Array, Array], thin: float) -> tuple[Array, Array]:
    """Lay patches over others; where they lie in the same place, as walls do that press each other, the larger counts.

    Parameters
    ----------
    below, above : ((h, w) array [Pa], (h, w) array [m])
        Pressures that the samples see, zero for none, and how far away.
    thin : float [m]
        What differs less in distance lies in the same place.

    Returns
    -------
    (h, w) array [Pa], (h, w) array [m]
    """
    same = (np.abs(below[1] - above[1]) < thin) & (below[0] > above[0])
    chosen = (above[0] > 0) & ~same
    return np.where(chosen, above[0], below[0]), np.where(chosen, above[1], below[1])


def draw_patches(image: Bytes, value: Array, behind: NDArray[np.bool_], colors: Colormap, limit: float) -> None:
    """Color patches without light or shadow, so that a color means one pressure; paler where something is before them.

    Parameters
    ----------
    image : (h, w, 3) array
        Changed in place.
    value : (h, w) array [Pa]
        Pressures that the samples see.
    behind : (h, w) array
        Samples where the actuator is before what touches.
    colors : Colormap
    limit : float [Pa]
        Upper end of the colors.
    """
    shown = value > 0
    table = colors(np.linspace(0, 1, 1024))[:, :3] * 255
    color = table[np.clip(value[shown] * (1023 / limit), 0, 1023).astype(np.int32)]
    share = np.where(behind[shown], THROUGH, 1.0)[:, None]
    image[shown] = (image[shown] * (1 - share) + color * share + 0.5).astype(np.uint8)
