"""Shading: colors, light and lines of what the samples of a picture see."""

from dataclasses import dataclass

import numpy as np
from matplotlib.colors import Colormap
from numpy.typing import NDArray

from turgor.results.raycast import Camera, Hits
from turgor.results.skin import Skin

Bytes = NDArray[np.uint8]
Mask = NDArray[np.bool_]

INK = (38, 43, 52)
GHOST = (176, 182, 190)
PAPER = (255, 255, 255)

#: How much of the light comes from the lamp at the upper left; the rest is sky, dimmed where little of it is seen.
LAMP = 0.45
LAMP_PLACE = (-0.45, 0.75, -0.65)
HIGHLIGHT = 0.10

#: A jump in depth of more than this share of the size of the body is an edge in front of something behind it.
DEPTH_JUMP = 0.006

GAMMA = 2.2


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Look:
    """How values become colors.

    Parameters
    ----------
    colors : Colormap
    limit : float
        Value at the upper end of the colors; the lower end is zero.
    openness : (p,) array
        Share of the sky that each point of the skin sees.
    """

    colors: Colormap
    limit: float
    openness: NDArray[np.float64]


def paint(skin: Skin, hits: Hits, eye: Camera, look: Look) -> Bytes:
    """Color every sample, (h, w, 3): the field's color under a lamp and a sky; white where nothing is seen."""
    image = np.full((*hits.triangle.shape, 3), PAPER, dtype=np.uint8)
    seen = hits.triangle >= 0
    corners = skin.triangles[hits.triangle[seen]]
    u, v = hits.u[seen], hits.v[seen]
    weights = np.stack([1 - u - v, u, v], axis=1).astype(np.float32)

    def at_samples(field: NDArray[np.float64]) -> NDArray[np.float32]:
        flat = field.astype(np.float32)
        return np.asarray(sum(weights[:, [k]] * flat[corners[:, k]].reshape(len(u), -1) for k in range(3)))

    value, sky = at_samples(skin.values)[:, 0], at_samples(look.openness)[:, 0]
    table = (look.colors(np.linspace(0, 1, 1024))[:, :3] ** GAMMA).astype(np.float32)
    color = table[np.clip(value / look.limit * 1023, 0, 1023).astype(np.int32)]
    normal = at_samples(skin.normals)
    facing = -np.sign(normal @ eye.forward.astype(np.float32))
    normal *= (facing / np.maximum(np.linalg.norm(normal, axis=1), 1e-12))[:, None]
    lamp = _in_space(LAMP_PLACE, eye)
    half = lamp - eye.forward
    half /= np.linalg.norm(half)
    light = (1 - LAMP) * (0.25 + 0.75 * sky) * (0.8 + 0.2 * normal[:, 2]) + LAMP * np.maximum(
        normal @ lamp.astype(np.float32), 0
    ) * (0.4 + 0.6 * sky)
    shine = HIGHLIGHT * np.maximum(normal @ half.astype(np.float32), 0) ** 40 * sky
    color = color * (1.12 * light)[:, None] + shine[:, None]
    image[seen] = (np.clip(color, 0, 1) ** (1 / GAMMA) * 255 + 0.5).astype(np.uint8)
    return image


def _in_space(place: tuple[float, float, float], eye: Camera) -> NDArray[np.float64]:
    """Unit direction towards a place given to the right, up and away from the eye."""
    direction = place[0] * eye.right + place[1] * eye.up + place[2] * eye.forward
    return np.asarray(direction / np.linalg.norm(direction))


def find_lines(skin: Skin, hits: Hits) -> tuple[Mask, Mask]:
    """Samples on the outline of the body, and samples on edges within it."""
    patch = np.where(hits.triangle >= 0, skin.patch[hits.triangle], -1)
    depth = np.where(np.isfinite(hits.depth), hits.depth, 0.0)
    size = float(np.ptp(skin.points, axis=0).max())
    outline, inner = np.zeros(patch.shape, dtype=bool), np.zeros(patch.shape, dtype=bool)
    for axis in (0, 1):
        here, there = _shifted(patch, axis)
        change = here != there
        border = change & ((here < 0) | (there < 0))
        _mark(outline, border, axis)
        # the second difference is small on a slope however steep, and large at a step
        bend = np.abs(np.diff(depth, n=2, axis=axis)) > DEPTH_JUMP * size
        covered = (here >= 0) & (there >= 0)
        step = bend & _but_last(covered, axis) & _but_first(covered, axis)
        _mark(inner, change & ~border, axis)
        _mark(inner, step, axis)
    return outline, inner & ~outline


def _shifted(field: NDArray[np.int64], axis: int) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    return _but_last(field, axis), _but_first(field, axis)


def _but_last(field: NDArray, axis: int) -> NDArray:
    return field[:-1] if axis == 0 else field[:, :-1]


def _but_first(field: NDArray, axis: int) -> NDArray:
    return field[1:] if axis == 0 else field[:, 1:]


def _mark(mask: Mask, where: Mask, axis: int) -> None:
    """Set the samples of a mask that begin a pair or a triple of neighbors."""
    if axis == 0:
        mask[: where.shape[0]] |= where
    else:
        mask[:, : where.shape[1]] |= where


def draw_lines(image: Bytes, lines: tuple[Mask, Mask], ink: tuple[int, int, int], width: float) -> None:
    """Draw outline and inner edges into an image; ``width`` in samples is that of the outline."""
    for mask, share, opacity in zip(lines, (1.0, 0.6), (0.95, 0.6), strict=True):
        place = _thickened(mask, width * share / 2)
        image[place] = (image[place] * (1 - opacity) + np.array(ink) * opacity).astype(np.uint8)


def _thickened(mask: Mask, radius: float) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Rows and columns of the samples within a radius of those that are set, each once."""
    rows, columns = np.nonzero(mask)
    reach = int(np.ceil(radius))
    wide = np.zeros(mask.shape, dtype=bool)
    for down in range(-reach, reach + 1):
        for aside in range(-reach, reach + 1):
            if down**2 + aside**2 <= max(radius, 0.5) ** 2:
                at = np.clip(rows + down, 0, mask.shape[0] - 1), np.clip(columns + aside, 0, mask.shape[1] - 1)
                wide[at] = True
    found = np.nonzero(wide)
    return found[0], found[1]


def reduced(image: Bytes, samples: int) -> Bytes:
    """Average ``samples`` x ``samples`` samples into each pixel."""
    h, w = image.shape[0] // samples, image.shape[1] // samples
    blocks = image[: h * samples, : w * samples].reshape(h, samples, w, samples, 3)
    return np.asarray(blocks.mean(axis=(1, 3), dtype=np.float32) + 0.5).astype(np.uint8)
