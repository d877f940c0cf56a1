"""Block with embedded chambers in a row, without gaps: part of the slow PneuNet and the manta fin."""

from dataclasses import dataclass, fields
from math import hypot, inf
from typing import Any

from turgor.core.geometry.parts.plates import Point, area, plan
from turgor.core.geometry.parts.pneunet import check_base, check_floor, check_inlet, copies, inlet, inlet_volume
from turgor.core.geometry.rules import SMALLEST_LENGTH, check_length, in_mm
from turgor.core.geometry.shapes.solids import Range, union
from turgor.units import m, mm


@dataclass(frozen=True, slots=True, kw_only=True)
class ChamberBlock:
    """A block whose width may change from one end to the other, with chambers in it that follow its outline.

    Parameters
    ----------
    chambers, length, height, wall, side_wall, top_wall, end_wall, base, floor, channel_width, channel_height
        As in the slow PneuNet.
    clamp_length, inlet_diameter, symmetric
        As in the slow PneuNet.
    root_width, tip_width : float [m]
        Width at the first and at the other end of the chambers' part.
    sweep : float [m]
        Offset of the center line along y between the two ends.

    Examples
    --------
    >>> from turgor.core.geometry.actuators.slow_pneunet import SlowPneuNet
    >>> block = block_of(SlowPneuNet(chambers=2, length=27e-3), root_width=20e-3, tip_width=10e-3)
    >>> round(block.inside * 1e3, 9), round(block.inner_width(13.5e-3) * 1e3, 9)  # mm
    (10.0, 11.0)
    """

    chambers: int
    length: float
    height: float
    wall: float
    side_wall: float
    top_wall: float
    end_wall: float
    base: float
    floor: float
    channel_width: float
    channel_height: float
    clamp_length: float
    inlet_diameter: float
    symmetric: bool
    root_width: float
    tip_width: float
    sweep: float

    @property
    def joints(self) -> int:
        """Number of walls between chambers."""
        return self.chambers - 1

    @property
    def inside(self) -> float:
        """Length of one chamber inside [m]."""
        return (self.length - 2 * self.end_wall - self.joints * self.wall) / self.chambers

    @property
    def floor_top(self) -> float:
        """Height of the floor of the chambers [m]."""
        return self.base + self.floor

    @property
    def inner_height(self) -> float:
        """Height of the chambers inside [m]."""
        return self.height - self.floor_top - self.top_wall

    @property
    def thinnest(self) -> float:
        """Thickness of the thinnest wall [m]."""
        slopes = [(self.tip_width - self.root_width) / 2 + sign * self.sweep for sign in (1, -1)]
        side = self.side_wall * min(self.length / hypot(self.length, slope) for slope in slopes)
        outer = (side, self.top_wall, self.end_wall, self.floor or inf, self.base or inf)
        return min(outer) if self.chambers == 1 else min(*outer, self.wall)

    @property
    def cavity_volume(self) -> float:
        """Volume of the cavity with its inlet, of the modeled part [m³]."""
        chambers = sum(area(self._chamber(i)) for i in range(self.chambers)) * self.inner_height
        channel = self.joints * self.wall * self.channel_width * self.channel_height / copies(self)
        return chambers + channel + inlet_volume(self, self.clamp_length + self.end_wall)

    @property
    def whole_volume(self) -> float:
        """Volume of the block, chambers filled, of the modeled part [m³]."""
        footprint = self.clamp_length * self.root_width + self.length * (self.root_width + self.tip_width) / 2
        return footprint * self.height / copies(self)

    def cavity(self) -> Any:
        """The insides of the chambers, the channels between them and the inlet, in one piece."""
        up = (self.floor_top, self.height - self.top_wall)
        insides = [plan(corners, up) for corners in self.chamber_plans()]
        for corners in self.channel_plans():
            insides.append(plan(corners, (self.floor_top, self.floor_top + self.channel_height)))
        if self.inlet_diameter:
            end, middle = self.clamp_length + self.end_wall, (up[0] + up[1]) / 2
            insides.append(inlet(self.inlet_diameter, end, middle, self.symmetric))
        return union(insides)

    def chamber_plans(self) -> list[list[Point]]:
        """Corners of the inside of each chamber."""
        return [self._chamber(i) for i in range(self.chambers)]

    def channel_plans(self) -> list[list[Point]]:
        """Corners of the channel through each wall."""
        starts = [self.end_wall + (i + 1) * self.inside + i * self.wall for i in range(self.joints)]
        width = self.channel_width
        return [self.outline((start, start + self.wall), width, width) for start in starts]

    def filled(self, up: Range) -> Any:
        """The block without its cavity, in a range of heights."""
        fin = plan(self.outline((0.0, self.length), self.root_width, self.tip_width), up)
        if not self.clamp_length:
            return fin
        low = 0.0 if self.symmetric else -self.root_width / 2
        high, end = self.root_width / 2, self.clamp_length
        return fin + plan([(0.0, low), (end, low), (end, high), (0.0, high)], up)

    def outline(self, along: Range, first: float, last: float) -> list[Point]:
        """Corners of a part that is ``first`` and ``last`` wide at its ends; ``along`` counts from the block's end."""
        (a, b), shift = along, self.sweep / self.length
        low = (0.0, 0.0) if self.symmetric else (shift * a - first / 2, shift * b - last / 2)
        high = (shift * a + first / 2, shift * b + last / 2)
        a, b = a + self.clamp_length, b + self.clamp_length
        return [(a, low[0]), (b, low[1]), (b, high[1]), (a, high[0])]

    def inner_width(self, x: float) -> float:
        """Width of the chambers inside at a distance from the block's end [m]."""
        return self.root_width + (self.tip_width - self.root_width) * x / self.length - 2 * self.side_wall

    def _chamber(self, i: int) -> list[Point]:
        start = self.end_wall + i * (self.inside + self.wall)
        end = start + self.inside
        return self.outline((start, end), self.inner_width(start), self.inner_width(end))


def block_of(actuator: Any, *, root_width: float, tip_width: float, sweep: float = 0.0) -> ChamberBlock:
    """Return the block of a family that has its dimensions as fields."""
    own: dict[str, Any] = {"root_width": root_width, "tip_width": tip_width, "sweep": sweep}
    given = {item.name: getattr(actuator, item.name) for item in fields(ChamberBlock) if item.name not in own}
    return ChamberBlock(**given, **own)


def check_block(block: ChamberBlock) -> None:
    """Raise an error for dimensions without room for walls, cavity or channel."""
    _check_along(block)
    _check_across(block)
    _check_up(block)
    check_inlet(block, block.inner_width(block.end_wall), block.inner_height)
    if block.chambers == 1:
        for name in ("wall", "channel_width", "channel_height"):
            check_length(name, getattr(block, name), high=2 * m)


def _check_along(block: ChamberBlock) -> None:
    least, joints = SMALLEST_LENGTH, block.joints
    why = f"so that {block.chambers} chambers fit in {in_mm(block.length)}"
    if joints:
        high = (block.length - (block.chambers + 2) * least) / joints
        check_length("wall", block.wall, high=high, why=why)
    walls = joints * block.wall
    check_length("end_wall", block.end_wall, high=(block.length - walls - block.chambers * least) / 2, why=why)


def _check_across(block: ChamberBlock) -> None:
    least, narrowest = SMALLEST_LENGTH, min(block.root_width, block.tip_width)
    why = f"less than half the width of {in_mm(narrowest)}"
    check_length("side_wall", block.side_wall, high=(narrowest - least) / 2, why=why)
    if block.joints:
        inside = min(block.inner_width(x) for x in (block.end_wall, block.length - block.end_wall))
        why = f"less than the cavity, which is {inside / mm:.5g} mm wide"
        check_length("channel_width", block.channel_width, high=inside - least, why=why)


def _check_up(block: ChamberBlock) -> None:
    least, why = SMALLEST_LENGTH, f"so that a cavity remains within the height of {in_mm(block.height)}"
    check_base(block.base, high=block.height - 3 * least, why=why)
    check_floor(block.floor, block.base, high=block.height - block.base - 2 * least, why=why)
    check_length("top_wall", block.top_wall, high=block.height - block.floor_top - least, why=why)
    if block.joints:
        why = f"less than the cavity, which is {in_mm(block.inner_height)} high"
        check_length("channel_height", block.channel_height, high=block.inner_height - least, why=why)
