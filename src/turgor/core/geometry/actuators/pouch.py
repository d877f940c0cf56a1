"""Pouch: two films with a seam around a flat cavity."""

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

from turgor.core.geometry.geometry import Geometry
from turgor.core.geometry.parts.layout import check_fields
from turgor.core.geometry.rules import check_length
from turgor.core.geometry.shapes.film_shape import FilmShape, Patch
from turgor.units import m, mm


@dataclass(frozen=True, slots=True, kw_only=True)
class Pouch:
    """Two flat films sealed around a rectangle: pressure bulges them, and the pouch gets shorter (pouch motor).

    It has no solid: the films are the whole body, so its materials are sheets, such as
    ``film = { law = "hooke", E = "4 GPa", nu = 0.35, thickness = "50 µm", compression = 0 }`` in a job file. A film
    that cannot stretch, and is much wider than long, bulges to circular arcs; at the half angle θ of an arc its length
    is ``length`` · sin θ / θ, and it pulls with p · ``length`` · ``width`` · cos θ / θ (Niiyama, Sun, Sung, An, Rus and
    Kim 2015, Soft Robotics 2, 59). The sizes were chosen here.

    Axes: x from the fixed seam to the seam that moves (``tip``), y along both, z across the films. The quarter with
    y >= 0 and z >= 0 is modeled: the seams lie in the mirror plane between the films.

    Parameters
    ----------
    length : float [m]
        Length of the flat cavity along x, between the fixed seam and the one that moves; 1 mm to 2 m.
    width : float [m]
        Width of the flat cavity along y; 1 mm to 2 m.
    seam : float [m]
        Width of the seam around the cavity.

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

    def __post_init__(self) -> None:
        check_fields(self)
        for name in ("length", "width"):
            check_length(name, getattr(self, name), low=1 * mm, high=2 * m)
        check_length("seam", self.seam, low=0.1 * mm, high=min(self.length, self.width))

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
        return Geometry(
            name="pouch, quarter",
            smallest_wall=self.smallest_wall,
            cavity_volumes=self.cavity_volumes,
            solid_volume=self.solid_volume,
            regions=(),
            faces=("cavity", "film", "fixed", "seams", "symmetry_y", "symmetry_z", "tip"),
            shape=FilmShape(patches=tuple(self._patches())),
        )

    def _patches(self) -> list[Patch]:
        """Pieces of the upper film, seen from below: a seam, the cavity and the other seam."""
        half = self.width / 2
        pieces = (
            (-self.seam, 0.0, ("seams", "fixed", "symmetry_z"), ""),
            (0.0, self.length, ("film", "cavity"), "symmetry_z"),
            (self.length, self.length + self.seam, ("seams", "tip", "symmetry_z"), ""),
        )
        return [
            Patch(
                corners=((left, 0.0, 0.0), (left, half, 0.0), (right, half, 0.0), (right, 0.0, 0.0)),
                faces=names,
                edges=("", side, "", "symmetry_y"),
            )
            for left, right, names, side in pieces
        ]
