"""Yoshimura bellows: an origami bellows of film whose triangles make inverted diamonds."""

from collections.abc import Mapping
from dataclasses import dataclass
from math import pi
from types import MappingProxyType

from turgor.core.geometry.geometry import Geometry
from turgor.core.geometry.parts.facets import Ring, folded_tube, folded_volume
from turgor.core.geometry.parts.films import film_geometry
from turgor.core.geometry.rules import MOST_FOLDS, check_count, check_fields, check_length
from turgor.units import m, mm


@dataclass(frozen=True, slots=True, kw_only=True)
class YoshimuraBellows:
    """Bellows of triangles between polygons of two sizes, turned by half a side: vacuum folds it (Yoshimura).

    It has no solid: its materials are sheets, such as
    ``film = { law = "hooke", E = "20 MPa", nu = 0.45, thickness = "1 mm" }`` in a job file, whose bending stiffness
    keeps the folds as they were molded. A point that is coupled rigidly to the face ``tip`` makes the end plate stiff.
    Two triangles that share a side of a valley are an inverted diamond, as in a thin cylinder that was crushed
    (Yoshimura 1955, NACA TM 1390). Where both radii are equal it is that pattern, which hardly moves, because flat
    triangles fit at one height only. With a smaller ``inner_radius`` the folds need less stretch, and it shortens
    further; it does not twist. The sizes were chosen here.

    Axes: x from the fixed rim to the end plate, on the axis of the bellows. The whole bellows is modeled.

    Parameters
    ----------
    sides : int
        Corners of the polygons, 3 to 24.
    folds : int
        Crests between the fixed rim and the end plate, 1 to 50.
    outer_radius : float [m]
        Circumradius of the polygons of the crests; 1 mm to 1 m.
    inner_radius : float [m]
        That of the valleys, of the fixed rim and of the end plate; up to the outer one.
    pitch : float [m]
        Length of one fold at rest; 0.5 mm to 1 m.

    Raises
    ------
    TurgorError
        If a dimension is out of range; the message states the field, its value and the range.

    Examples
    --------
    >>> round(YoshimuraBellows(folds=3).length * 1e3, 6)  # mm
    36.0
    >>> YoshimuraBellows(inner_radius=25e-3)
    Traceback (most recent call last):
    turgor.TurgorError: inner_radius is 25 mm; allowed is 1 mm to 20 mm, the radius of the crests.
    """

    sides: int = 6
    folds: int = 2
    outer_radius: float = 20 * mm
    inner_radius: float = 12 * mm
    pitch: float = 12 * mm

    def __post_init__(self) -> None:
        check_fields(self)
        check_count("sides", self.sides, low=3, high=24)
        check_count("folds", self.folds, low=1, high=MOST_FOLDS)
        check_length("outer_radius", self.outer_radius, low=1 * mm, high=1 * m)
        check_length(
            "inner_radius", self.inner_radius, low=1 * mm, high=self.outer_radius, why="the radius of the crests"
        )
        check_length("pitch", self.pitch, low=0.5 * mm, high=1 * m)

    @property
    def length(self) -> float:
        """Length from the fixed rim to the end plate [m]."""
        return self.folds * self.pitch

    @property
    def smallest_wall(self) -> float:
        """Half a fold or the radius of the valleys [m], the smallest length that cells should follow."""
        return min(self.pitch / 2, self.inner_radius)

    @property
    def cavity_volumes(self) -> Mapping[str, float]:
        """Volume of the bellows [m³], at rest."""
        return MappingProxyType({"cavity": folded_volume(self._rings(), self.sides)})

    @property
    def solid_volume(self) -> float:
        """Volume of solids [m³]: none."""
        return 0.0

    def build(self) -> Geometry:
        """Lay out the film and name its parts.

        Returns
        -------
        Geometry
            No region; faces ``film`` (the triangles) and ``tip`` (the end plate), which both belong to ``cavity``, and
            ``fixed`` (the rim at x = 0).
        """
        name = f"Yoshimura bellows, {self.folds} fold{'s' if self.folds > 1 else ''} of {self.sides} sides"
        return film_geometry(name, folded_tube(self._rings(), self.sides), self.smallest_wall, self.cavity_volumes)

    def _rings(self) -> list[Ring]:
        """The polygons from the fixed rim to the end plate: valley, crest, valley and so on."""
        valley, crest = (0.0, self.inner_radius), (pi / self.sides, self.outer_radius)
        kinds = [crest if k % 2 else valley for k in range(2 * self.folds + 1)]
        return [Ring(x=k * self.pitch / 2, turn=turn, radius=radius) for k, (turn, radius) in enumerate(kinds)]
