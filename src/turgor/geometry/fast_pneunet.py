"""Fast PneuNet: a row of chambers with gaps between them on a base with a strain-limiting layer."""

from dataclasses import dataclass, fields
from typing import Any

from turgor.errors import TurgorError
from turgor.geometry.geometry import Geometry, check_volume
from turgor.geometry.rules import SMALLEST_LENGTH, as_length, check_count, check_length, in_mm
from turgor.geometry.solids import (
    Range,
    box,
    cut,
    face_names,
    glue,
    name_plane,
    name_rest,
    region_names,
    union,
    volume,
)
from turgor.units import m, mm

MOST_CHAMBERS = 100


@dataclass(frozen=True, slots=True, kw_only=True)
class FastPneuNet:
    """Fast PneuNet of Mosadegh et al. 2014: chambers in a row, apart from each other above a common floor.

    Pressure bulges the thin walls that face each other across the gaps; they push each other apart and the
    actuator bends towards its base, which a strain-limiting layer keeps from stretching.

    Published are, from memory of Mosadegh et al. 2014 and not checked against its drawing ([MEM]): 11 chambers,
    about 110 x 20 x 15 mm, ``wall`` 1 mm, ``gap`` 1 mm, outer walls of about 2 to 3 mm. Chosen here within that
    range: ``side_wall``, ``top_wall`` and ``end_wall`` 2 mm. Chosen here without a published number: ``floor`` and
    ``base`` 1.5 mm each, channel 3 x 2 mm with a wall of 1 mm.

    Axes: x from the fixed end to the tip, z up, y across; the base lies at z = 0, the mirror plane at y = 0. The air
    inlet is left out: the cavity is closed.

    Parameters
    ----------
    chambers : int
        Number of chambers, 1 to 100.
    length, width, height : float [m]
        Outer dimensions, base and floor included; 1 mm to 2 m each.
    wall : float [m]
        Thickness of the walls that face each other across a gap.
    gap : float [m]
        Distance between neighboring chamber blocks.
    side_wall, top_wall, end_wall : float [m]
        Thickness of the outer walls: along the sides, on top, at the two ends.
    floor : float [m]
        Thickness of the silicone between cavity and strain-limiting layer.
    base : float [m]
        Thickness of the silicone below the strain-limiting layer.
    channel_width, channel_height : float [m]
        Air channel that joins the chambers, on the floor in the middle.
    channel_wall : float [m]
        Thickness of the bridge around the channel in each gap, at its sides and above it.
    symmetric : bool
        Whether to model only the half with y >= 0, cut at the face ``symmetry_y``.

    Raises
    ------
    TurgorError
        If a dimension cannot be: the field, its value in mm and what is allowed.

    Examples
    --------
    >>> finger = FastPneuNet()
    >>> round(finger.chamber_length * 1e3, 4)  # mm
    9.0909
    >>> FastPneuNet(gap=-1e-3)
    Traceback (most recent call last):
    turgor.errors.TurgorError: gap is -1 mm; allowed is 0.01 mm to 10.967 mm, so that 11 chambers fit in 110 mm.
    """

    chambers: int = 11
    length: float = 110 * mm
    width: float = 20 * mm
    height: float = 15 * mm
    wall: float = 1 * mm
    gap: float = 1 * mm
    side_wall: float = 2 * mm
    top_wall: float = 2 * mm
    end_wall: float = 2 * mm
    floor: float = 1.5 * mm
    base: float = 1.5 * mm
    channel_width: float = 3 * mm
    channel_height: float = 2 * mm
    channel_wall: float = 1 * mm
    symmetric: bool = True

    def __post_init__(self) -> None:
        check_count("chambers", self.chambers, low=1, high=MOST_CHAMBERS)
        if not isinstance(self.symmetric, bool):
            raise TurgorError(f"symmetric is {self.symmetric!r}; allowed is True or False.")
        for field in fields(self):
            if field.type is float:
                as_length(field.name, getattr(self, field.name))
        for name in ("length", "width", "height"):
            check_length(name, getattr(self, name), low=1 * mm, high=2 * m)
        self._check_along()
        self._check_across()
        self._check_up()
        if self.chambers == 1:
            for name in ("wall", "gap", "channel_width", "channel_height", "channel_wall"):
                check_length(name, getattr(self, name), high=2 * m)

    def _check_along(self) -> None:
        least = SMALLEST_LENGTH
        if self.chambers > 1:
            high = (self.length - 3 * least * self.chambers) / (self.chambers - 1)
            check_length(
                "gap", self.gap, high=high, why=f"so that {self.chambers} chambers fit in {in_mm(self.length)}"
            )
        block = self.chamber_length
        why = f"so that a cavity remains in a chamber {block / mm:.4g} mm long"
        if self.chambers == 1:
            check_length("end_wall", self.end_wall, high=(block - least) / 2, why=why)
        else:
            check_length("wall", self.wall, high=(block - least) / 2, why=why)
            check_length("end_wall", self.end_wall, high=block - self.wall - least, why=why)

    def _check_across(self) -> None:
        least = SMALLEST_LENGTH
        why = f"less than half the width of {in_mm(self.width)}"
        check_length("side_wall", self.side_wall, high=(self.width - least) / 2, why=why)
        if self.chambers > 1:
            inside = self.width - 2 * self.side_wall
            why = f"less than the cavity, which is {in_mm(inside)} wide"
            check_length("channel_width", self.channel_width, high=inside - least, why=why)
            why = f"so that the channel with its walls is narrower than {in_mm(self.width)}"
            check_length("channel_wall", self.channel_wall, high=(self.width - self.channel_width - least) / 2, why=why)

    def _check_up(self) -> None:
        least, why = SMALLEST_LENGTH, f"so that a cavity remains within the height of {in_mm(self.height)}"
        check_length("base", self.base, high=self.height - 3 * least, why=why)
        check_length("floor", self.floor, high=self.height - self.base - 2 * least, why=why)
        check_length("top_wall", self.top_wall, high=self.height - self.floor_top - least, why=why)
        if self.chambers > 1:
            inside = self.height - self.floor_top - self.top_wall
            why = f"less than the cavity, which is {in_mm(inside)} high"
            check_length("channel_height", self.channel_height, high=inside - least, why=why)
            high = self.height - self.floor_top - self.channel_height - least
            check_length("channel_wall", self.channel_wall, high=high, why="so that it stays below the chamber tops")

    @property
    def chamber_length(self) -> float:
        """Length of one chamber block, walls included [m]: (length − (chambers − 1) gap) / chambers."""
        return (self.length - (self.chambers - 1) * self.gap) / self.chambers

    @property
    def pitch(self) -> float:
        """Distance from one chamber to the next [m]."""
        return self.chamber_length + self.gap

    @property
    def floor_top(self) -> float:
        """Height of the cavity's lower face above the bottom [m]."""
        return self.base + self.floor

    @property
    def smallest_wall(self) -> float:
        """Thickness of the thinnest wall [m]."""
        outer = (self.side_wall, self.top_wall, self.end_wall, self.floor, self.base)
        return min(outer) if self.chambers == 1 else min(*outer, self.wall, self.channel_wall)

    @property
    def cavity_volume(self) -> float:
        """Volume of the cavity of the modeled part [m³], from the dimensions."""
        joints = self.chambers - 1
        inside = self.chambers * self.chamber_length - 2 * self.end_wall - 2 * joints * self.wall
        chambers = inside * (self.width - 2 * self.side_wall) * (self.height - self.floor_top - self.top_wall)
        channel = joints * (2 * self.wall + self.gap) * self.channel_width * self.channel_height
        return (chambers + channel) / self._copies

    @property
    def solid_volume(self) -> float:
        """Volume of the silicone of the modeled part [m³], from the dimensions."""
        joints = self.chambers - 1
        slab = self.length * self.width * self.floor_top
        blocks = self.chambers * self.chamber_length * self.width * (self.height - self.floor_top)
        section = (self.channel_width + 2 * self.channel_wall) * (self.channel_height + self.channel_wall)
        return (slab + blocks + joints * self.gap * section) / self._copies - self.cavity_volume

    def build(self) -> Geometry:
        """Build the solids and name them.

        Returns
        -------
        Geometry
            Regions ``body`` and ``base``; faces ``cavity``, ``fixed`` (the plane x = 0), ``tip`` (x = length),
            ``strain_limiting_layer`` (between body and base), ``outside`` (the rest) and, for a half,
            ``symmetry_y``.

        Raises
        ------
        TurgorError
            If the CAD volumes are not those of the dimensions.
        """
        cavity = self._cavity()
        cavity.faces.name = "cavity"
        check_volume("cavity", volume(cavity), self.cavity_volume)
        above = box((0, self.length), self._across(self.width), (self.base, self.height))
        body = cut(above, [*self._gaps(), cavity])
        shape = glue({"body": body, "base": box((0, self.length), self._across(self.width), (0, self.base))})
        check_volume("solid", volume(shape), self.solid_volume)
        name_plane(shape, 0, 0.0, "fixed")
        name_plane(shape, 0, self.length, "tip")
        name_plane(shape, 2, self.base, "strain_limiting_layer")
        if self.symmetric:
            name_plane(shape, 1, 0.0, "symmetry_y")
        name_rest(shape, "outside")
        return Geometry(
            name=f"fast PneuNet, {self.chambers} chambers{', half' if self.symmetric else ''}",
            smallest_wall=self.smallest_wall,
            cavity_volume=self.cavity_volume,
            solid_volume=self.solid_volume,
            regions=region_names(shape),
            faces=face_names(shape),
            _shape=shape,
        )

    @property
    def _copies(self) -> int:
        return 2 if self.symmetric else 1

    def _across(self, width: float) -> Range:
        return (0.0 if self.symmetric else -width / 2, width / 2)

    def _gap_starts(self) -> list[float]:
        return [i * self.pitch + self.chamber_length for i in range(self.chambers - 1)]

    def _gaps(self) -> list[Any]:
        """The air between the chambers, around the bridges."""
        bridge_width = self.channel_width + 2 * self.channel_wall
        bridge_top = self.floor_top + self.channel_height + self.channel_wall
        gaps = []
        for start in self._gap_starts():
            along = (start, start + self.gap)
            air = box(along, self._across(self.width), (self.floor_top, self.height))
            gaps.append(air - box(along, self._across(bridge_width), (self.floor_top, bridge_top)))
        return gaps

    def _cavity(self) -> Any:
        """The chambers' insides and the channels between them, in one piece."""
        across, up = self._across(self.width - 2 * self.side_wall), (self.floor_top, self.height - self.top_wall)
        insides = []
        for i in range(self.chambers):
            start = i * self.pitch + (self.end_wall if i == 0 else self.wall)
            end = i * self.pitch + self.chamber_length - (self.end_wall if i == self.chambers - 1 else self.wall)
            insides.append(box((start, end), across, up))
        across, up = self._across(self.channel_width), (self.floor_top, self.floor_top + self.channel_height)
        for start in self._gap_starts():
            insides.append(box((start - self.wall, start + self.gap + self.wall), across, up))
        return union(insides)
