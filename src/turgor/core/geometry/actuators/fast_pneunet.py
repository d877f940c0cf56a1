"""Fast PneuNet: a row of chambers with gaps between them on a base with a strain-limiting layer."""

from collections.abc import Mapping
from dataclasses import dataclass, replace

from turgor.core.geometry.geometry import Geometry
from turgor.core.geometry.parts.chamber_row import ChamberRow, check_row, row_of
from turgor.core.geometry.parts.pneunet import check_envelope, copies, finished, with_base
from turgor.core.geometry.shapes.solids import cut
from turgor.core.geometry.sweeps.rows import row_blocks, row_sweep
from turgor.units import mm


@dataclass(frozen=True, slots=True, kw_only=True)
class FastPneuNet:
    """Fast PneuNet: a row of chambers with gaps between them, above a common floor (Mosadegh et al. 2014).

    Pressure bulges the thin walls that face each other across the gaps; they push each other apart and the
    actuator bends towards its base, which a strain-limiting layer keeps from stretching.

    Mosadegh et al. (2014) publish 11 chambers, about 110 x 20 x 15 mm, ``wall`` 1 mm, ``gap`` 1 mm, and outer walls of
    about 2 to 3 mm. These numbers are quoted and were not checked against the drawing. Outer walls of 2 mm were chosen
    here within the published range. ``floor`` and ``base`` of 1.5 mm each and the channel of 3 x 2 mm with a wall of 1
    mm were chosen without a published number.

    Axes: x from the fixed end to the tip, z up, y across; the base lies at z = 0, the mirror plane at y = 0. The air
    inlet is left out by default: the cavity is closed.

    Parameters
    ----------
    chambers : int
        Number of chambers, 1 to 100.
    length, width, height : float [m]
        Outer dimensions, base and floor included, the clamped block not; 1 mm to 2 m each.
    wall : float [m]
        Thickness of the walls that face each other across a gap.
    gap : float [m]
        Distance between neighboring chamber blocks.
    side_wall, top_wall, end_wall : float [m]
        Thickness of the outer walls: along the sides, on top, at the two ends.
    floor : float [m]
        Thickness of the silicone between cavity and strain-limiting layer; 0 leaves the chambers open at the bottom,
        and the base closes them: the face ``strain_limiting_layer`` is then left out under the chambers.
    base : float [m]
        Thickness of the silicone below the strain-limiting layer; 0 leaves it out, and the layer is the bottom itself.
    channel_width, channel_height : float [m]
        Air channel that joins the chambers, on the floor in the middle.
    channel_wall : float [m]
        Thickness of the bridge around the channel in each gap, at its sides and above it.
    clamp_length : float [m]
        Length of a solid block before the first chamber, fixed at its end and all around (``fixed``); 0 for none.
    inlet_diameter : float [m]
        Diameter of an air inlet along x through the middle of the first end wall; 0 for none. Its wall belongs to the
        face ``cavity``, which is then open in the plane x = 0; the cavity's volume counts up to there.
    symmetric : bool
        Whether to model only the half with y >= 0, cut at the face ``symmetry_y``.

    Raises
    ------
    TurgorError
        If a dimension is out of range; the message states the field, its value in mm and the range.

    Examples
    --------
    >>> finger = FastPneuNet()
    >>> round(finger.chamber_length * 1e3, 4)  # mm
    9.0909
    >>> FastPneuNet(gap=-1e-3)
    Traceback (most recent call last):
    turgor.TurgorError: gap is -1 mm; allowed is 0.01 mm to 10.967 mm, so that 11 chambers fit in 110 mm.
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
    clamp_length: float = 0.0
    inlet_diameter: float = 0.0
    symmetric: bool = True

    def __post_init__(self) -> None:
        check_envelope(self)
        check_row(self._row)

    @property
    def chamber_length(self) -> float:
        """Length of one chamber block, walls included [m]: (length − (chambers − 1) gap) / chambers."""
        return self._row.block

    @property
    def pitch(self) -> float:
        """Distance from one chamber to the next [m]."""
        return self._row.pitch

    @property
    def floor_top(self) -> float:
        """Height of the cavity's lower face above the bottom [m]."""
        return self._row.floor_top

    @property
    def smallest_wall(self) -> float:
        """Thickness of the thinnest wall [m]."""
        return self._row.thinnest

    @property
    def cavity_volume(self) -> float:
        """Volume of the cavity of the modeled part [m³], from the dimensions."""
        return self._row.cavity_volume

    @property
    def cavity_volumes(self) -> Mapping[str, float]:
        """Volume of the cavity of the modeled part [m³] by the name of its face."""
        return {"cavity": self.cavity_volume}

    @property
    def solid_volume(self) -> float:
        """Volume of the silicone of the modeled part [m³], from the dimensions."""
        slab = (self.clamp_length + self.length) * self.width * self.floor_top / copies(self)
        return slab + self._row.block_volume + self._row.bridge_volume - self.cavity_volume

    def build(self) -> Geometry:
        """Build the solids and name them.

        Returns
        -------
        Geometry
            Regions ``body`` and ``base``; faces ``cavity``, ``fixed`` (the plane x = 0 and the sides of the clamped
            block), ``tip`` (the plane at the other end), ``strain_limiting_layer`` (between body and base),
            ``outside`` (the rest) and, for a half, ``symmetry_y``.

        Raises
        ------
        TurgorError
            If the CAD volumes are not those of the dimensions.
        """
        row = self._row
        body = cut(row.slab((self.base, self.height)), row.gaps())
        blocks, cavities = with_base(body, self.base, row.slab), {"cavity": row.cavity()}
        sweep = row_sweep(row, row_blocks(row), self.base)
        return replace(finished(self, "fast PneuNet", blocks, cavities, self.base), _sweep=sweep)

    @property
    def _row(self) -> ChamberRow:
        return row_of(self)
