"""The sweep of a layout: its prisms along x, cut into layers where one begins or ends."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

from turgor.geometry.sweep import FaceName, Interface, Part, PlaneName, RangeName, Sweep, layers_of

if TYPE_CHECKING:
    from turgor.geometry.parts.layout import Layout, Prism

#: Name of the faces between two regions that have no better one.
INTERFACE = "interface"


def layout_sweep(layout: "Layout", pieces: Sequence["Prism"], air: Sequence["Prism"]) -> Sweep:
    """Tell a layout as layers along x.

    Parameters
    ----------
    layout : Layout
        Its ends, its mirror planes and the height of its strain-limiting layer.
    pieces, air : sequence of Prism
        Silicone and air of the modeled part.

    Examples
    --------
    >>> from turgor.geometry import ExtendingCylinder
    >>> [len(layer.fill) for layer in ExtendingCylinder().build()._sweep.layers]
    [1, 2, 1]
    """
    parts: list[tuple[float, bool, Part]] = []
    for piece in pieces:
        parts.append((piece.outline.area, True, (piece.name, piece.outline, piece.along)))
        if piece.hole:
            parts.append((piece.hole.area, False, (None, piece.hole, piece.along)))
    # from the largest to the smallest, so that what lies within a hole is painted after it; a hole and what fills it
    # have the same area but for rounding
    parts.sort(key=lambda part: (-float(f"{part[0]:.9e}"), part[1]))
    hollow: list[Part] = [(part.name, part.outline, part.along) for part in air]
    return Sweep(layers=layers_of([*(part for _, _, part in parts), *hollow]), names=_names(layout, pieces))


def _names(layout: "Layout", pieces: Sequence["Prism"]) -> tuple[FaceName, ...]:
    regions = list(dict.fromkeys(piece.name for piece in pieces))
    names: list[FaceName] = []
    for i, first in enumerate(regions):
        lateral = next((piece.lateral for piece in pieces if piece.name == first and piece.lateral), "")
        for second in regions[i + 1 :]:
            names.append(Interface(name=lateral or INTERFACE, regions=(first, second)))
    names.append(RangeName(name="fixed", axis=0, low=-layout.clamp_length, high=0.0))
    names.append(PlaneName(name="tip", axis=0, position=layout.length))
    if layout.layer is not None:
        names.append(PlaneName(name="strain_limiting_layer", axis=2, position=layout.layer, within=True))
    for axis, letter in ((1, "y"), (2, "z")):
        if letter in layout.mirrors:
            names.append(PlaneName(name=f"symmetry_{letter}", axis=axis, position=0.0))
    return tuple(names)
