"""Sweep of a layout: its prisms along x, divided into layers at their ends."""

from collections.abc import Sequence

from turgor.core.geometry.extrusion import FaceName, Interface, Part, Sweep, layers_of
from turgor.core.geometry.names import INTERFACE
from turgor.core.geometry.parts.prism import Prism


def layout_sweep(pieces: Sequence[Prism], air: Sequence[Prism], names: Sequence[FaceName]) -> Sweep:
    """Describe a layout as layers along x.

    Parameters
    ----------
    pieces, air : sequence of Prism
        Silicone and air of the modeled part.
    names : sequence of PlaneName, RangeName or Interface
        Names of its ends, mirror planes and strain-limiting layer. The faces between regions get theirs here.

    Examples
    --------
    >>> from turgor.core.geometry.actuators.extending_cylinder import ExtendingCylinder
    >>> [len(layer.fill) for layer in ExtendingCylinder().build()._sweep.layers]
    [1, 2, 1]
    """
    parts: list[tuple[float, bool, Part]] = []
    for piece in pieces:
        parts.append((piece.outline.area, True, (piece.name, piece.outline, piece.along)))
        if piece.hole:
            parts.append((piece.hole.area, False, (None, piece.hole, piece.along)))
    # from the largest to the smallest, so that the content of a hole covers it; a hole and its content
    # have the same area but for rounding
    parts.sort(key=lambda part: (-float(f"{part[0]:.9e}"), part[1]))
    hollow: list[Part] = [(part.name, part.outline, part.along) for part in air]
    return Sweep(layers=layers_of([*(part for _, _, part in parts), *hollow]), names=(*_interfaces(pieces), *names))


def _interfaces(pieces: Sequence[Prism]) -> tuple[FaceName, ...]:
    regions = list(dict.fromkeys(piece.name for piece in pieces))
    names: list[FaceName] = []
    for i, first in enumerate(regions):
        lateral = next((piece.lateral for piece in pieces if piece.name == first and piece.lateral), "")
        for second in regions[i + 1 :]:
            names.append(Interface(name=lateral or INTERFACE, regions=(first, second)))
    return tuple(names)
