"""FilmShape: films without a solid, as patches with four edges each, in the place of a CAD shape."""

from dataclasses import dataclass

from turgor.core.geometry.cad_unit import METERS_PER_CAD_UNIT

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
