"""PneuNet with trapezoidal bellows: a roof folded into trapezoids over an air space, on a strain-limiting layer."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from math import atan2, ceil, tan

from turgor.core.geometry.geometry import Geometry
from turgor.core.geometry.parts.bellows_row import BellowsRow, bellows_of, check_bellows, check_inside
from turgor.core.geometry.parts.pneunet import check_envelope, finished, with_base
from turgor.core.geometry.rules import SMALLEST_LENGTH, check_angle, check_length
from turgor.core.geometry.sweeps.profiles import bellows_sweep
from turgor.units import deg, mm


@dataclass(frozen=True, slots=True, kw_only=True)
class TrapezoidalPneuNet:
    """PneuNet with trapezoidal bellows (Hwang et al. 2015): tops narrower than feet, and V-shaped gaps between them.

    Pressure unfolds the roof and bends the actuator towards its base. The air space passes below the gaps across the
    whole inner width.

    The dimensions were chosen here, without published numbers: the envelope of the default `FastPneuNet`, eight bellows
    with flanks that lean by 10 degrees, and walls of 1.5 mm.

    Axes: x from the fixed end to the tip, z up, y across; the base lies at z = 0, the mirror plane at y = 0. At both
    ends the roof lies as low as between the bellows.

    Parameters
    ----------
    chambers : int
        Number of bellows, 1 to 100.
    length, width, height : float [m]
        Outer dimensions, base and floor included, the clamped block not; 1 mm to 2 m each.
    flank_angle : float [rad]
        Angle of the flanks against the vertical, 0 to 75 degrees; 0 makes rectangles.
    wall : float [m]
        Thickness of the flanks, and of the roof between the bellows.
    gap : float [m]
        Distance between the feet of neighboring bellows.
    side_wall, top_wall, end_wall : float [m]
        Thickness of the outer walls: along the sides, of the tops, at the two ends.
    floor : float [m]
        Thickness of the silicone between cavity and strain-limiting layer.
    base : float [m]
        Thickness of the silicone below the strain-limiting layer; 0 leaves it out, and the layer is the bottom itself.
    channel_height : float [m]
        Height of the air space below the gaps.
    clamp_length : float [m]
        Length of a solid block before the first end wall, fixed at its end and all around: the face ``fixed``; 0 for
        none.
    inlet_diameter : float [m]
        Diameter of an air inlet along x through the first end wall, in the middle of the air space below the gaps; 0
        for none. Its wall belongs to the face ``cavity``, which is then open in the plane x = 0; the cavity's volume
        counts up to there.
    symmetric : bool
        Whether to model only the half with y >= 0, cut at the face ``symmetry_y``.

    Raises
    ------
    TurgorError
        If a dimension is out of range; the message states the field, its value and the range.

    Examples
    --------
    >>> round(TrapezoidalPneuNet().top_length * 1e3, 4)  # mm
    9.3774
    >>> TrapezoidalPneuNet(flank_angle=1.2)
    Traceback (most recent call last):
    turgor.TurgorError: flank_angle is 68.755 deg; allowed is 0 deg to 36.03 deg, so that tops remain on \
feet 12.38 mm long.
    """

    chambers: int = 8
    length: float = 110 * mm
    width: float = 20 * mm
    height: float = 15 * mm
    flank_angle: float = field(default=10 * deg, metadata={"dimension": "angle"})
    wall: float = 1.5 * mm
    gap: float = 1 * mm
    side_wall: float = 2 * mm
    top_wall: float = 1.5 * mm
    end_wall: float = 2 * mm
    floor: float = 1.5 * mm
    base: float = 1.5 * mm
    channel_height: float = 2 * mm
    clamp_length: float = 0.0
    inlet_diameter: float = 0.0
    symmetric: bool = True

    def __post_init__(self) -> None:
        check_envelope(self)
        check_bellows(self)
        row, least = self._row, SMALLEST_LENGTH
        rise, why = self.height - row.valley, f"so that tops remain on feet {row.base_length / mm:.4g} mm long"
        steepest = atan2((row.base_length - least) / 2, rise)
        check_angle("flank_angle", self.flank_angle, low=0.0, high=min(steepest, 75 * deg), why=why)
        check_inside(row)
        high = self.height - row.channel_top - least
        meet = (row.inner_base - least) / 2 / max(tan(self.flank_angle), 1e-9)  # height at which the flanks meet
        lowest = ceil((self.height - row.channel_top - meet) / mm * 1000) / 1000 * mm  # rounded as it will be shown
        low = max(least, min(lowest, high))
        check_length("top_wall", self.top_wall, low=low, high=high, why="so that air with a flat top remains below it")

    @property
    def base_length(self) -> float:
        """Length of one of the bellows at its foot [m]."""
        return self._row.base_length

    @property
    def top_length(self) -> float:
        """Length of one of the bellows at its top [m]."""
        return self._row.top_length

    @property
    def smallest_wall(self) -> float:
        """Thickness of the thinnest wall [m]."""
        return self._row.thinnest

    @property
    def cavity_volumes(self) -> Mapping[str, float]:
        """Volume of the cavity of the modeled part [m³] by the name of its face."""
        return {"cavity": self._row.cavity_volume}

    @property
    def solid_volume(self) -> float:
        """Volume of the silicone of the modeled part [m³], from the dimensions."""
        return self._row.whole_volume - self._row.cavity_volume

    def build(self) -> Geometry:
        """Build the solids and name them.

        Returns
        -------
        Geometry
            Regions and faces as those of `turgor.FastPneuNet.build`.

        Raises
        ------
        TurgorError
            If the CAD volumes are not those of the dimensions.
        """
        row = self._row
        blocks = with_base(row.filled(), self.base, row.slab)
        geometry = finished(self, "trapezoidal PneuNet", blocks, {"cavity": row.cavity()}, self.base)
        return replace(geometry, _sweep=bellows_sweep(row))

    @property
    def _row(self) -> BellowsRow:
        return bellows_of(self, flank_angle=self.flank_angle, top_wall=self.top_wall)
