"""Inflatable beam: a tube of film that pressure makes stiff."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import pi, sqrt
from types import MappingProxyType

from turgor.core.geometry.geometry import Geometry
from turgor.core.geometry.parts.films import film_geometry
from turgor.core.geometry.parts.layout import check_fields
from turgor.core.geometry.rules import check_length
from turgor.core.geometry.shapes.film_shape import Patch, Point
from turgor.units import m, mm

#: Where the disc is cut into patches, as shares of the radius: on its axes, on its diagonals, and on its rim there.
_ON_AXIS, _ON_DIAGONAL, _ON_RIM = 0.5, 0.38, sqrt(0.5)


@dataclass(frozen=True, slots=True, kw_only=True)
class InflatableBeam:
    """Round tube of film between a clamped rim and an end plate: pressure makes it a beam that bears a load at its tip.

    It has no solid: its materials are sheets, such as
    ``film = { law = "hooke", E = "600 MPa", nu = 0.3, thickness = "0.4 mm", compression = 0 }`` in a job file. A point
    that is coupled rigidly to the face ``tip`` makes the end plate stiff. Under the force F the film wrinkles at the
    clamp from F L = π p R³ / 2 on, with ``length`` L and ``radius`` R, and the beam collapses at twice that moment
    (Comer and Levy 1963, doi 10.2514/3.1873). The sizes were chosen here.

    Axes: x from the clamped rim to the end plate, on the axis of the tube. The half with y >= 0 is modeled; it bends
    in the plane of x and z.

    Parameters
    ----------
    length : float [m]
        Length from the clamped rim to the end plate; 1 mm to 20 m.
    radius : float [m]
        Radius of the tube at the clamp, without pressure; 0.5 mm to 2 m.
    tip_radius : float [m]
        That at the end plate, for a cone; 0 for the same radius.

    Raises
    ------
    TurgorError
        If a dimension is out of range; the message states the field, its value in mm and the range.

    Examples
    --------
    >>> InflatableBeam(length=0.4).build().faces
    ('cavity', 'film', 'fixed', 'symmetry_y', 'tip')
    >>> InflatableBeam(radius=0)
    Traceback (most recent call last):
    turgor.TurgorError: radius is 0 mm; allowed is 0.5 mm to 2000 mm.
    """

    length: float = 500 * mm
    radius: float = 50 * mm
    tip_radius: float = 0.0

    def __post_init__(self) -> None:
        check_fields(self)
        check_length("length", self.length, low=1 * mm, high=20 * m)
        check_length("radius", self.radius, low=0.5 * mm, high=2 * m)
        if self.tip_radius:
            check_length("tip_radius", self.tip_radius, low=0.5 * mm, high=2 * m)

    @property
    def smallest_wall(self) -> float:
        """Smaller radius [m], the smallest length that cells should follow."""
        return min(self.radius, self._end)

    @property
    def cavity_volumes(self) -> Mapping[str, float]:
        """Volume of the modeled half of the tube [m³], without pressure."""
        a, b = self.radius, self._end
        return MappingProxyType({"cavity": pi * (a**2 + a * b + b**2) / 3 * self.length / 2})

    @property
    def solid_volume(self) -> float:
        """Volume of solids [m³]: none."""
        return 0.0

    def build(self) -> Geometry:
        """Lay out the film and name its parts.

        Returns
        -------
        Geometry
            No region; faces ``film`` (the tube) and ``tip`` (the end plate), which both belong to ``cavity``,
            ``fixed`` (the clamped rim) and ``symmetry_y``.
        """
        name = "inflatable beam, half"
        return film_geometry(name, (*self._tube(), *self._plate()), self.smallest_wall, self.cavity_volumes)

    @property
    def _end(self) -> float:
        """Radius at the end plate [m]."""
        return self.tip_radius or self.radius

    def _at(self, x: float, y: float, z: float) -> Point:
        """A point at a place along the axis, 0 or its length, and at shares of the radius there."""
        radius = self._end if x else self.radius
        return (x, y * radius, z * radius)

    def _tube(self) -> list[Patch]:
        """Eighths of the tube from the top to the bottom, seen from inside."""
        rim = ((0.0, 1.0), (_ON_RIM, _ON_RIM), (1.0, 0.0), (_ON_RIM, -_ON_RIM), (0.0, -1.0))
        low, high = 0.0, self.length
        return [
            Patch(
                corners=(self._at(low, *a), self._at(low, *b), self._at(high, *b), self._at(high, *a)),
                faces=("film", "cavity"),
                edges=("fixed", "" if b[0] else "symmetry_y", "", "" if a[0] else "symmetry_y"),
                arcs=((low, 0.0, 0.0), None, (high, 0.0, 0.0), None),
            )
            for a, b in pairwise(rim)
        ]

    def _plate(self) -> list[Patch]:
        """The end plate, seen from inside: a square of film and two pieces around it in each quarter."""
        a, b, c = _ON_AXIS, _ON_DIAGONAL, _ON_RIM
        square, side, top = (
            ((0.0, 0.0), (0.0, a), (b, b), (a, 0.0)),
            ((a, 0.0), (b, b), (c, c), (1.0, 0.0)),
            ((0.0, a), (0.0, 1.0), (c, c), (b, b)),
        )
        return [
            piece
            for sign in (1.0, -1.0)
            for piece in (
                self._on_plate(square, sign, cut=0, rim=None),
                self._on_plate(side, sign, cut=None, rim=2),
                self._on_plate(top, sign, cut=0, rim=1),
            )
        ]

    def _on_plate(self, corners: Sequence[tuple[float, float]], sign: float, cut: int | None, rim: int | None) -> Patch:
        """A piece of the upper half of the plate or its image below; its edges on the mirror plane and on the rim."""
        names = ["symmetry_y" if k == cut else "" for k in range(4)]
        arcs = [(self.length, 0.0, 0.0) if k == rim else None for k in range(4)]
        places = [self._at(self.length, y, sign * z) for y, z in corners]
        if sign < 0:  # the image runs around the other way
            places, names, arcs = places[::-1], [*names[2::-1], names[3]], [*arcs[2::-1], arcs[3]]
        (p, q, r, s), (n0, n1, n2, n3), (c0, c1, c2, c3) = places, names, arcs
        return Patch(corners=(p, q, r, s), faces=("tip", "cavity"), edges=(n0, n1, n2, n3), arcs=(c0, c1, c2, c3))
