"""Miura tube: an origami tube of film, two mirrored strips of Miura-ori that are joined along their rims."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from itertools import pairwise
from math import cos, hypot, sin, tan
from types import MappingProxyType

from turgor.core.geometry.geometry import Geometry
from turgor.core.geometry.parts.films import film_geometry
from turgor.core.geometry.rules import MOST_FOLDS, check_angle, check_count, check_fields, check_length
from turgor.core.geometry.shapes.film_shape import Patch, Point
from turgor.units import deg, m, mm


@dataclass(frozen=True, slots=True, kw_only=True)
class MiuraTube:
    """Tube of parallelograms, two mirrored strips of Miura-ori: vacuum folds it along its length (Schenk, Guest 2013).

    It has no solid: its materials are sheets, such as
    ``film = { law = "hooke", E = "20 MPa", nu = 0.45, thickness = "1 mm" }`` in a job file, whose bending stiffness
    keeps the folds as they were molded. A point that is coupled rigidly to the face ``tip`` makes the end plate stiff.
    Its sections are rhombi of the side a that lie to and fro across x. The tube folds while its walls stay flat, at one
    degree of freedom (Schenk and Guest 2013, doi 10.1073/pnas.1217998110): with the length S of a row of slanted edges
    b, and the width 2 L and the height 2 H of the rhombus,
    L √(b² − S²) = a b cos γ and L² + H² = a², so that d ln L / d ln S = S² / (b² − S²).
    The volume is largest where H / L = S / b: vacuum shortens a tube that is folded further than that, and makes a
    flatter one longer. A rigid rim or plate keeps its rhombus, so that the walls next to it bend; the plate also moves
    a little along y. The sizes were chosen here.

    Axes: x from the fixed rim to the end plate; y along the width, the way that the rhombi lie to and fro; z along the
    height. The whole tube is modeled.

    Parameters
    ----------
    rows : int
        Rows of parallelograms between the fixed rim and the end plate, 1 to 50.
    side : float [m]
        Side a of the rhombus; 1 mm to 1 m.
    slant : float [m]
        Length b of the edges between two rhombi; 0.5 mm to 1 m.
    sector_angle : float [rad]
        Acute angle γ of the parallelograms.
    fold_angle : float [rad]
        Angle θ between the walls and the plane z = 0 at rest: 0 is flat, 90° has no length.

    Raises
    ------
    TurgorError
        If a dimension is out of range; the message states the field, its value and the range.

    Examples
    --------
    >>> round(MiuraTube(rows=4).length * 1e3, 2)  # mm
    28.35
    >>> MiuraTube(fold_angle=1.57)
    Traceback (most recent call last):
    turgor.TurgorError: fold_angle is 89.954 deg; allowed is 10 deg to 80 deg, so that the tube has a height and a \
length.
    """

    rows: int = 4
    side: float = 20 * mm
    slant: float = 12 * mm
    sector_angle: float = field(default=60 * deg, metadata={"dimension": "angle"})
    fold_angle: float = field(default=65 * deg, metadata={"dimension": "angle"})

    def __post_init__(self) -> None:
        check_fields(self)
        check_count("rows", self.rows, low=1, high=MOST_FOLDS)
        check_length("side", self.side, low=1 * mm, high=1 * m)
        check_length("slant", self.slant, low=0.5 * mm, high=1 * m)
        why = "so that the parallelograms are slanted"
        check_angle("sector_angle", self.sector_angle, low=20 * deg, high=85 * deg, why=why)
        why = "so that the tube has a height and a length"
        check_angle("fold_angle", self.fold_angle, low=10 * deg, high=80 * deg, why=why)

    @property
    def row_length(self) -> float:
        """Length S of a row along x [m], at rest."""
        slope = cos(self.fold_angle) * tan(self.sector_angle)
        return self.slant * slope / hypot(1, slope)

    @property
    def length(self) -> float:
        """Length from the fixed rim to the end plate [m]."""
        return self.rows * self.row_length

    @property
    def height(self) -> float:
        """Height 2 H of the rhombus along z [m], at rest."""
        return 2 * self.side * sin(self.fold_angle) * sin(self.sector_angle)

    @property
    def width(self) -> float:
        """Width 2 L of the rhombus along y [m], at rest."""
        return (4 * self.side**2 - self.height**2) ** 0.5

    @property
    def smallest_wall(self) -> float:
        """Slanted edge or side of the rhombus [m], the smallest length that cells should follow."""
        return min(self.slant, self.side)

    @property
    def cavity_volumes(self) -> Mapping[str, float]:
        """Volume of the tube [m³], at rest."""
        return MappingProxyType({"cavity": self.length * self.width * self.height / 2})

    @property
    def solid_volume(self) -> float:
        """Volume of solids [m³]: none."""
        return 0.0

    def build(self) -> Geometry:
        """Lay out the film and name its parts.

        Returns
        -------
        Geometry
            No region; faces ``film`` (the walls) and ``tip`` (the end plate), which both belong to ``cavity``, and
            ``fixed`` (the rim at x = 0).
        """
        name = f"Miura tube of {self.rows} row{'s' if self.rows > 1 else ''}"
        return film_geometry(name, self._patches(), self.smallest_wall, self.cavity_volumes)

    def _patches(self) -> list[Patch]:
        """Four parallelograms in each row, and the plate."""
        rhombi = [self._rhombus(k) for k in range(self.rows + 1)]
        patches = []
        for row, (low, high) in enumerate(pairwise(rhombi)):
            edges = ("" if row else "fixed", "", "", "")
            for k in range(4):
                corners = (low[(k + 1) % 4], low[k], high[k], high[(k + 1) % 4])
                patches.append(Patch(corners=corners, faces=("film", "cavity"), edges=edges))
        a, b, c, d = rhombi[-1]
        return [*patches, Patch(corners=(d, c, b, a), faces=("tip", "cavity"))]

    def _rhombus(self, k: int) -> tuple[Point, Point, Point, Point]:
        """Corners of a section, counterclockwise seen from the tip; those of odd number lie further along y."""
        x, y = k * self.row_length, (k % 2) * (self.slant**2 - self.row_length**2) ** 0.5
        half, tall = self.width / 2, self.height / 2
        return (x, y + half, 0.0), (x, y, tall), (x, y - half, 0.0), (x, y, -tall)
