"""Shading: color, light and outlines of the visible surface."""

from dataclasses import dataclass

import numpy as np
from matplotlib.colors import Colormap
from numba import njit
from numpy.typing import NDArray

from turgor.core.engine.compiled import LOOP
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
    fields = np.column_stack([np.nan_to_num(skin.values, nan=look.floor), look.openness, skin.normals])
    table = look.colors(np.linspace(0, 1, 1024))[:, :3] ** GAMMA
    levels = (np.linspace(0, 1, 4096) ** (1 / GAMMA) * 255 + 0.5).astype(np.uint8)
    right, up, forward = LOOK.lamp_place
    lamp = right * eye.right + up * eye.up + forward * eye.forward
    directions = np.stack([eye.forward, lamp / np.linalg.norm(lamp)])
    numbers = np.array([look.floor, 1023 / (look.limit - look.floor), LOOK.lamp, look.shadow])
    _shade(image, hits.triangle, (hits.u, hits.v), (skin.triangles, fields), (table, levels, directions, numbers))
    return image


@njit(**LOOP)
def _shade(image, triangle, shares, skin, look):  # type: ignore[no-untyped-def]
    """Color the samples that hit a triangle."""
    (corners, fields), (table, levels, directions, numbers) = skin, look
    floor, scale, lamp, shadow = numbers[0], numbers[1], numbers[2], numbers[3]
    k, at = 0, np.empty(5)
    for row in range(len(triangle)):
        for column in range(triangle.shape[1]):
            hit = triangle[row, column]
            if hit < 0:
                continue
            u, v = shares[0][k], shares[1][k]
            k += 1
            first, second, third = corners[hit, 0], corners[hit, 1], corners[hit, 2]
            for i in range(5):
                at[i] = (1 - u - v) * fields[first, i] + u * fields[second, i] + v * fields[third, i]
            length, away, lit = 0.0, 0.0, 0.0
            for i in range(3):
                length += at[2 + i] ** 2
                away += at[2 + i] * directions[0, i]
                lit += at[2 + i] * directions[1, i]
            turn = (-1.0 if away > 0 else 1.0) / max(length**0.5, 1e-12)
            light = (1 - lamp) * (0.25 + 0.75 * at[1]) * (0.8 + 0.2 * turn * at[4])
            light += lamp * max(turn * lit, 0.0) * (0.4 + 0.6 * at[1])
            light = 4095 * (1 - shadow * (1 - min(max(light, 0.0), 1.0)))
            color = int(min(max((at[0] - floor) * scale, 0.0), 1023.0))
            for i in range(3):
                image[row, column, i] = levels[int(light * table[color, i])]


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
