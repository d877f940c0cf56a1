"""Row of straight bellows: a folded roof of constant thickness over an air space, constant across the width."""

from dataclasses import dataclass, fields
from math import cos, inf, sin, tan
from typing import Any

from turgor.core.geometry.parts.plates import Point, profile
from turgor.core.geometry.parts.pneunet import across, check_inlet, copies, inlet, inlet_volume
from turgor.core.geometry.rules import SMALLEST_LENGTH, check_length, in_mm
from turgor.core.geometry.shapes.solids import Range, box, union
from turgor.units import mm


@dataclass(frozen=True, slots=True, kw_only=True)
class BellowsRow:
    """Bellows in a row on a base; between them and at the ends the roof is lower and leaves an air passage.

    Parameters
    ----------
    chambers, length, width, height, wall, gap, side_wall, end_wall, base, floor, channel_height
        As in the trapezoidal PneuNet.
    clamp_length, inlet_diameter, symmetric
        As in the trapezoidal PneuNet.
    flank_angle : float [rad]
        Angle of the flanks against the vertical.
    top_wall : float [m]
        Thickness of the tops; 0 where the flanks meet in a point.

    Examples
    --------
    >>> from turgor.core.geometry.actuators.trapezoidal_pneunet import TrapezoidalPneuNet
    >>> row = bellows_of(TrapezoidalPneuNet(chambers=2, length=25e-3), flank_angle=0.0, top_wall=1e-3)
    >>> [round(length * 1e3, 9) for length in (row.base_length, row.top_length, row.inner_top_length)]  # mm
    [10.0, 10.0, 7.0]
    """

    chambers: int
    length: float
    width: float
    height: float
    wall: float
    gap: float
    side_wall: float
    end_wall: float
    base: float
    floor: float
    channel_height: float
    clamp_length: float
    inlet_diameter: float
    symmetric: bool
    flank_angle: float
    top_wall: float

    @property
    def floor_top(self) -> float:
        """Height of the floor of the air space [m]."""
        return self.base + self.floor

    @property
    def channel_top(self) -> float:
        """Height of the ceiling between the bellows [m]."""
        return self.floor_top + self.channel_height

    @property
    def valley(self) -> float:
        """Height of the roof between the bellows [m]."""
        return self.channel_top + self.wall

    @property
    def inner_width(self) -> float:
        """Width of the air space [m]."""
        return self.width - 2 * self.side_wall

    @property
    def base_length(self) -> float:
        """Length of one of the bellows at its foot [m]."""
        return foot(self)

    @property
    def top_length(self) -> float:
        """Length of one of the bellows at its top [m]."""
        return self.base_length - 2 * (self.height - self.valley) * tan(self.flank_angle)

    @property
    def inner_base(self) -> float:
        """Length of the air space of one of the bellows at the ceiling between them [m]."""
        return self.base_length - 2 * self.wall * (1 - sin(self.flank_angle)) / cos(self.flank_angle)

    @property
    def inner_top(self) -> float:
        """Height of the air space's top [m]."""
        if self.top_wall:
            return self.height - self.top_wall
        return self.height - self.wall / sin(self.flank_angle)

    @property
    def inner_top_length(self) -> float:
        """Length of the air space at its top [m]."""
        if not self.top_wall:
            return 0.0
        return self.inner_base - 2 * (self.inner_top - self.channel_top) * tan(self.flank_angle)

    @property
    def thinnest(self) -> float:
        """Thickness of the thinnest wall [m]."""
        return min(self.wall, self.side_wall, self.end_wall, self.base or inf, self.floor, self.top_wall or inf)

    @property
    def cavity_volume(self) -> float:
        """Volume of the cavity with its inlet, of the modeled part [m³]."""
        passage = (self.length - 2 * self.end_wall) * self.channel_height
        one = (self.inner_base + self.inner_top_length) / 2 * (self.inner_top - self.channel_top)
        duct = inlet_volume(self, self.clamp_length + self.end_wall)
        return (passage + self.chambers * one) * self.inner_width / copies(self) + duct

    @property
    def whole_volume(self) -> float:
        """Volume of all solids with a filled air space, of the modeled part [m³]."""
        slab = (self.clamp_length + self.length) * self.valley
        one = (self.base_length + self.top_length) / 2 * (self.height - self.valley)
        return (slab + self.chambers * one) * self.width / copies(self)

    def starts(self) -> list[float]:
        """Start of the foot of each of the bellows along x [m]."""
        first = self.clamp_length + self.end_wall
        return [first + i * (self.base_length + self.gap) for i in range(self.chambers)]

    def filled(self) -> Any:
        """Everything above the base, without the air space."""
        return profile(self.roof(), across(self, self.width))

    def roof(self) -> list[Point]:
        """Corners of everything above the base, the air space filled."""
        end = self.clamp_length + self.length
        corners: list[Point] = [(0.0, self.base), (end, self.base), (end, self.valley)]
        inset = (self.base_length - self.top_length) / 2
        for start in reversed(self.starts()):
            low, high = start, start + self.base_length
            top = [(high - inset, self.height), (low + inset, self.height)]
            corners += [(high, self.valley), *(top if self.top_wall else top[:1]), (low, self.valley)]
        return [*corners, (0.0, self.valley)]

    def slab(self, up: Range) -> Any:
        """A block as long and wide as everything, clamped block included."""
        return box((0.0, self.clamp_length + self.length), across(self, self.width), up)

    def cavity(self) -> Any:
        """The air space and the inlet, in one piece."""
        space = profile(self.air_space(), across(self, self.inner_width))
        if not self.inlet_diameter:
            return space
        middle = self.floor_top + self.channel_height / 2
        return union([space, inlet(self.inlet_diameter, self.clamp_length + self.end_wall, middle, self.symmetric)])

    def air_space(self) -> list[Point]:
        """Corners of the air space."""
        first, last = self.clamp_length + self.end_wall, self.clamp_length + self.length - self.end_wall
        corners: list[Point] = [(first, self.floor_top), (last, self.floor_top), (last, self.channel_top)]
        for start in reversed(self.starts()):
            middle = start + self.base_length / 2
            top = [(middle + side * self.inner_top_length / 2, self.inner_top) for side in (1, -1)]
            foot = [(middle + side * self.inner_base / 2, self.channel_top) for side in (1, -1)]
            corners += [foot[0], *(top if self.top_wall else top[:1]), foot[1]]
        return [*corners, (first, self.channel_top)]


def foot(actuator: Any) -> float:
    """Length of one of the bellows at its foot [m]: what the end walls and gaps leave, shared by all."""
    taken = 2 * actuator.end_wall + (actuator.chambers - 1) * actuator.gap
    return float(actuator.length - taken) / int(actuator.chambers)


def bellows_of(actuator: Any, *, flank_angle: float, top_wall: float) -> BellowsRow:
    """Return the row of bellows of a family that has its dimensions as fields."""
    own: dict[str, Any] = {"flank_angle": flank_angle, "top_wall": top_wall}
    given = {item.name: getattr(actuator, item.name) for item in fields(BellowsRow) if item.name not in own}
    return BellowsRow(**given, **own)


def check_bellows(actuator: Any) -> None:
    """Raise an error for dimensions without room for bellows, at any flank angle."""
    least, chambers = SMALLEST_LENGTH, actuator.chambers
    why = f"so that {chambers} chambers fit in {in_mm(actuator.length)}"
    if chambers > 1:
        high = (actuator.length - (12 * chambers + 2) * least) / (chambers - 1)
        check_length("gap", actuator.gap, high=high, why=why)
    room = actuator.length - (chambers - 1) * actuator.gap - 12 * chambers * least
    check_length("end_wall", actuator.end_wall, high=room / 2, why=why)
    check_length(
        "side_wall", actuator.side_wall, high=(actuator.width - least) / 2,
        why=f"less than half the width of {in_mm(actuator.width)}",
    )  # fmt: skip
    height, why = actuator.height, f"so that bellows remain within the height of {in_mm(actuator.height)}"
    for count, name in enumerate(("base", "floor", "channel_height")):
        if name != "base" or actuator.base:
            check_length(name, getattr(actuator, name), high=height - (6 - count) * least, why=why)
        height -= getattr(actuator, name)
    check_length("wall", actuator.wall, high=height - 3 * least, why=why)


def check_inside(row: BellowsRow) -> None:
    """Raise an error for bellows without air inside, or an inlet that does not fit."""
    least = 10 * SMALLEST_LENGTH  # and so a top a little above the ceiling
    share = (1 - sin(row.flank_angle)) / cos(row.flank_angle)
    why = f"so that air remains in bellows {row.base_length / mm:.4g} mm long"
    check_length("wall", row.wall, high=(row.base_length - least) / 2 / share, why=why)
    check_inlet(row, row.inner_width, row.channel_height)
