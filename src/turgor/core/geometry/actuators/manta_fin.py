"""Manta fin: a slow PneuNet in a tapered, swept planform, which flaps."""

from collections.abc import Mapping
from dataclasses import dataclass, replace

from turgor.core.geometry.geometry import Geometry
from turgor.core.geometry.parts.chamber_block import ChamberBlock, block_of, check_block
from turgor.core.geometry.parts.pneunet import check_envelope, finished, with_base
from turgor.core.geometry.rules import check_length
from turgor.core.geometry.sweeps.rows import block_sweep
from turgor.foundation.errors import TurgorError
from turgor.units import mm


@dataclass(frozen=True, slots=True, kw_only=True)
class MantaFin:
    """Fin of a swimming robot after the manta ray: a slow PneuNet that tapers from its root to its tip (Suzumori 2007).

    The dimensions were chosen here, without published numbers: a fin 80 mm long, 50 mm wide at the root and 20 mm at
    the tip, swept by 15 mm so that one edge is straight, 10 mm thick, with six chambers. A swept fin twists as it
    bends.

    Axes: x from the root to the tip, z up, y across; the base lies at z = 0; the middle of the root at y = 0.

    Parameters
    ----------
    chambers : int
        Number of chambers, one behind the other from root to tip, 1 to 100.
    length : float [m]
        From the root, or from the end of the clamped block, to the tip; 1 mm to 2 m.
    root_width, tip_width : float [m]
        Width (chord) of the fin at its two ends; 1 mm to 2 m each.
    sweep : float [m]
        How far the middle of the tip lies from that of the root along y, at most twice the length.
    height : float [m]
        Thickness of the fin, base and floor included; 1 mm to 2 m.
    wall : float [m]
        Thickness of the wall between neighboring chambers.
    side_wall : float [m]
        Thickness of the outer walls along the two edges, measured along y.
    top_wall, end_wall : float [m]
        Thickness of the outer walls on top and at the two ends.
    floor : float [m]
        Thickness of the silicone between cavity and strain-limiting layer; 0 leaves the chambers open at the bottom,
        and the base closes them: the face ``strain_limiting_layer`` is then left out under the chambers.
    base : float [m]
        Thickness of the silicone below the strain-limiting layer; 0 leaves it out, and the layer is the bottom itself.
    channel_width, channel_height : float [m]
        Air channel through the walls between the chambers, on the floor in the middle.
    clamp_length : float [m]
        Length of a solid block as wide as the root before the first chamber, fixed at its end and all around: the
        face ``fixed``; 0 for none.
    inlet_diameter : float [m]
        Diameter of an air inlet along x through the middle of the root's end wall; 0 for none. Its wall belongs to the
        face ``cavity``, which is then open in the plane x = 0; the cavity's volume counts up to there.
    symmetric : bool
        Whether to model only the half with y >= 0, cut at the face ``symmetry_y``; for a fin without sweep.

    Raises
    ------
    TurgorError
        If a dimension is out of range; the message states the field, its value in mm and the range.

    Examples
    --------
    >>> round(MantaFin().solid_volume * 1e9)  # mm³
    19060
    >>> MantaFin(symmetric=True)
    Traceback (most recent call last):
    turgor.TurgorError: symmetric is True; a fin swept by 15 mm has no mirror plane, allowed is False.
    """

    chambers: int = 6
    length: float = 80 * mm
    root_width: float = 50 * mm
    tip_width: float = 20 * mm
    sweep: float = 15 * mm
    height: float = 10 * mm
    wall: float = 3 * mm
    side_wall: float = 2.5 * mm
    top_wall: float = 2 * mm
    end_wall: float = 3 * mm
    floor: float = 1.5 * mm
    base: float = 1.5 * mm
    channel_width: float = 3 * mm
    channel_height: float = 2 * mm
    clamp_length: float = 0.0
    inlet_diameter: float = 0.0
    symmetric: bool = False

    def __post_init__(self) -> None:
        check_envelope(self, ("length", "root_width", "tip_width", "height"))
        check_length("sweep", self.sweep, low=-2 * self.length, high=2 * self.length, why="twice the length")
        if self.symmetric and self.sweep:
            swept = f"swept by {self.sweep / mm:.4g} mm"
            raise TurgorError(f"symmetric is True; a fin {swept} has no mirror plane, allowed is False.")
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
        return self._block.whole_volume - self._block.cavity_volume

    def build(self) -> Geometry:
        """Build the solids and name them.

        Returns
        -------
        Geometry
            Regions and faces as those of `turgor.FastPneuNet.build`; ``fixed`` is the root.

        Raises
        ------
        TurgorError
            If the CAD volumes are not those of the dimensions.
        """
        block = self._block
        blocks = with_base(block.filled((self.base, self.height)), self.base, block.filled)
        geometry = finished(self, "manta fin", blocks, {"cavity": block.cavity()}, self.base)
        return replace(geometry, _sweep=block_sweep(block))

    @property
    def _block(self) -> ChamberBlock:
        return block_of(self, root_width=self.root_width, tip_width=self.tip_width, sweep=self.sweep)
