"""Sweeps of bellows in a row: layers along y, because their profile is constant across the width."""

from typing import TYPE_CHECKING

from turgor.core.geometry.extrusion import Along, Part, Sweep, layers_of
from turgor.core.geometry.shapes.sections import polygon, rectangle
from turgor.core.geometry.sweeps.rows import pneunet_names

if TYPE_CHECKING:
    from turgor.core.geometry.parts.bellows_row import BellowsRow


def bellows_sweep(row: "BellowsRow") -> Sweep | None:
    """Describe a row of bellows as layers along y; None if it has an inlet, which is round along x.

    Examples
    --------
    >>> from turgor.core.geometry.actuators.trapezoidal_pneunet import TrapezoidalPneuNet
    >>> len(bellows_sweep(TrapezoidalPneuNet()._row).layers)  # of the half: air space, side wall
    2
    """
    if row.inlet_diameter:
        return None
    end = row.clamp_length + row.length
    outside, inside = ((0.0 if row.symmetric else -width / 2, width / 2) for width in (row.width, row.inner_width))
    parts: list[Part] = [("base", rectangle((0.0, end), (0.0, row.base)), outside)] if row.base else []
    parts.append(("body", polygon(row.roof()), outside))
    if row.clamp_length:  # a boundary between cells at the end of the clamped block
        if row.base:
            parts.append(("base", rectangle((0.0, row.clamp_length), (0.0, row.base)), outside))
        parts.append(("body", rectangle((0.0, row.clamp_length), (row.base, row.valley)), outside))
    parts.append(("cavity", polygon(row.air_space()), inside))
    return Sweep(layers=layers_of(parts), path=Along(axis=1), names=pneunet_names(row, row.base))
