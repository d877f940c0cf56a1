"""Revolute joint: two stiff links, a hinge between them, and extending cylinders next to it that turn it."""

from collections.abc import Mapping
from dataclasses import dataclass

from turgor.core.geometry.geometry import Geometry
from turgor.core.geometry.parts.layout import Layout, Prism
from turgor.core.geometry.rules import SMALLEST_LENGTH, check_count, check_fields, check_length, in_mm
from turgor.core.geometry.shapes.sections import Outline, disc, rectangle
from turgor.units import m, mm


@dataclass(frozen=True, slots=True, kw_only=True)
class RevoluteJoint:
    """Revolute joint with one degree of freedom (Xavier et al. 2021, fig. 1f, after Skorina et al. 2015 and 2018).

    Each link is an end plate with an arm towards the middle, where a thin hinge joins the two arms. Cylinders run from
    plate to plate next to the arms. The one under pressure gets longer and turns the upper link away from it, about the
    y axis through the hinge. Two cylinders turn it both ways. This is a simple model of the published joint; all
    dimensions were chosen here.

    In the published device fibers keep the cylinders from ballooning. The example job has no fibers, so its pressure is
    small.

    Axes: x from the lower link (the fixed end) to the upper one (the tip), y along the hinge. The first cylinder lies
    at +z, the second at −z.

    Parameters
    ----------
    actuators : int
        Number of cylinders, 1 or 2.
    length : float [m]
        Length over all, from the outside of one end plate to that of the other.
    width : float [m]
        Width of links and hinge, across the plane of motion.
    plate_thickness : float [m]
        Thickness of the end plates.
    arm_height : float [m]
        Thickness of the arms, in the plane of motion.
    hinge_thickness : float [m]
        Thickness of the hinge.
    hinge_length : float [m]
        Length of the hinge: the gap between the arms.
    inner_radius : float [m]
        Radius of the cavities.
    wall : float [m]
        Thickness of the wall around them.
    cap : float [m]
        Thickness of the caps of a cylinder, which are of its silicone.
    offset : float [m]
        Distance between the axis of a cylinder and the middle of the hinge.
    margin : float [m]
        How far the end plates reach beyond the cylinders (beyond the arm, where there is none).
    inlet_diameter : float [m]
        Diameter of the air inlet of each cylinder through the lower link; 0 leaves the inlets out.
    symmetric : bool
        Whether to model only the half with y >= 0, cut at the face ``symmetry_y``.

    Raises
    ------
    TurgorError
        If a dimension is out of range; the message states the field, its value in mm and the range.

    Examples
    --------
    >>> joint = RevoluteJoint().build()
    >>> joint.regions
    ('link', 'hinge', 'body')
    >>> joint.faces
    ('cavity_1', 'cavity_2', 'fixed', 'interface', 'outside', 'symmetry_y', 'tip')
    >>> RevoluteJoint(actuators=1).build().faces[0]
    'cavity'
    >>> RevoluteJoint(offset=8e-3)
    Traceback (most recent call last):
    turgor.TurgorError: offset is 8 mm; allowed is 9.51 mm to 1000 mm, so that cylinders of 13 mm stay clear \
of arms of 6 mm.
    """

    actuators: int = 2
    length: float = 60 * mm
    width: float = 18 * mm
    plate_thickness: float = 4 * mm
    arm_height: float = 6 * mm
    hinge_thickness: float = 2 * mm
    hinge_length: float = 6 * mm
    inner_radius: float = 5 * mm
    wall: float = 1.5 * mm
    cap: float = 4 * mm
    offset: float = 13 * mm
    margin: float = 2 * mm
    inlet_diameter: float = 0.0
    symmetric: bool = True

    def __post_init__(self) -> None:
        check_fields(self)
        check_count("actuators", self.actuators, low=1, high=2)
        least = SMALLEST_LENGTH
        check_length("length", self.length, low=1 * mm, high=2 * m)
        why = f"so that cylinders remain within the length of {in_mm(self.length)}"
        check_length("plate_thickness", self.plate_thickness, low=0.1 * mm, high=self.length / 2 - 2 * least, why=why)
        free = self.length - 2 * self.plate_thickness
        why = f"so that a cavity remains between plates {in_mm(free)} apart"
        check_length("cap", self.cap, low=least, high=(free - least) / 2, why=why)
        why = f"so that arms remain between plates {in_mm(free)} apart"
        check_length("hinge_length", self.hinge_length, low=0.1 * mm, high=free - 2 * least, why=why)
        check_length("arm_height", self.arm_height, low=0.1 * mm, high=0.5 * m)
        why = "no thicker than the arms"
        check_length("hinge_thickness", self.hinge_thickness, low=0.1 * mm, high=self.arm_height, why=why)
        for name in ("inner_radius", "wall", "margin"):
            check_length(name, getattr(self, name), low=0.1 * mm, high=0.2 * m)
        across = f"cylinders of {in_mm(2 * self.outer_radius)}"
        why = f"so that {across} fit on the end plates"
        check_length("width", self.width, low=2 * self.outer_radius, high=1 * m, why=why)
        if self.inlet_diameter:
            why = "less than the cavity; 0 leaves it out"
            check_length("inlet_diameter", self.inlet_diameter, high=2 * (self.inner_radius - least), why=why)
        clear, why = self.outer_radius + self.arm_height / 2, f"so that {across} stay clear of arms of "
        check_length("offset", self.offset, low=clear + least, high=1 * m, why=why + in_mm(self.arm_height))

    @property
    def outer_radius(self) -> float:
        """Radius of a cylinder [m]."""
        return self.inner_radius + self.wall

    @property
    def smallest_wall(self) -> float:
        """Thickness of the thinnest part [m]: wall, cap, hinge, arm or plate."""
        return min(self.wall, self.cap, self.hinge_thickness, self.arm_height, self.plate_thickness)

    @property
    def cavity_volumes(self) -> Mapping[str, float]:
        """Volume of each cavity of the modeled part by the name of its face [m³], from the dimensions."""
        return self._layout.cavity_volumes

    @property
    def solid_volume(self) -> float:
        """Volume of cylinders, links and hinge of the modeled part [m³], from the dimensions."""
        return self._layout.solid_volume

    def build(self) -> Geometry:
        """Build the solids and name them.

        Returns
        -------
        Geometry
            Regions ``link`` (both), ``hinge`` and ``body`` (the cylinders); faces ``cavity`` of one cylinder or
            ``cavity_1`` and ``cavity_2``, ``fixed`` (the plane x = 0), ``tip`` (the far side of the upper link),
            ``interface`` (where the parts are joined), ``outside`` (the rest) and, for a half, ``symmetry_y``.

        Raises
        ------
        TurgorError
            If the CAD volumes are not those of the dimensions.
        """
        return self._layout.build()

    @property
    def _layout(self) -> Layout:
        plate, middle, end = self.plate_thickness, self.length / 2, self.length
        gap = self.hinge_length / 2
        arm = self._slab(-self.arm_height / 2, self.arm_height / 2)
        hinge = self._slab(-self.hinge_thickness / 2, self.hinge_thickness / 2)
        above = self.offset + self.outer_radius + self.margin
        end_plate = self._slab(-above if self.actuators == 2 else -self.arm_height / 2 - self.margin, above)
        pieces = [
            Prism(name="link", outline=end_plate, along=(0.0, plate)),
            Prism(name="link", outline=arm, along=(plate, middle - gap)),
            Prism(name="hinge", outline=hinge, along=(middle - gap, middle + gap)),
            Prism(name="link", outline=arm, along=(middle + gap, end - plate)),
            Prism(name="link", outline=end_plate, along=(end - plate, end)),
        ]
        air, names = [], ("cavity",) if self.actuators == 1 else ("cavity_1", "cavity_2")
        for name, center in zip(names, (self.offset, -self.offset), strict=False):
            place, inside = (0.0, center), (plate + self.cap, end - plate - self.cap)
            pieces.append(Prism(name="body", outline=disc(self.outer_radius, place), along=(plate, end - plate)))
            air.append(Prism(name=name, outline=disc(self.inner_radius, place), along=inside))
            if self.inlet_diameter:
                air.append(Prism(name=name, outline=disc(self.inlet_diameter / 2, place), along=(0.0, inside[0])))
        return Layout(
            title=f"revolute joint, {self.actuators} cylinder{'s' if self.actuators == 2 else ''}",
            pieces=tuple(pieces),
            air=tuple(air),
            length=end,
            mirrors="y" if self.symmetric else "",
            smallest_wall=self.smallest_wall,
        )

    def _slab(self, low: float, high: float) -> Outline:
        """A rectangle over the whole width, between two heights."""
        return rectangle((-self.width / 2, self.width / 2), (low, high))
