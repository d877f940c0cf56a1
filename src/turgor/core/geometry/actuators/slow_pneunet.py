"""Slow PneuNet: a block with embedded chambers on a base with a strain-limiting layer."""

from collections.abc import Mapping
from dataclasses import dataclass, replace

from turgor.core.geometry.geometry import Geometry
from turgor.core.geometry.parts.chamber_block import ChamberBlock, block_of, check_block
from turgor.core.geometry.parts.pneunet import check_envelope, copies, finished, with_base
from turgor.core.geometry.sweeps.rows import block_sweep
from turgor.units import mm


@dataclass(frozen=True, slots=True, kw_only=True)
class SlowPneuNet:
    """Slow PneuNet: chambers embedded in a block, without gaps between them (Mosadegh et al. 2014).

    The whole top must stretch before the actuator bends, so it needs about three times the pressure of a fast PneuNet.

    The dimensions were chosen here: the envelope and the cavity of the default `FastPneuNet`, with its gaps filled. The
    wall of 3 mm between two chambers equals two walls and a gap of 1 mm each.

    Axes: x from the fixed end to the tip, z up, y across; the base lies at z = 0, the mirror plane at y = 0.

    Parameters
    ----------
    chambers : int
        Number of chambers, 1 to 100.
    length, width, height : float [m]
        Outer dimensions, base and floor included, the clamped block not; 1 mm to 2 m each.
    wall : float [m]
        Thickness of the wall between neighboring chambers.
    side_wall, top_wall, end_wall : float [m]
        Thickness of the outer walls: along the sides, on top, at the two ends.
    floor : float [m]
        Thickness of the silicone between cavity and strain-limiting layer; 0 leaves the chambers open at the bottom,
        and the base closes them: the face ``strain_limiting_layer`` is then left out under the chambers.
    base : float [m]
        Thickness of the silicone below the strain-limiting layer; 0 leaves it out, and the layer is the bottom itself.
    channel_width, channel_height : float [m]
        Air channel through the walls between the chambers, on the floor in the middle.
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
    >>> round(SlowPneuNet().cavity_volumes["cavity"] * 1e9)  # mm³, of the half; as the fast PneuNet
    6170
    >>> SlowPneuNet(wall=20e-3)
    Traceback (most recent call last):
    turgor.TurgorError: wall is 20 mm; allowed is 0.01 mm to 10.987 mm, so that 11 chambers fit in 110 mm.
    """

    chambers: int = 11
    length: float = 110 * mm
    width: float = 20 * mm
    height: float = 15 * mm
    wall: float = 3 * mm
    side_wall: float = 2 * mm
    top_wall: float = 2 * mm
    end_wall: float = 2 * mm
    floor: float = 1.5 * mm
    base: float = 1.5 * mm
    channel_width: float = 3 * mm
    channel_height: float = 2 * mm
    clamp_length: float = 0.0
    inlet_diameter: float = 0.0
    symmetric: bool = True

    def __post_init__(self) -> None:
        check_envelope(self)
        check_block(self._block)

    @property
    def smallest_wall(self) -> float:
        """Thickness of the thinnest wall [m]."""
        return self._block.thinnest

    @property
    def cavity_volumes(self) -> Mapping[str, float]:
        """Volume of the cavity of the modeled part [m³] by the name of its face."""
        return {"cavity": self._block.cavity_volume}

    @property
    def solid_volume(self) -> float:
        """Volume of the silicone of the modeled part [m³], from the dimensions."""
        return (self.clamp_length + self.length) * self.width * self.height / copies(self) - self._block.cavity_volume

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
        block = self._block
        blocks = with_base(block.filled((self.base, self.height)), self.base, block.filled)
        geometry = finished(self, "slow PneuNet", blocks, {"cavity": block.cavity()}, self.base)
        return replace(geometry, _sweep=block_sweep(block))

    @property
    def _block(self) -> ChamberBlock:
        return block_of(self, root_width=self.width, tip_width=self.width)
