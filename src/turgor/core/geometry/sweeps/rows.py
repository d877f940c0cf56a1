"""Sweeps of PneuNets from blocks: layers along x for walls across the axis, layers along z for slanted ones."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import tan
from typing import TYPE_CHECKING

from turgor.core.geometry.extrusion import Along, FaceName, Part, PlaneName, Sweep, end_names, layers_of
from turgor.core.geometry.shapes.sections import Outline, disc, polygon, rectangle

if TYPE_CHECKING:
    from turgor.core.geometry.parts.bellows_row import BellowsRow
    from turgor.core.geometry.parts.chamber_block import ChamberBlock
    from turgor.core.geometry.parts.chamber_row import ChamberRow

Range = tuple[float, float]


@dataclass(frozen=True, slots=True, kw_only=True)
class Block:
    """A block of a row of chambers, symmetric to y = 0.

    Parameters
    ----------
    name : str or None
        Region, cavity, or None for air.
    along : (2,) floats [m]
        Its range along x, in the middle.
    width : float [m]
        Its width along y.
    up : (2,) floats [m]
        Its range along z.
    straight : (2,) bools
        Whether each of its ends is perpendicular to x although the walls are slanted.
    """

    name: str | None
    along: Range
    width: float
    up: Range
    straight: tuple[bool, bool] = (False, False)


def row_blocks(row: "ChamberRow") -> list[Block]:
    """Return the blocks of a row of chambers: silicone, gaps with bridges, air; later ones cover earlier ones."""
    whole, base = (0.0, row.clamp_length + row.length), row.base or 0.0
    both = (True, True)
    blocks = []
    stretches = [(0.0, row.clamp_length), (row.clamp_length, whole[1])] if row.clamp_length else [whole]
    for along in stretches:  # a boundary between cells at the end of the clamped block
        blocks.append(Block(name="body", along=along, width=row.width, up=(base, row.height), straight=both))
        if base:
            blocks.append(Block(name="base", along=along, width=row.width, up=(0.0, base), straight=both))
    bridge = (row.floor_top, row.channel_top + row.channel_wall)
    for gap in row.gap_ranges():
        blocks.append(Block(name=None, along=gap, width=row.width, up=(row.floor_top, row.height)))
        blocks.append(Block(name="body", along=gap, width=row.channel_width + 2 * row.channel_wall, up=bridge))
    return [*blocks, *row_air(row)]


def row_air(row: "ChamberRow") -> list[Block]:
    """List the chambers and the channels between them."""
    blocks = []
    for i, (start, end) in enumerate(row.chamber_ranges()):
        first, last = i == 0, i == row.joints
        inside = (start + (row.end_wall if first else row.wall_along), end - (row.end_wall if last else row.wall_along))
        up = (row.floor_top, row.height - row.top_wall)
        blocks.append(Block(name="cavity", along=inside, width=row.inner_width, up=up, straight=(first, last)))
    for start, end in row.gap_ranges():
        along = (start - row.wall_along, end + row.wall_along)
        up = (row.channel_bottom, row.channel_top)
        blocks.append(Block(name="cavity", along=along, width=row.channel_width, up=up))
    return blocks


def mirrored(blocks: Sequence[Block], cavity: str) -> list[Block]:
    """Mirror blocks at the plane z = 0; their cavity gets another name."""
    return [
        replace(block, name=cavity if block.name == "cavity" else block.name, up=(-block.up[1], -block.up[0]))
        for block in blocks
    ]


def row_sweep(row: "ChamberRow", blocks: Sequence[Block], layer: float | None) -> Sweep | None:
    """Describe the blocks of a row as a sweep.

    Parameters
    ----------
    row : ChamberRow
        Row of chambers with its slant, inlet and ends.
    blocks : sequence of Block
        All blocks but the inlet; later ones cover earlier ones.
    layer : float or None [m]
        Height of the strain-limiting layer.

    Returns
    -------
    Sweep or None
        None for slanted walls with an inlet, which is round along another direction.

    Examples
    --------
    >>> from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
    >>> row = FastPneuNet(chambers=2, length=20e-3)._row
    >>> sweep = row_sweep(row, row_blocks(row), row.base)
    >>> [round((layer.end - layer.start) * 1e3, 3) for layer in sweep.layers]  # mm
    [2.0, 6.5, 1.0, 1.0, 1.0, 6.5, 2.0]
    """
    names = pneunet_names(row, layer)
    if row.slant:
        if row.inlet_diameter:
            return None
        plans: list[Part] = [(block.name, _plan(row, block), block.up) for block in blocks]
        return Sweep(layers=layers_of(plans), path=Along(axis=2), names=names)
    parts: list[Part] = [(block.name, _rectangle(row, block.width, block.up), block.along) for block in blocks]
    if row.inlet_diameter:
        duct = disc(row.inlet_diameter / 2, (0.0, (row.floor_top + row.height - row.top_wall) / 2))
        end = row.clamp_length + row.end_wall
        parts.append(("cavity", duct.cut_y() if row.symmetric else duct, (0.0, end)))
    return Sweep(layers=layers_of(parts), names=names)


def block_sweep(block: "ChamberBlock") -> Sweep | None:
    """Describe a block with chambers as layers along z; None if it has an inlet, which is round along x.

    Examples
    --------
    >>> from turgor.core.geometry.actuators.slow_pneunet import SlowPneuNet
    >>> len(block_sweep(SlowPneuNet()._block).layers)  # base, floor, channels, chambers, top
    5
    """
    if block.inlet_diameter:
        return None
    fin = polygon(block.outline((0.0, block.length), block.root_width, block.tip_width))
    base: list[Part] = [("base", fin, (0.0, block.base))] if block.base else []
    parts: list[Part] = [*base, ("body", fin, (block.base, block.height))]
    if block.clamp_length:
        clamp = rectangle((0.0, block.clamp_length), _across(block, block.root_width))
        parts += [("base", clamp, (0.0, block.base))] if block.base else []
        parts += [("body", clamp, (block.base, block.height))]
    up = (block.floor_top, block.height - block.top_wall)
    parts += [("cavity", polygon(corners), up) for corners in block.chamber_plans()]
    up = (block.floor_top, block.floor_top + block.channel_height)
    parts += [("cavity", polygon(corners), up) for corners in block.channel_plans()]
    return Sweep(layers=layers_of(parts), path=Along(axis=2), names=pneunet_names(block, block.base))


def pneunet_names(actuator: "ChamberRow | ChamberBlock | BellowsRow", layer: float | None) -> tuple[FaceName, ...]:
    """Names of the faces of a PneuNet whose strain-limiting layer is at a height [m], or None."""
    end = actuator.clamp_length + actuator.length
    names = end_names(end=end, clamp=actuator.clamp_length, mirrors="y" if actuator.symmetric else "")
    if layer is None:
        return names
    return (*names, PlaneName(name="strain_limiting_layer", axis=2, position=layer, within=True))


def _across(actuator: "ChamberRow | ChamberBlock", width: float) -> Range:
    return (0.0 if actuator.symmetric else -width / 2, width / 2)


def _rectangle(row: "ChamberRow", width: float, up: Range) -> Outline:
    return rectangle(_across(row, width), up)


def _plan(row: "ChamberRow", block: Block) -> Outline:
    """Outline of a block seen from above, its ends slanted."""
    (a, b), (right, left) = block.along, _across(row, block.width)
    low, high = (0.0 if straight else tan(row.slant) for straight in block.straight)
    corners = ((a, low, right), (b, high, right), (b, high, left), (a, low, left))
    return polygon([(x + slope * y, y) for x, slope, y in corners])
