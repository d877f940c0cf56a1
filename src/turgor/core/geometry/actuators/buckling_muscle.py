"""Buckling muscle: a block of rubber columns that vacuum buckles, so that it gets shorter."""

from dataclasses import dataclass
from itertools import product

from turgor.core.geometry.extrusion import Along, Layer, Sweep, end_names
from turgor.core.geometry.geometry import Geometry, check_volume
from turgor.core.geometry.parts.ends import name_faces
from turgor.core.geometry.rules import MOST_FOLDS, SMALLEST_LENGTH, check_count, check_fields, check_length, in_mm
from turgor.core.geometry.shapes.sections import rectangle
from turgor.core.geometry.shapes.solids import Range, box, cut, face_names, region_names, volume
from turgor.units import m, mm


@dataclass(frozen=True, slots=True, kw_only=True)
class BucklingMuscle:
    """Block of rows of columns between beams, closed by skins: vacuum buckles the columns, and it gets shorter (VAMP).

    This is the vacuum-actuated muscle-inspired pneumatic structure of Yang, Verma, So, Mosadegh, Keplinger, Lee,
    Khashai, Lossner, Suo and Whitesides (2016, Adv. Mater. Technol. 1, 1600055). The sizes were chosen here, as that
    paper gives no full drawing of its lattice. Thinner and longer columns buckle at a smaller vacuum, unless thin outer
    walls or skins buckle first. Thick skins hold back, because they shear where columns sway. A perfect block does not
    know to which side: state an ``imperfection`` of the mesh. All cavities share their pressure, as if by gaps in the
    beams and columns, which are not modeled.

    Axes: x from the fixed end to the tip, along the columns; z across them; y through the depth.

    Parameters
    ----------
    rows : int
        Rows of columns, one behind the other along x, 1 to 50.
    cavities : int
        Cavities in a row, 1 to 50; a column stands between neighbors.
    column_length : float [m]
        Length of the columns between the beams; 0.1 mm to 1 m.
    column : float [m]
        Thickness of the columns along z.
    cavity_width : float [m]
        Width of the cavities between the columns; 0.1 mm to 1 m.
    beam : float [m]
        Thickness along x of the beams between the rows.
    side_wall : float [m]
        Thickness of the outer walls along z.
    end_wall : float [m]
        Thickness of the walls at the fixed end and at the tip.
    depth : float [m]
        Size along y, skins included; 1 mm to 1 m.
    skin : float [m]
        Thickness of the walls that close the cavities at both ends of the depth.
    symmetric : bool
        Whether to model only the half with y >= 0, cut at the face ``symmetry_y``.

    Raises
    ------
    TurgorError
        If a dimension is out of range; the message states the field, its value in mm and the range.

    Examples
    --------
    >>> round(BucklingMuscle(rows=3).length * 1e3, 6)  # mm: three columns of 16 mm, two beams, two end walls
    60.0
    >>> BucklingMuscle(skin=13e-3)
    Traceback (most recent call last):
    turgor.TurgorError: skin is 13 mm; allowed is 0.01 mm to 12.495 mm, so that cavities remain in a depth of 25 mm.
    """

    rows: int = 2
    cavities: int = 3
    column_length: float = 16 * mm
    column: float = 2 * mm
    cavity_width: float = 8 * mm
    beam: float = 3 * mm
    side_wall: float = 3 * mm
    end_wall: float = 3 * mm
    depth: float = 25 * mm
    skin: float = 2 * mm
    symmetric: bool = True

    def __post_init__(self) -> None:
        check_fields(self)
        for name in ("rows", "cavities"):
            check_count(name, getattr(self, name), low=1, high=MOST_FOLDS)
        for name in ("column_length", "cavity_width"):
            check_length(name, getattr(self, name), low=0.1 * mm, high=1 * m)
        for name in ("column", "beam", "side_wall", "end_wall"):
            check_length(name, getattr(self, name), high=1 * m)
        check_length("depth", self.depth, low=1 * mm, high=1 * m)
        high = (self.depth - SMALLEST_LENGTH) / 2
        check_length("skin", self.skin, high=high, why=f"so that cavities remain in a depth of {in_mm(self.depth)}")

    @property
    def length(self) -> float:
        """Length from the fixed end to the tip [m]."""
        return self.rows * self.column_length + (self.rows - 1) * self.beam + 2 * self.end_wall

    @property
    def width(self) -> float:
        """Width across the columns [m]."""
        return self.cavities * self.cavity_width + (self.cavities - 1) * self.column + 2 * self.side_wall

    @property
    def smallest_wall(self) -> float:
        """Thickness of the thinnest wall [m]."""
        walls = [self.side_wall, self.end_wall, self.skin]
        walls += [self.column] if self.cavities > 1 else []
        return min([*walls, self.beam] if self.rows > 1 else walls)

    @property
    def cavity_volumes(self) -> dict[str, float]:
        """Volume of all cavities of the modeled part [m³], from the dimensions."""
        area = self.rows * self.column_length * self.cavities * self.cavity_width
        return {"cavity": area * (self.depth - 2 * self.skin) * self._share}

    @property
    def solid_volume(self) -> float:
        """Volume of the rubber of the modeled part [m³], from the dimensions."""
        return self.length * self.width * self.depth * self._share - self.cavity_volumes["cavity"]

    def build(self) -> Geometry:
        """Build the solid and name it.

        Returns
        -------
        Geometry
            Region ``body``; faces ``cavity`` (all cavities), ``fixed`` (x = 0), ``tip`` (the other end), ``outside``
            and, for a half, ``symmetry_y``.

        Raises
        ------
        TurgorError
            If the CAD volumes are not those of the dimensions.
        """
        cavities = [box(x, self._across(self.depth / 2 - self.skin), z) for x, z in self._openings()]
        for each in cavities:
            each.faces.name = "cavity"
        check_volume("cavity", sum(volume(each) for each in cavities), self.cavity_volumes["cavity"])
        half = self.width / 2
        shape = cut(box((0.0, self.length), self._across(self.depth / 2), (-half, half)), cavities)
        shape.mat("body")
        check_volume("solid", volume(shape), self.solid_volume)
        mirrors = "y" if self.symmetric else ""
        name_faces(shape, end=self.length, mirrors=mirrors)
        return Geometry(
            name=f"buckling muscle, {self.rows} rows of {self.cavities} cavities{', half' if self.symmetric else ''}",
            smallest_wall=self.smallest_wall,
            cavity_volumes=self.cavity_volumes,
            solid_volume=self.solid_volume,
            regions=region_names(shape),
            faces=face_names(shape),
            shape=shape,
            _sweep=self._sweep(mirrors),
        )

    @property
    def _share(self) -> float:
        return 0.5 if self.symmetric else 1.0

    def _across(self, half: float) -> Range:
        return (0.0 if self.symmetric else -half, half)

    def _openings(self) -> list[tuple[Range, Range]]:
        """Ranges of the cavities along x and z."""
        first = -self.width / 2 + self.side_wall
        x = [self.end_wall + k * (self.column_length + self.beam) for k in range(self.rows)]
        z = [first + k * (self.cavity_width + self.column) for k in range(self.cavities)]
        return [((a, a + self.column_length), (b, b + self.cavity_width)) for a, b in product(x, z)]

    def _sweep(self, mirrors: str) -> Sweep:
        """The same shape as layers across: skin, lattice, skin."""
        half = self.width / 2
        solid = (("body", rectangle((0.0, self.length), (-half, half))),)
        lattice = (*solid, *(("cavity", rectangle(x, z)) for x, z in self._openings()))
        inner, outer = self.depth / 2 - self.skin, self.depth / 2
        layers = [Layer(start=-inner, end=inner, fill=lattice), Layer(start=inner, end=outer, fill=solid)]
        if self.symmetric:
            layers[0] = Layer(start=0.0, end=inner, fill=lattice)
        else:
            layers.insert(0, Layer(start=-outer, end=-inner, fill=solid))
        names = end_names(end=self.length, mirrors=mirrors)
        return Sweep(layers=tuple(layers), path=Along(axis=1), names=names)
