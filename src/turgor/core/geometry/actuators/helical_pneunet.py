"""Helical PneuNet: a fast PneuNet with slanted chambers, which twists as it bends."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from math import tan

from turgor.core.geometry.geometry import Geometry
from turgor.core.geometry.parts.chamber_row import ChamberRow, check_row, row_of
from turgor.core.geometry.parts.pneunet import check_envelope, finished, with_base
from turgor.core.geometry.rules import SMALLEST_LENGTH, check_angle, check_length, in_mm
from turgor.core.geometry.shapes.solids import cut
from turgor.core.geometry.sweeps.rows import row_blocks, row_sweep
from turgor.foundation.errors import TurgorError
from turgor.units import deg, mm

#: Walls that lean more than this against the y-z plane have edges too sharp to mesh.
MOST_ANGLE = 75 * deg


@dataclass(frozen=True, slots=True, kw_only=True)
class HelicalPneuNet:
    """Fast PneuNet whose chambers are turned by an angle about z: it winds into a helix instead of a circle.

    A larger chamber angle gives less bending and more twist (Xavier, Fleming and Yong 2021, section 7.4 item 9).

    The dimensions were chosen here, without published numbers: the default `FastPneuNet` with chambers turned by 30
    degrees. The two ends stay square, so that the first and the last chamber are longer on one side than on the other.

    Axes: x from the fixed end to the tip, z up, y across; the base lies at z = 0. There is no mirror plane.

    Parameters
    ----------
    chambers : int
        Number of chambers, 1 to 100.
    length, width, height : float [m]
        Outer dimensions, base and floor included, the clamped block not; 1 mm to 2 m each.
    chamber_angle : float [rad]
        Angle by which the inner walls and gaps are turned from the y-z plane about z; positive where they reach
        further towards the tip at larger y. Small enough that the first and last chamber keep an inside: at
        the default length, 45 degrees take 8 chambers at most, 60 degrees 5, and more with ``end_extension``.
    wall : float [m]
        Thickness of the walls that face each other across a gap.
    gap : float [m]
        Distance between neighboring chamber blocks, normal to their walls.
    side_wall, top_wall, end_wall : float [m]
        Thickness of the outer walls: along the sides, on top, at the two ends.
    floor : float [m]
        Thickness of the silicone between cavity and strain-limiting layer; 0 leaves the chambers open at the bottom,
        and the base closes them: the face ``strain_limiting_layer`` is then left out under the chambers.
    base : float [m]
        Thickness of the silicone below the strain-limiting layer; 0 leaves it out, and the layer is the bottom itself.
    channel_width, channel_height : float [m]
        Air channel that joins the chambers, along x on the floor in the middle.
    channel_wall : float [m]
        Thickness of the bridge around the channel in each gap, at its sides and above it.
    end_extension : float [m]
        Length by which the first and the last chamber are longer than the others, along the middle. At the
        default length 11 chambers take 45 degrees with 4 mm and 60 degrees with 12 mm.
    clamp_length : float [m]
        Length of a solid block before the first chamber, fixed at its end and all around (``fixed``); 0 for none.
    inlet_diameter : float [m]
        Diameter of an air inlet along x through the middle of the first end wall; 0 for none. Its wall belongs to the
        face ``cavity``, which is then open in the plane x = 0; the cavity's volume counts up to there.
    symmetric : bool
        Always False, because half of a helical PneuNet and its mirror image are another actuator.

    Raises
    ------
    TurgorError
        If a dimension is out of range; the message states the field, its value and the range.

    Examples
    --------
    >>> round(HelicalPneuNet().cavity_volumes["cavity"] * 1e9)  # mm³
    11625
    >>> HelicalPneuNet(chamber_angle=45 * deg)
    Traceback (most recent call last):
    turgor.TurgorError: chamber_angle is 45 deg; allowed is -35.243 deg to 35.243 deg, so that the \
chambers keep an inside; a larger end_extension or length, or fewer chambers allow more.
    """

    chambers: int = 11
    length: float = 110 * mm
    width: float = 20 * mm
    height: float = 15 * mm
    chamber_angle: float = field(default=30 * deg, metadata={"dimension": "angle"})
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
    end_extension: float = 0.0
    clamp_length: float = 0.0
    inlet_diameter: float = 0.0
    symmetric: bool = False

    def __post_init__(self) -> None:
        check_envelope(self)
        if self.symmetric:
            raise TurgorError("symmetric is True; a helical PneuNet has no mirror plane, allowed is False.")
        why = f"so that {self.chambers} chambers fit in {in_mm(self.length)}"
        high = (self.length - 3 * SMALLEST_LENGTH * self.chambers) / 2
        check_length("end_extension", self.end_extension, low=0.0, high=high, why=why)
        check_row(row_of(self))
        most = self._most_angle()
        why = "so that the chambers keep an inside; a larger end_extension or length, or fewer chambers allow more"
        check_angle("chamber_angle", self.chamber_angle, low=-most, high=most, why=why)

    def _most_angle(self) -> float:
        """Largest chamber angle that leaves something of every chamber and of the ends' walls, by bisection."""
        low, high = 0.0, MOST_ANGLE
        if self.chambers == 1 or self._room(high) > 0:
            return high
        while high - low > 1e-6:
            middle = (low + high) / 2
            low, high = (middle, high) if self._room(middle) > 0 else (low, middle)
        return low

    def _room(self, angle: float) -> float:
        """The least that remains of a chamber's inside or of an end block along x at a chamber angle [m]."""
        row = row_of(self, slant=angle)
        end = row.block + row.end_extension
        inside = end - row.wall_along - row.inner_width / 2 * tan(angle) - self.end_wall
        outside = end - row.width / 2 * tan(angle)
        return min(inside, outside, row.block - 2 * row.wall_along) - SMALLEST_LENGTH

    @property
    def smallest_wall(self) -> float:
        """Thickness of the thinnest wall [m]."""
        return self._row.thinnest

    @property
    def cavity_volumes(self) -> Mapping[str, float]:
        """Volume of the cavity [m³] by the name of its face."""
        return {"cavity": self._row.cavity_volume}

    @property
    def solid_volume(self) -> float:
        """Volume of the silicone [m³], from the dimensions."""
        slab = (self.clamp_length + self.length) * self.width * self._row.floor_top
        return slab + self._row.block_volume + self._row.bridge_volume - self._row.cavity_volume

    def build(self) -> Geometry:
        """Build the solids and name them.

        Returns
        -------
        Geometry
            Regions and faces as those of a whole `turgor.FastPneuNet`.

        Raises
        ------
        TurgorError
            If the CAD volumes are not those of the dimensions.
        """
        row = self._row
        body = cut(row.slab((self.base, self.height)), row.gaps())
        blocks, cavities = with_base(body, self.base, row.slab), {"cavity": row.cavity()}
        sweep = row_sweep(row, row_blocks(row), self.base)
        return replace(finished(self, "helical PneuNet", blocks, cavities, self.base), _sweep=sweep)

    @property
    def _row(self) -> ChamberRow:
        return row_of(self, slant=self.chamber_angle)
