"""Kresling tube: an origami tube of film that twists as it gets shorter."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from math import pi
from types import MappingProxyType

from turgor.core.geometry.geometry import Geometry
from turgor.core.geometry.parts.facets import Ring, folded_tube, folded_volume
from turgor.core.geometry.parts.films import film_geometry
from turgor.core.geometry.rules import MOST_FOLDS, check_angle, check_count, check_fields, check_length
from turgor.units import deg, m, mm


@dataclass(frozen=True, slots=True, kw_only=True)
class KreslingTube:
    """Tube of triangles between polygons, each turned against the one before: vacuum shortens and twists it (Kresling).

    It has no solid: its materials are sheets, such as
    ``film = { law = "hooke", E = "20 MPa", nu = 0.45, thickness = "1 mm" }`` in a job file, whose bending stiffness
    keeps the folds as they were molded. A point that is coupled rigidly to the face ``tip`` makes the end plate stiff.
    Flat triangles fit between the polygons at single heights only, so that the folds must stretch on the way: a tube of
    thin film snaps, one of thick film folds smoothly. Bars in the place of the folds, of the lengths
    b² = h² + 2 R² (1 − cos θ) and c² = h² + 2 R² (1 − cos(θ − 2π/n)), have the least energy at the turn θ of the height
    h (Kidambi and Wang 2020, doi 10.1103/PhysRevE.101.063003); film turns a little less. The sizes were chosen here.

    Axes: x from the fixed rim to the end plate, on the axis of the tube. The whole tube is modeled.

    Parameters
    ----------
    sides : int
        Corners of the polygons, 3 to 24.
    cells : int
        Rows of triangles between the fixed rim and the end plate, 1 to 50.
    radius : float [m]
        Circumradius of the polygons; 1 mm to 1 m.
    height : float [m]
        Height of a row at rest; 0.5 mm to 1 m.
    turn : float [rad]
        Angle by which each polygon is turned against the one before, at rest.
    alternating : bool
        Whether every other row is turned the other way, so that the end plate does not twist where the number of rows
        is even.

    Raises
    ------
    TurgorError
        If a dimension is out of range; the message states the field, its value and the range.

    Examples
    --------
    >>> KreslingTube(cells=2).length
    0.04
    >>> KreslingTube(sides=4, turn=2.0)
    Traceback (most recent call last):
    turgor.TurgorError: turn is 114.59 deg; allowed is 5 deg to 90 deg, so that triangles of 4 sides do not meet \
on the axis.
    """

    sides: int = 6
    cells: int = 2
    radius: float = 20 * mm
    height: float = 20 * mm
    turn: float = field(default=90 * deg, metadata={"dimension": "angle"})
    alternating: bool = False

    def __post_init__(self) -> None:
        check_fields(self)
        check_count("sides", self.sides, low=3, high=24)
        check_count("cells", self.cells, low=1, high=MOST_FOLDS)
        check_length("radius", self.radius, low=1 * mm, high=1 * m)
        check_length("height", self.height, low=0.5 * mm, high=1 * m)
        why = f"so that triangles of {self.sides} sides do not meet on the axis"
        check_angle("turn", self.turn, low=5 * deg, high=pi - 2 * pi / self.sides, why=why)

    @property
    def length(self) -> float:
        """Length from the fixed rim to the end plate [m]."""
        return self.cells * self.height

    @property
    def smallest_wall(self) -> float:
        """Height of a row or side of a polygon [m], the smallest length that cells should follow."""
        return min(self.height, self.radius)

    @property
    def cavity_volumes(self) -> Mapping[str, float]:
        """Volume of the tube [m³], at rest."""
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
        name = f"Kresling tube, {self.cells} row{'s' if self.cells > 1 else ''} of {self.sides} sides"
        return film_geometry(name, folded_tube(self._rings(), self.sides), self.smallest_wall, self.cavity_volumes)

    def _rings(self) -> list[Ring]:
        """The polygons from the fixed rim to the end plate."""
        turns = [k % 2 if self.alternating else k for k in range(self.cells + 1)]
        return [Ring(x=k * self.height, turn=turn * self.turn, radius=self.radius) for k, turn in enumerate(turns)]
