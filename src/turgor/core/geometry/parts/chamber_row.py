"""Row of chambers with gaps between them, above a common floor: part of the fast PneuNet and similar families."""

from dataclasses import dataclass, field, fields
from math import cos, tan
from typing import Any

from turgor.core.geometry.parts.plates import plan
from turgor.core.geometry.parts.pneunet import across, check_base, check_floor, check_inlet, copies, inlet, inlet_volume
from turgor.core.geometry.rules import SMALLEST_LENGTH, check_length, in_mm
from turgor.core.geometry.shapes.solids import Range, box, union
from turgor.units import m, mm


@dataclass(frozen=True, slots=True, kw_only=True)
class ChamberRow:
    """Chambers in a row, apart from each other and joined by an air channel; x counts from the plane x = 0.

    The fields are those of `turgor.FastPneuNet`, and these:

    Parameters
    ----------
    chambers, length, width, height, wall, gap, side_wall, top_wall, end_wall, base, floor
        As in the fast PneuNet; ``base`` is None where another bender takes its place.
    channel_width, channel_height, channel_wall, clamp_length, inlet_diameter, symmetric
        As in the fast PneuNet.
    slant : float [rad]
        Angle of the inner walls against the y-z plane.
    channel_rise : float [m]
        Height of the channel above the floor of the chambers.
    end_extension : float [m]
        Length by which the first and the last chamber are longer than the others.

    Examples
    --------
    >>> from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
    >>> row = row_of(FastPneuNet(chambers=2, length=19e-3))
    >>> round(row.block * 1e3, 9), [round(x * 1e3, 9) for x in row.gap_ranges()[0]]  # mm
    (9.0, [9.0, 10.0])
    """

    chambers: int
    length: float
    width: float
    height: float
    wall: float
    gap: float
    side_wall: float
    top_wall: float
    end_wall: float
    base: float | None
    floor: float
    channel_width: float
    channel_height: float
    channel_wall: float
    clamp_length: float
    inlet_diameter: float
    symmetric: bool
    slant: float = field(default=0.0, metadata={"dimension": "angle"})
    channel_rise: float = 0.0
    end_extension: float = 0.0

    @property
    def joints(self) -> int:
        """Number of gaps."""
        return self.chambers - 1

    @property
    def wall_along(self) -> float:
        """Thickness of an inner wall along x [m]."""
        return self.wall / cos(self.slant)

    @property
    def gap_along(self) -> float:
        """Width of a gap along x [m]."""
        return self.gap / cos(self.slant)

    @property
    def block(self) -> float:
        """Length of one chamber with its walls along the middle [m]; the first and the last may be longer."""
        return (self.length - 2 * self.end_extension - self.joints * self.gap_along) / self.chambers

    @property
    def pitch(self) -> float:
        """Distance from one chamber to the next [m]."""
        return self.block + self.gap_along

    @property
    def floor_top(self) -> float:
        """Height of the floor of the chambers [m]."""
        return (self.base or 0.0) + self.floor

    @property
    def channel_bottom(self) -> float:
        """Height of the bottom of the channel [m]."""
        return self.floor_top + self.channel_rise

    @property
    def channel_top(self) -> float:
        """Height of the ceiling of the channel [m]."""
        return self.channel_bottom + self.channel_height

    @property
    def inner_width(self) -> float:
        """Width of the chambers inside [m]."""
        return self.width - 2 * self.side_wall

    @property
    def inner_height(self) -> float:
        """Height of the chambers inside [m]."""
        return self.height - self.floor_top - self.top_wall

    @property
    def thinnest(self) -> float:
        """Thickness of the thinnest wall [m]."""
        outer = [self.side_wall, self.top_wall, self.end_wall]
        outer += [thickness for thickness in (self.floor, self.base) if thickness]
        return min(outer) if self.chambers == 1 else min(*outer, self.wall, self.channel_wall)

    @property
    def cavity_volume(self) -> float:
        """Volume of the cavity with its inlet, of the modeled part [m³]."""
        along = self.chambers * self.block + 2 * self.end_extension
        inside = along - 2 * self.end_wall - 2 * self.joints * self.wall_along
        channel = self.joints * (2 * self.wall_along + self.gap_along) * self.channel_width * self.channel_height
        duct = inlet_volume(self, self.clamp_length + self.end_wall)
        return (inside * self.inner_width * self.inner_height + channel) / copies(self) + duct

    @property
    def bridge_volume(self) -> float:
        """Volume of the bridges through the gaps with their channels, of the modeled part [m³], down to the floor."""
        section = (self.channel_width + 2 * self.channel_wall) * (self.channel_top + self.channel_wall - self.floor_top)
        return self.joints * self.gap_along * section / copies(self)

    @property
    def block_volume(self) -> float:
        """Volume of the clamped block and of the chambers above their floor, still filled, of the modeled part [m³]."""
        along = self.clamp_length + self.chambers * self.block + 2 * self.end_extension
        return along * (self.height - self.floor_top) * self.width / copies(self)

    def cavity(self) -> Any:
        """The insides of the chambers, the channels between them and the inlet, in one piece."""
        up = (self.floor_top, self.height - self.top_wall)
        insides = []
        for i, (start, end) in enumerate(self.chamber_ranges()):
            first, last = i == 0, i == self.joints
            low = start + (self.end_wall if first else self.wall_along)
            high = end - (self.end_wall if last else self.wall_along)
            insides.append(self._piece((low, high), self.inner_width, up, straight=(first, last)))
        for start, end in self.gap_ranges():
            along = (start - self.wall_along, end + self.wall_along)
            insides.append(self._piece(along, self.channel_width, (self.channel_bottom, self.channel_top)))
        if self.inlet_diameter:
            end, middle = self.clamp_length + self.end_wall, (up[0] + up[1]) / 2
            insides.append(inlet(self.inlet_diameter, end, middle, self.symmetric))
        return union(insides)

    def gaps(self) -> list[Any]:
        """The air between the chambers above their floor, around the bridges."""
        width, top = self.channel_width + 2 * self.channel_wall, self.channel_top + self.channel_wall
        air = []
        for along in self.gap_ranges():
            whole = self._piece(along, self.width, (self.floor_top, self.height))
            air.append(whole - self._piece(along, width, (self.floor_top, top)))
        return air

    def chamber_ranges(self) -> list[Range]:
        """Range of each chamber with its walls along x, in the middle [m]."""
        begin = self.clamp_length + self.end_extension
        ends = [(begin + i * self.pitch, begin + i * self.pitch + self.block) for i in range(self.chambers)]
        ends[0] = (self.clamp_length, ends[0][1])
        ends[-1] = (ends[-1][0], ends[-1][1] + self.end_extension)
        return ends

    def gap_ranges(self) -> list[Range]:
        """Range of each gap along x, in the middle [m]."""
        starts = [end for _, end in self.chamber_ranges()[:-1]]
        return [(start, start + self.gap_along) for start in starts]

    def slab(self, up: Range) -> Any:
        """A block as long and wide as everything, clamped block included."""
        return box((0, self.clamp_length + self.length), across(self, self.width), up)

    def _piece(self, along: Range, width: float, up: Range, straight: tuple[bool, bool] = (False, False)) -> Any:
        """A block whose two ends are slanted, each unless it is ``straight``; ``along`` x in the middle."""
        y = across(self, width)
        if not self.slant:
            return box(along, y, up)
        low, high = (0.0 if is_straight else tan(self.slant) for is_straight in straight)
        (a, b), (right, left) = along, y
        return plan(
            [(a + low * right, right), (b + high * right, right), (b + high * left, left), (a + low * left, left)], up
        )


def row_of(actuator: Any, *, slant: float = 0.0, channel_rise: float = 0.0) -> ChamberRow:
    """Return the row of chambers of a family that has its dimensions as fields; the base may be missing."""
    own: dict[str, Any] = {"slant": slant, "channel_rise": channel_rise}
    own["end_extension"] = getattr(actuator, "end_extension", 0.0)
    given: dict[str, Any] = {item.name: getattr(actuator, item.name, None) for item in fields(ChamberRow)}
    return ChamberRow(**(given | own))


def check_row(row: ChamberRow) -> None:
    """Raise an error for dimensions without room for walls, cavity or channel."""
    _check_along(row)
    _check_across(row)
    _check_up(row)
    check_inlet(row, row.inner_width, row.inner_height)
    if row.chambers == 1:
        for name in ("wall", "gap", "channel_width", "channel_height", "channel_wall"):
            check_length(name, getattr(row, name), high=2 * m)


def _check_along(row: ChamberRow) -> None:
    least, share = SMALLEST_LENGTH, cos(row.slant)
    if row.chambers > 1:
        high = (row.length - 3 * least * row.chambers) / row.joints * share
        check_length("gap", row.gap, high=high, why=f"so that {row.chambers} chambers fit in {in_mm(row.length)}")
    why = f"so that a cavity remains in a chamber {row.block / mm:.4g} mm long"
    if row.chambers == 1:
        check_length("end_wall", row.end_wall, high=(row.block - least) / 2, why=why)
    else:
        check_length("wall", row.wall, high=(row.block - least) / 2 * share, why=why)
        check_length("end_wall", row.end_wall, high=row.block - row.wall_along - least, why=why)


def _check_across(row: ChamberRow) -> None:
    least = SMALLEST_LENGTH
    why = f"less than half the width of {in_mm(row.width)}"
    check_length("side_wall", row.side_wall, high=(row.width - least) / 2, why=why)
    if row.chambers > 1:
        why = f"less than the cavity, which is {in_mm(row.inner_width)} wide"
        check_length("channel_width", row.channel_width, high=row.inner_width - least, why=why)
        why = f"so that the channel with its walls is narrower than {in_mm(row.width)}"
        check_length("channel_wall", row.channel_wall, high=(row.width - row.channel_width - least) / 2, why=why)


def _check_up(row: ChamberRow) -> None:
    least, why = SMALLEST_LENGTH, f"so that a cavity remains within the height of {in_mm(row.height)}"
    if row.base is not None:
        check_base(row.base, high=row.height - 3 * least, why=why)
    check_floor(row.floor, row.base, high=row.height - (row.base or 0.0) - 2 * least, why=why)
    check_length("top_wall", row.top_wall, high=row.height - row.floor_top - least, why=why)
    if row.chambers > 1:
        why = f"less than the cavity, which is {in_mm(row.inner_height)} high"
        check_length("channel_height", row.channel_height, high=row.inner_height - row.channel_rise - least, why=why)
        high = row.height - row.channel_top - least
        check_length("channel_wall", row.channel_wall, high=high, why="so that it stays below the chamber tops")
