"""Bidirectional PneuNet: two fast PneuNets joined at the strain-limiting layer, one above and one below."""

from collections.abc import Mapping
from dataclasses import dataclass, replace

from turgor.core.geometry import occ
from turgor.core.geometry.geometry import Geometry
from turgor.core.geometry.parts.chamber_row import ChamberRow, check_row, row_of
from turgor.core.geometry.parts.pneunet import check_envelope, copies, finished
from turgor.core.geometry.shapes.solids import cut
from turgor.core.geometry.sweeps.rows import mirrored, row_blocks, row_sweep
from turgor.units import mm


@dataclass(frozen=True, slots=True, kw_only=True)
class BidirectionalPneuNet:
    """Two benders joined at the bottom layer: pressure in ``cavity_1`` bends it down, in ``cavity_2`` up.

    The strain-limiting layer is the plane z = 0, between the floors of the two; there is no base.

    The dimensions were chosen here: the default `FastPneuNet` above, without its base, and its mirror image below.

    Axes: x from the fixed end to the tip, z up, y across; the mirror plane at y = 0. ``cavity_1`` is the upper one.

    Parameters
    ----------
    chambers : int
        Number of chambers on each side, 1 to 100.
    length, width : float [m]
        Outer dimensions, the clamped block not included; 1 mm to 2 m each.
    height : float [m]
        Height of each of the two above the strain-limiting layer, half of the whole; 1 mm to 2 m.
    wall : float [m]
        Thickness of the walls that face each other across a gap.
    gap : float [m]
        Distance between neighboring chamber blocks.
    side_wall, top_wall, end_wall : float [m]
        Thickness of the outer walls: along the sides, on top, at the two ends.
    floor : float [m]
        Thickness of the silicone between each cavity and the strain-limiting layer.
    channel_width, channel_height : float [m]
        Air channels that join the chambers of each side, on the floor in the middle.
    channel_wall : float [m]
        Thickness of the bridge around the channel in each gap, at its sides and above it.
    clamp_length : float [m]
        Length of a solid block before the first chamber, fixed at its end and all around (``fixed``); 0 for none.
    inlet_diameter : float [m]
        Diameter of an air inlet for each side, along x through the middle of the first end wall; 0 for none. Its wall
        belongs to the face of the cavity, which is then open in the plane x = 0; its volume counts up to there.
    symmetric : bool
        Whether to model only the half with y >= 0, cut at the face ``symmetry_y``.

    Raises
    ------
    TurgorError
        If a dimension is out of range; the message states the field, its value in mm and the range.

    Examples
    --------
    >>> sorted(BidirectionalPneuNet().cavity_volumes)
    ['cavity_1', 'cavity_2']
    >>> BidirectionalPneuNet(floor=0)
    Traceback (most recent call last):
    turgor.TurgorError: floor is 0 mm; allowed is 0.01 mm to 13.48 mm, so that a cavity remains within the \
height of 13.5 mm.
    """

    chambers: int = 11
    length: float = 110 * mm
    width: float = 20 * mm
    height: float = 13.5 * mm
    wall: float = 1 * mm
    gap: float = 1 * mm
    side_wall: float = 2 * mm
    top_wall: float = 2 * mm
    end_wall: float = 2 * mm
    floor: float = 1.5 * mm
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
    def smallest_wall(self) -> float:
        """Thickness of the thinnest wall [m]."""
        return self._row.thinnest

    @property
    def cavity_volumes(self) -> Mapping[str, float]:
        """Volume of each cavity of the modeled part [m³] by the name of its face."""
        return {"cavity_1": self._row.cavity_volume, "cavity_2": self._row.cavity_volume}

    @property
    def solid_volume(self) -> float:
        """Volume of the silicone of the modeled part [m³], from the dimensions."""
        row = self._row
        slab = (self.clamp_length + self.length) * self.width * self.floor / copies(self)
        return 2 * (slab + row.block_volume + row.bridge_volume - row.cavity_volume)

    def build(self) -> Geometry:
        """Build the solids and name them.

        Returns
        -------
        Geometry
            Region ``body`` (both sides); faces ``cavity_1`` above and ``cavity_2`` below, the others as those of
            `turgor.FastPneuNet.build`.

        Raises
        ------
        TurgorError
            If the CAD volumes are not those of the dimensions.
        """
        row, plane = self._row, occ.Axes(occ.Pnt(0, 0, 0), occ.Z, occ.X)
        above, air = cut(row.slab((0.0, self.height)), row.gaps()), row.cavity()
        blocks = [("body", above), ("body", above.Mirror(plane))]
        cavities = {"cavity_1": air, "cavity_2": air.Mirror(plane)}
        upper = [replace(b, name="cavity_1") if b.name == "cavity" else b for b in row_blocks(row)]
        sweep = None if self.inlet_diameter else row_sweep(row, [*upper, *mirrored(row_blocks(row), "cavity_2")], 0.0)
        return replace(finished(self, "bidirectional PneuNet", blocks, cavities, 0.0), _sweep=sweep)

    @property
    def _row(self) -> ChamberRow:
        return row_of(self)
