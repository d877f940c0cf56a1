"""PneuNet with triangular bellows: a roof folded into a zigzag over an air space, on a strain-limiting layer."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from math import atan2

from turgor.core.geometry.geometry import Geometry
from turgor.core.geometry.parts.bellows_row import BellowsRow, bellows_of, check_bellows, check_inside, foot
from turgor.core.geometry.parts.pneunet import check_envelope, finished, with_base
from turgor.core.geometry.sweeps.profiles import bellows_sweep
from turgor.units import mm


@dataclass(frozen=True, slots=True, kw_only=True)
class TriangularPneuNet:
    """PneuNet with triangular bellows: a roof that goes up and down in a zigzag, the flanks meeting in points.

    Pressure unfolds the roof and bends the actuator towards its base. The air space passes below the gaps across the
    whole inner width.

    The dimensions were chosen here, without published numbers: the envelope of the default `FastPneuNet`, ten bellows
    and walls of 1.5 mm.

    Axes: x from the fixed end to the tip, z up, y across; the base lies at z = 0, the mirror plane at y = 0. At both
    ends the roof lies as low as between the bellows.

    Parameters
    ----------
    chambers : int
        Number of bellows, 1 to 100.
    length, width, height : float [m]
        Outer dimensions, base and floor included, the clamped block not; 1 mm to 2 m each.
    wall : float [m]
        Thickness of the flanks, and of the roof between the bellows.
    gap : float [m]
        Distance between the feet of neighboring bellows.
    side_wall, end_wall : float [m]
        Thickness of the outer walls: along the sides, at the two ends.
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
    >>> from turgor.units import deg
    >>> round(TriangularPneuNet().flank_angle / deg, 2)
    29.71
    >>> TriangularPneuNet(wall=10e-3)
    Traceback (most recent call last):
    turgor.TurgorError: wall is 10 mm; allowed is 0.01 mm to 9.97 mm, so that bellows remain within the \
height of 15 mm.
    """

    chambers: int = 10
    length: float = 110 * mm
    width: float = 20 * mm
    height: float = 15 * mm
    wall: float = 1.5 * mm
    gap: float = 1 * mm
    side_wall: float = 2 * mm
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
        check_inside(self._row)

    @property
    def flank_angle(self) -> float:
        """Angle of the flanks against the vertical [rad]."""
        roof = self.base + self.floor + self.channel_height + self.wall
        return atan2(foot(self) / 2, self.height - roof)

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
        geometry = finished(self, "triangular PneuNet", blocks, {"cavity": row.cavity()}, self.base)
        return replace(geometry, _sweep=bellows_sweep(row))

    @property
    def _row(self) -> BellowsRow:
        return bellows_of(self, flank_angle=self.flank_angle, top_wall=0.0)
