"""Shading: color, light and outlines of the visible surface."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.colors import Colormap
from numpy.typing import NDArray

from turgor.views.pictures.raycast import Camera, Hits
from turgor.views.pictures.settings import LOOK, RENDERING
from turgor.views.pictures.skin import Skin
from turgor.views.plots import styling

Bytes = NDArray[np.uint8]
Mask = NDArray[np.bool_]

#: Colors of lines, as in plots, and of outlines behind the actuator.
INK = tuple(bytes.fromhex(styling.INK[1:]))
GHOST = (176, 182, 190)

#: Exponent from stored colors to light, about that of sRGB.
GAMMA = 2.2


@dataclass(frozen=True, slots=True, eq=False)
class Look:
    """Color map and lighting of a skin.

    Parameters
    ----------
    colors : Colormap
    limit : float
        Value at the upper end of the colors.
    openness : (p,) array
        Ambient occlusion of each point of the skin: 1 is free, 0 is covered.
    floor : float
        Value at the lower end of the colors.
    shadow : float
        Largest share of the light that shadow takes.
    """

    colors: Colormap
    limit: float
    openness: NDArray[np.float64]
    floor: float = 0.0
    shadow: float = LOOK.shadow


def paint(skin: Skin, hits: Hits, eye: Camera, look: Look) -> Bytes:
    """Return the color of every sample, (h, w, 3): that of the field, darker in shadow; white outside the skin.

    Light multiplies red, green and blue alike (in linear light) by a factor from 1 − ``shadow`` to 1. So their ratios
    are those of the color bar everywhere, and a value can be read off the color of a pixel.
    """
    image = np.full((*hits.triangle.shape, 3), 255, dtype=np.uint8)
    hit = hits.triangle >= 0
    fields = np.column_stack([skin.values, look.openness, skin.normals]).astype(np.float32)
    corners = skin.triangles[hits.triangle[hit]]
    at = fields[corners[:, 0]] * (1 - hits.u - hits.v)[:, None]
    at += fields[corners[:, 1]] * hits.u[:, None]
    at += fields[corners[:, 2]] * hits.v[:, None]
    value, sky, normal = at[:, 0], at[:, 1], at[:, 2:]
    table = (look.colors(np.linspace(0, 1, 1024))[:, :3] ** GAMMA).astype(np.float32)
    value = np.nan_to_num(value, nan=look.floor)  # a field of a cell turned inside out
    color = table[np.clip((value - look.floor) * (1023 / (look.limit - look.floor)), 0, 1023).astype(np.int32)]
    right, up, forward = LOOK.lamp_place
    lamp = _unit(right * eye.right + up * eye.up + forward * eye.forward)
    length = np.sqrt(np.einsum("si,si->s", normal, normal))
    normal *= (-np.sign(normal @ eye.forward.astype(np.float32)) / np.maximum(length, 1e-12))[:, None]
    light = (1 - LOOK.lamp) * (0.25 + 0.75 * sky) * (0.8 + 0.2 * normal[:, 2])
    light += LOOK.lamp * np.maximum(normal @ lamp, 0) * (0.4 + 0.6 * sky)
    color *= (1 - look.shadow * (1 - np.clip(light, 0, 1)))[:, None]
    levels = (np.linspace(0, 1, 4096) ** (1 / GAMMA) * 255 + 0.5).astype(np.uint8)
    image[hit] = levels[(np.clip(color, 0, 1) * 4095).astype(np.int32)]
    return image


def _unit(vector: NDArray[Any]) -> NDArray[np.float32]:
    return np.asarray(vector / np.linalg.norm(vector), dtype=np.float32)


def find_lines(skin: Skin, hits: Hits) -> tuple[Mask, Mask]:
    """Return masks of the samples on the outline of the body, and of the samples on edges within the outline."""
    patch = np.where(hits.triangle >= 0, skin.patch.astype(np.int32)[hits.triangle], -1)
    jump = RENDERING.depth_jump * float(np.ptp(skin.points, axis=0).max())
    outline, inner = np.zeros(patch.shape, dtype=bool), np.zeros(patch.shape, dtype=bool)
    for axis in (0, 1):
        here, there = _but_last(patch, axis), _but_first(patch, axis)
        change, covered = here != there, (here >= 0) & (there >= 0)
        slope = np.diff(hits.depth, axis=axis)
        # on a smooth surface, however steep, the slope changes little from one pair of samples to the next
        step = np.abs(_but_first(slope, axis) - _but_last(slope, axis)) > jump
        _mark(outline, change & ~covered, axis)
        _mark(inner, change & covered, axis)
        _mark(inner, step & _but_last(covered, axis) & _but_first(covered, axis), axis)
    return outline, inner & ~outline


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


def draw_lines(
    image: Bytes, lines: tuple[Mask, Mask], ink: tuple[int, ...], width: float, strength: float = 1.0
) -> None:
    """Draw outline and inner edges into an image; the outline is ``width`` samples wide, ``strength`` their opacity."""
    for mask, share, full in zip(lines, (1.0, 0.6), (0.95, 0.6), strict=True):
        opacity = strength * full
        place = thickened(mask, width * share / 2)
        image[place] = (image[place] * (1 - opacity) + np.array(ink) * opacity).astype(np.uint8)


def thickened(mask: Mask, radius: float) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Return rows and columns of all samples within a radius of a set sample, each once."""
    rows, columns = np.nonzero(mask)
    reach = int(np.ceil(radius))
    wide = np.zeros(mask.shape, dtype=bool)
    for down in range(-reach, reach + 1):
        for aside in range(-reach, reach + 1):
            if down**2 + aside**2 <= max(radius, 0.5) ** 2:
                at = np.clip(rows + down, 0, mask.shape[0] - 1), np.clip(columns + aside, 0, mask.shape[1] - 1)
                wide[at] = True
    rows, columns = np.nonzero(wide)
    return rows, columns


def reduced(image: Bytes, samples: int) -> Bytes:
    """Average ``samples`` x ``samples`` samples into each pixel."""
    total = np.zeros((image.shape[0] // samples, image.shape[1] // samples, 3), dtype=np.uint16)
    for i in range(samples):
        for j in range(samples):
            total += image[i::samples, j::samples]
    return ((total + samples**2 // 2) // samples**2).astype(np.uint8)
