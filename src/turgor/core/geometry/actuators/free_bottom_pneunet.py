"""Free-bottom PneuNet: a fast PneuNet whose chambers stand apart down to the strain-limiting layer."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

from turgor.core.geometry.extrusion import Sweep
from turgor.core.geometry.geometry import Geometry
from turgor.core.geometry.parts.chamber_row import ChamberRow, check_row, row_of
from turgor.core.geometry.parts.pneunet import across, check_envelope, copies, finished
from turgor.core.geometry.rules import SMALLEST_LENGTH, check_length
from turgor.core.geometry.shapes.solids import box, cut
from turgor.core.geometry.sweeps.rows import Block, row_air, row_blocks, row_sweep
from turgor.units import mm


@dataclass(frozen=True, slots=True, kw_only=True)
class FreeBottomPneuNet:
    """Fast PneuNet with a free bottom (Yang 2020): between the chambers only the outer sides of the floor are bonded.

    In the intervals between the chambers the floor is left out, apart from a strip along each side, and the air
    channel hangs free above the base: less silicone resists the bending.

    The dimensions were chosen here, without published numbers: the default `FastPneuNet`, channels that hang 1.5 mm
    above the strain-limiting layer, and strips 4 mm wide. With three chambers, strips of 2, 4 and 6 mm bend 42, 28 and
    27 % more than the fast PneuNet. 4 mm was chosen because the published gain is about 20 %, so the agreement is no
    validation. The layer covers the whole base.

    Axes: x from the fixed end to the tip, z up, y across; the base lies at z = 0, the mirror plane at y = 0.

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
        Thickness of the silicone between cavity and strain-limiting layer.
    base : float [m]
        Thickness of the silicone below the strain-limiting layer.
    channel_width, channel_height : float [m]
        Air channel that joins the chambers, in the middle.
    channel_wall : float [m]
        Thickness of the tube around the channel in each gap, below it too.
    free_height : float [m]
        Distance between strain-limiting layer and the tube around the channel; with ``channel_wall`` at least
        ``floor``, so that the channel meets the chambers above their floor.
    bonded_side : float [m]
        Width of the strip of floor that joins the chambers along each side; 0 for none.
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
    >>> round(FreeBottomPneuNet().solid_volume * 1e9)  # mm³, of the half
    9140
    >>> FreeBottomPneuNet(free_height=0.2e-3)
    Traceback (most recent call last):
    turgor.TurgorError: free_height is 0.2 mm; allowed is 0.5 mm to 8.49 mm, so that the channel with its wall \
ends between floor and top of the chambers.
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
    free_height: float = 1.5 * mm
    bonded_side: float = 4 * mm
    clamp_length: float = 0.0
    inlet_diameter: float = 0.0
    symmetric: bool = True

    def __post_init__(self) -> None:
        check_envelope(self)
        why = "because the base closes the chambers"
        check_length("base", self.base, high=self.height - 3 * SMALLEST_LENGTH, why=why)
        check_length("floor", self.floor, high=self.height)  # strips of it join the chambers
        check_row(row_of(self))
        if self.chambers > 1:
            self._check_free_part()

    def _check_free_part(self) -> None:
        least, row = SMALLEST_LENGTH, row_of(self)
        room = self.height - self.base - self.channel_height - 2 * least
        why = "so that the channel with its walls fits above the base"
        check_length("channel_wall", self.channel_wall, high=room / 2, why=why)
        high = row.inner_height - self.channel_height - least + self.floor - self.channel_wall
        high = min(high, self.height - self.base - self.channel_height - 2 * self.channel_wall - least)
        check_length(
            "free_height", self.free_height, low=max(least, self.floor - self.channel_wall), high=high,
            why="so that the channel with its wall ends between floor and top of the chambers",
        )  # fmt: skip
        free = (self.width - self.channel_width) / 2 - self.channel_wall
        check_length(
            "bonded_side", self.bonded_side, low=0.0, high=free - least, why="next to the channel with its walls"
        )

    @property
    def smallest_wall(self) -> float:
        """Thickness of the thinnest wall [m]."""
        return min(self._row.thinnest, self.bonded_side) if self.bonded_side else self._row.thinnest

    @property
    def cavity_volumes(self) -> Mapping[str, float]:
        """Volume of the cavity of the modeled part [m³] by the name of its face."""
        return {"cavity": self._row.cavity_volume}

    @property
    def solid_volume(self) -> float:
        """Volume of the silicone of the modeled part [m³], from the dimensions."""
        row = self._row
        slab = (self.clamp_length + self.length) * self.width * row.floor_top
        tube = (self.channel_width + 2 * self.channel_wall) * (self.channel_height + 2 * self.channel_wall)
        open_bottom = (self.width - 2 * self.bonded_side) * self.floor
        joints = row.joints * self.gap * (tube - open_bottom)
        return (slab + joints) / copies(self) + row.block_volume - row.cavity_volume

    def build(self) -> Geometry:
        """Build the solids and name them.

        Returns
        -------
        Geometry
            Regions and faces as those of `turgor.FastPneuNet.build`; ``strain_limiting_layer`` covers the
            whole base, in the free intervals too.

        Raises
        ------
        TurgorError
            If the CAD volumes are not those of the dimensions.
        """
        row = self._row
        body, base = cut(row.slab((self.base, self.height)), self._air()), row.slab((0, self.base))
        blocks, cavities = [("body", body), ("base", base)], {"cavity": row.cavity()}
        return replace(finished(self, "free-bottom PneuNet", blocks, cavities, self.base), _sweep=self._sweep())

    def _sweep(self) -> Sweep | None:
        """The same shape as layers along x."""
        row = self._row
        blocks = row_blocks(row)
        for along in row.gap_ranges():
            free, top = self.width - 2 * self.bonded_side, row.channel_top + self.channel_wall
            blocks.append(Block(name=None, along=along, width=self.width, up=(row.floor_top, self.height)))
            blocks.append(Block(name=None, along=along, width=free, up=(self.base, row.floor_top)))
            tube, up = self.channel_width + 2 * self.channel_wall, (self.base + self.free_height, top)
            blocks.append(Block(name="body", along=along, width=tube, up=up))
        return row_sweep(row, [*blocks, *row_air(row)], self.base)

    @property
    def _row(self) -> ChamberRow:
        return row_of(self, channel_rise=self.free_height + self.channel_wall - self.floor)

    def _air(self) -> list[Any]:
        """The air between the chambers, around the tubes and next to the bonded strips."""
        row, whole = self._row, across(self, self.width)
        up = (self.base + self.free_height, row.channel_top + self.channel_wall)
        air = []
        for along in row.gap_ranges():
            tube = box(along, across(self, self.channel_width + 2 * self.channel_wall), up)
            above = box(along, whole, (row.floor_top, self.height))
            below = box(along, across(self, self.width - 2 * self.bonded_side), (self.base, row.floor_top))
            air.append(above + below - tube)
        return air
