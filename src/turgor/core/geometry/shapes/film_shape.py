"""FilmShape: films without a solid, as patches with four edges each, in the place of a CAD shape."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.core.geometry.cad_unit import METERS_PER_CAD_UNIT

Array = NDArray[np.float64]
Point = tuple[float, float, float]


@dataclass(frozen=True, slots=True, kw_only=True)
class Patch:
    """A piece of a film between four edges, each straight or an arc.

    Parameters
    ----------
    corners : (4,) points [m]
        In turn; seen from the cavity they run counterclockwise, so that the normal points into it.
    faces : tuple of str
        Faces that the piece belongs to.
    edges : (4,) str
        Faces that its edges make, from the first corner to the second, and so on; empty for none.
    arcs : (4,) point or None
        Centers of the edges that are arcs.
    """

    corners: tuple[Point, Point, Point, Point]
    faces: tuple[str, ...]
    edges: tuple[str, str, str, str] = ("", "", "", "")
    arcs: tuple[Point | None, Point | None, Point | None, Point | None] = (None, None, None, None)

    @property
    def name(self) -> str:
        """First of its faces, by which pictures call it."""
        return self.faces[0]

    def line(self, edge: int, share: Array) -> Array:
        """Points (k, 3) [m] of an edge at shares of its length (k,), from its first corner on."""
        start, end, center = np.array(self.corners[edge]), np.array(self.corners[(edge + 1) % 4]), self.arcs[edge]
        s = share[:, None]
        if center is None:
            return np.asarray((1 - s) * start + s * end)
        a, b = start - np.array(center), end - np.array(center)
        angle = np.arccos(np.clip(a @ b / (np.linalg.norm(a) * np.linalg.norm(b)), -1, 1))
        return np.asarray(center + (np.sin((1 - s) * angle) * a + np.sin(s * angle) * b) / np.sin(angle))

    def grid(self, along: int, across: int) -> Array:
        """Points (across + 1, along + 1, 3) [m] with so many intervals along the first edge and the second one.

        They are Coons' interpolation between the edges.
        """
        s, t = np.linspace(0, 1, along + 1), np.linspace(0, 1, across + 1)
        shares = (s, t, 1 - s, 1 - t)  # the third and the fourth edge run backwards
        low, right, high, left = (self.line(k, share) for k, share in enumerate(shares))
        a, b, c, d = (np.array(corner) for corner in self.corners)
        S, T = s[None, :, None], t[:, None, None]
        ruled = (1 - T) * low[None] + T * high[None] + (1 - S) * left[:, None] + S * right[:, None]
        return np.asarray(ruled - ((1 - S) * (1 - T) * a + S * (1 - T) * b + S * T * c + (1 - S) * T * d))


@dataclass(frozen=True, slots=True, kw_only=True)
class FilmShape:
    """Films as patches that share edges.

    Parameters
    ----------
    patches : tuple of Patch
    """

    patches: tuple[Patch, ...]

    @property
    def bounding_box(self) -> tuple[Point, Point]:
        """Lowest and highest corner of the box around the corners of the patches, in CAD units."""
        axes = list(zip(*(corner for patch in self.patches for corner in patch.corners), strict=True))
        x, y, z = ((min(axis) / METERS_PER_CAD_UNIT, max(axis) / METERS_PER_CAD_UNIT) for axis in axes)
        return (x[0], y[0], z[0]), (x[1], y[1], z[1])
