"""Pouches of film in a row, each with a seam around a flat cavity: a pouch motor, or the cell of a textile muscle."""

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

from turgor.core.geometry.geometry import Geometry
from turgor.core.geometry.parts.films import film_geometry
from turgor.core.geometry.parts.layout import check_fields
from turgor.core.geometry.rules import MOST_CHAMBERS, check_count, check_length
from turgor.core.geometry.shapes.film_shape import Patch
from turgor.units import m, mm


@dataclass(frozen=True, slots=True, kw_only=True)
class Pouch:
    """One pouch or a row between two films: pressure bulges them, they get shorter (pouch motor, textile muscle).

    It has no solid: the films are the whole body, so its materials are sheets, such as
    ``film = { law = "hooke", E = "4 GPa", nu = 0.35, thickness = "50 µm", compression = 0 }`` in a job file. A film
    that cannot stretch, and is much wider than long, bulges to circular arcs; at the half angle θ of an arc its length
    is ``length`` · sin θ / θ, and it pulls with p · ``length`` · ``width`` · cos θ / θ (Niiyama, Sun, Sung, An, Rus and
    Kim 2015, Soft Robotics 2, 59). A row of ``count`` pouches, as in a textile muscle of two fabrics that are joined
    along lines, gets shorter by ``count`` times as much and pulls with the same force. The pouches share their
    pressure, as if by gaps in their seams, which are not modeled. The sizes were chosen here.

    Axes: x from the fixed seam to the seam that moves (``tip``), y along both, z across the films. The quarter with
    y >= 0 and z >= 0 is modeled: the seams lie in the mirror plane between the films, and a sheet on them is that of
    the upper film, half of the whole seam.

    Parameters
    ----------
    length : float [m]
        Length of the flat cavity of a pouch along x, from seam to seam; 1 mm to 2 m.
    width : float [m]
        Width of the flat cavity along y; 1 mm to 2 m.
    seam : float [m]
        Width of the seams, also of those between pouches.
    count : int
        Pouches in the row, 1 to 100.

    Raises
    ------
    TurgorError
        If a dimension is out of range; the message states the field, its value in mm and the range.

    Examples
    --------
    >>> Pouch(length=40e-3).build().faces
    ('cavity', 'film', 'fixed', 'seams', 'symmetry_y', 'symmetry_z', 'tip')
    >>> Pouch(seam=0)
    Traceback (most recent call last):
    turgor.TurgorError: seam is 0 mm; allowed is 0.1 mm to 50 mm.
    """

    length: float = 50 * mm
    width: float = 100 * mm
    seam: float = 5 * mm
    count: int = 1

    def __post_init__(self) -> None:
        check_fields(self)
        for name in ("length", "width"):
            check_length(name, getattr(self, name), low=1 * mm, high=2 * m)
        check_length("seam", self.seam, low=0.1 * mm, high=min(self.length, self.width))
        check_count("count", self.count, low=1, high=MOST_CHAMBERS)

    @property
    def smallest_wall(self) -> float:
        """Width of the seam [m], the smallest length that cells should follow."""
        return self.seam

    @property
    def cavity_volumes(self) -> Mapping[str, float]:
        """Volume of the flat cavity [m³]: none."""
        return MappingProxyType({"cavity": 0.0})

    @property
    def solid_volume(self) -> float:
        """Volume of solids [m³]: none."""
        return 0.0

    def build(self) -> Geometry:
        """Lay out the film and name its parts.

        Returns
        -------
        Geometry
            No region; faces ``film`` (what bulges, also called ``cavity``), ``seams`` (both of them, apart ``fixed``
            and ``tip``), ``symmetry_y``, and ``symmetry_z`` (the seams and the edge at the side).
        """
        name = "pouch, quarter" if self.count == 1 else f"row of {self.count} pouches, quarter"
        return film_geometry(name, self._patches(), self.smallest_wall, self.cavity_volumes)

    def _patches(self) -> list[Patch]:
        """Pieces of the upper film, seen from below: a seam, then a cavity and a seam for each pouch."""
        pitch = self.length + self.seam
        first, last = ("seams", "fixed", "symmetry_z"), ("seams", "tip", "symmetry_z")
        pieces = [self._piece(-self.seam, 0.0, first, "")]
        for k in range(self.count):
            right = k * pitch + self.length
            names = last if k == self.count - 1 else ("seams", "symmetry_z")
            pieces.append(self._piece(k * pitch, right, ("film", "cavity"), "symmetry_z"))
            pieces.append(self._piece(right, right + self.seam, names, ""))
        return pieces

    def _piece(self, left: float, right: float, faces: tuple[str, ...], side: str) -> Patch:
        """A piece of the upper film between two places along x, its faces, and the name of its edge at the side."""
        half = self.width / 2
        return Patch(
            corners=((left, 0.0, 0.0), (left, half, 0.0), (right, half, 0.0), (right, 0.0, 0.0)),
            faces=faces,
            edges=("", side, "", "symmetry_y"),
        )
