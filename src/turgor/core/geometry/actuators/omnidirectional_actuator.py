"""Omnidirectional actuator: a cylinder with several independent chambers around its axis."""

from dataclasses import dataclass
from math import pi, sin, sqrt
from typing import Any

from turgor.core.geometry import occ
from turgor.core.geometry.extrusion import Part, Sweep, end_names, layers_of
from turgor.core.geometry.geometry import Geometry, check_volume
from turgor.core.geometry.parts.chambers import SHAPES, ChamberSection, arrangement, largest_size
from turgor.core.geometry.parts.ends import name_faces
from turgor.core.geometry.rules import SMALLEST_LENGTH, check_choice, check_count, check_fields, check_length, in_mm
from turgor.core.geometry.shapes.sections import Outline, disc, prism
from turgor.core.geometry.shapes.solids import cut, face_names, region_names, union, volume
from turgor.units import m, mm


@dataclass(frozen=True, slots=True, kw_only=True)
class OmnidirectionalActuator:
    """Omnidirectional actuator of Suzumori et al.: equal chambers around the axis of a cylinder.

    One chamber under pressure bends the cylinder away from that chamber, equal pressures in all of them stretch it.
    Xavier, Fleming and Yong (2021) compare six chamber sections (Elsayed et al. 2014, Xie et al. 2018). Their reference
    geometry for three chambers has an outer radius of 12.5 mm, a length of 60 mm and end caps of 5 mm. All other
    defaults were chosen here.

    The first chamber lies at +z, the others follow counterclockwise seen from the tip.

    Parameters
    ----------
    chambers : int
        Number of chambers, 2 to 8.
    length : float [m]
        Length, end caps included, clamped block not.
    outer_radius : float [m]
        Radius of the cylinder.
    chamber_shape : str
        ``"circular"``, ``"semicircular_flat_inward"``, ``"semicircular_flat_outward"``, ``"ring_sector"``,
        ``"triangular_flat_outward"`` or ``"triangular_apex_outward"``.
    chamber_size : float [m]
        Diameter of a circle, flat side of a half circle, side of an (equilateral) triangle, depth of a ring sector.
    wall : float [m]
        Thickness between a chamber and the outside where it is thinnest.
    web : float [m]
        Thickness of the walls between ring sectors. Not used by the other shapes, whose size decides it.
    bore_radius : float [m]
        Radius of the bore on the axis, open at both ends; 0 leaves it out.
    cap : float [m]
        Thickness of the end caps.
    inlet_diameter : float [m]
        Diameter of the air inlet of each chamber through the fixed end, at the middle of the chamber; 0 leaves the
        inlets out and closes the cavities.
    clamp_length : float [m]
        Length of a solid block before the first cap, fixed on all its sides; 0 leaves it out.
    symmetric : bool
        Whether to model only the half with y >= 0, cut at the face ``symmetry_y``. It holds where chambers that
        mirror each other share one pressure: they share a name, that of the first of them.

    Raises
    ------
    TurgorError
        If a dimension is out of range; the message states the field, its value in mm and the range.

    Examples
    --------
    >>> OmnidirectionalActuator().build().faces
    ('cavity_1', 'cavity_2', 'cavity_3', 'fixed', 'outside', 'tip')
    >>> OmnidirectionalActuator(symmetric=True).build().faces
    ('cavity_1', 'cavity_2', 'fixed', 'outside', 'symmetry_y', 'tip')
    >>> OmnidirectionalActuator(chamber_size=12e-3)
    Traceback (most recent call last):
    turgor.TurgorError: chamber_size is 12 mm; allowed is 0.01 mm to 9.74 mm, so that 3 chambers keep walls \
of 0.01 mm between them.
    """

    chambers: int = 3
    length: float = 60 * mm
    outer_radius: float = 12.5 * mm
    chamber_shape: str = "circular"
    chamber_size: float = 8 * mm
    wall: float = 2 * mm
    web: float = 2 * mm
    bore_radius: float = 0.0
    cap: float = 5 * mm
    inlet_diameter: float = 0.0
    clamp_length: float = 0.0
    symmetric: bool = False

    def __post_init__(self) -> None:
        check_count("chambers", self.chambers, low=2, high=8)
        check_fields(self)
        check_choice("chamber_shape", self.chamber_shape, SHAPES)
        least = SMALLEST_LENGTH
        check_length("length", self.length, low=1 * mm, high=2 * m)
        check_length("outer_radius", self.outer_radius, low=1 * mm, high=1 * m)
        why = f"so that a cavity remains within the length of {in_mm(self.length)}"
        check_length("cap", self.cap, low=least, high=(self.length - least) / 2, why=why)
        if self.clamp_length:
            check_length("clamp_length", self.clamp_length, low=least, high=1 * m, why="0 leaves it out")
        if self.bore_radius:
            check_length(
                "bore_radius", self.bore_radius, low=least, high=self.outer_radius - 4 * least, why="0 leaves it out"
            )
        high = self.outer_radius - self.bore_radius - 3 * least
        check_length("wall", self.wall, low=least, high=high, why="so that chambers fit inside it")
        if self.chamber_shape == "ring_sector":
            # the thinnest ring that is accepted is between two sectors' sides and within the wall
            half_chord = (self.outer_radius - self.wall - least) * sin(pi / self.chambers)
            why = f"so that {self.chambers} ring sectors keep an inside"
            check_length("web", self.web, low=least, high=2 * sqrt(max(half_chord**2 - (least / 2) ** 2, 0.0)), why=why)
        self._check_size()

    def _check_size(self) -> None:
        least = SMALLEST_LENGTH
        high = largest_size(self._section, self.bore_radius, least)
        around = " and around the bore" if self.bore_radius else ""
        why = f"so that {self.chambers} chambers keep walls of {in_mm(least)} between them{around}"
        check_length("chamber_size", self.chamber_size, low=least, high=high, why=why)
        if self.inlet_diameter:
            high, why = 2 * (self._section.room - SMALLEST_LENGTH), "so that it opens into the chamber; 0 leaves it out"
            check_length("inlet_diameter", self.inlet_diameter, low=least, high=high, why=why)

    @property
    def smallest_wall(self) -> float:
        """Thickness of the thinnest wall [m]: outside, between chambers, around the bore, at the ends."""
        section = self._section
        around = [section.nearest - self.bore_radius] if self.bore_radius else []
        return min(self.wall, self.cap, section.between, *around)

    @property
    def cavity_volumes(self) -> dict[str, float]:
        """Volume of each cavity of the modeled part by the name of its face [m³], from the dimensions."""
        inside, duct = self.length - 2 * self.cap, pi * (self.inlet_diameter / 2) ** 2 * self._start
        return {
            name: (self._section.outline(number).area * inside + duct) / (2 if on_mirror else 1)
            for name, number, on_mirror in self._chambers()
        }

    @property
    def solid_volume(self) -> float:
        """Volume of the silicone of the modeled part [m³], from the dimensions."""
        bore = self._part(disc(self.bore_radius)).area if self.bore_radius else 0.0
        section = self._part(disc(self.outer_radius)).area - bore
        return section * self._end - sum(self.cavity_volumes.values())

    def build(self) -> Geometry:
        """Build the solid and name it.

        Returns
        -------
        Geometry
            Region ``body``; faces ``cavity_1``, ``cavity_2``, … (with their inlets, where there are some), ``fixed``
            (the plane x = 0 and the sides of the clamped block), ``tip`` (the other end), ``outside`` (the rest, with
            the bore) and, for a half, ``symmetry_y``.

        Raises
        ------
        TurgorError
            If the CAD volumes are not those of the dimensions.
        """
        cavities = self._cavities()
        volumes = self.cavity_volumes
        for name, cavity in cavities.items():
            check_volume(name, volume(cavity), volumes[name])
        tools = list(cavities.values())
        if self.bore_radius:
            tools.append(prism(self._part(disc(self.bore_radius)), (0.0, self._end)))
        outside, clamp = self._part(disc(self.outer_radius)), self.clamp_length
        solids = [prism(outside, (clamp, self._end)), *([prism(outside, (0.0, clamp))] if clamp else [])]
        shape = cut(occ.Fuse(solids) if clamp else solids[0], tools)
        shape.mat("body")
        check_volume("solid", volume(shape), self.solid_volume)
        name_faces(shape, end=self._end, clamp=self.clamp_length, mirrors="y" if self.symmetric else "")
        return Geometry(
            name=f"omnidirectional actuator, {self.chambers} chambers{', half' if self.symmetric else ''}",
            smallest_wall=self.smallest_wall,
            cavity_volumes=volumes,
            solid_volume=self.solid_volume,
            regions=region_names(shape),
            faces=face_names(shape),
            shape=shape,
            _sweep=self._sweep(),
        )

    def _sweep(self) -> Sweep:
        """The same shape as layers along x: the end with its inlets, the chambers, the other end."""
        whole, inside = (0.0, self._end), (self._start, self._end - self.cap)
        parts: list[Part] = [("body", self._part(disc(self.outer_radius)), whole)]
        if self.clamp_length:
            parts.append(("body", self._part(disc(self.outer_radius)), (0.0, self.clamp_length)))
        if self.bore_radius:
            parts.append(("outside", self._part(disc(self.bore_radius)), whole))
        for name, number, _ in self._chambers():
            parts.append((name, self._part(self._section.outline(number)), inside))
            if self.inlet_diameter:
                duct = disc(self.inlet_diameter / 2, self._section.middle(number))
                parts.append((name, self._part(duct), (0.0, self._start)))
        names = end_names(end=self._end, clamp=self.clamp_length, mirrors="y" if self.symmetric else "")
        return Sweep(layers=layers_of(parts), names=names)

    @property
    def _start(self) -> float:
        """Where the cavities begin [m]."""
        return self.clamp_length + self.cap

    @property
    def _end(self) -> float:
        return self.clamp_length + self.length

    @property
    def _section(self) -> ChamberSection:
        return ChamberSection(
            shape=self.chamber_shape,
            count=self.chambers,
            size=self.chamber_size,
            reach=self.outer_radius - self.wall,
            web=self.web,
        )

    def _part(self, outline: Outline) -> Outline:
        return outline.cut_y() if self.symmetric else outline

    def _chambers(self) -> list[tuple[str, int, bool]]:
        return arrangement(self.chambers, self.symmetric)

    def _cavities(self) -> dict[str, Any]:
        """The chambers as solids, with their inlets."""
        section, cavities = self._section, {}
        for name, number, _ in self._chambers():
            pieces = [prism(self._part(section.outline(number)), (self._start, self._end - self.cap))]
            if self.inlet_diameter:
                duct = disc(self.inlet_diameter / 2, section.middle(number))
                pieces.append(prism(self._part(duct), (0.0, self._start)))
            cavity = union(pieces)
            cavity.faces.name = name
            cavities[name] = cavity
        return cavities
