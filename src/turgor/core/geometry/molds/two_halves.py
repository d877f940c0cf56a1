"""Mold of any part: two halves that come apart along an axis, and a core for each cavity."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from turgor.core.geometry import occ
from turgor.core.geometry.cad.cavities import find_hollows
from turgor.core.geometry.cad.facets import find_facets, round_facets
from turgor.core.geometry.cad_unit import METERS_PER_CAD_UNIT
from turgor.core.geometry.geometry import Geometry
from turgor.core.geometry.molds.cores import Plug, plug_of
from turgor.core.geometry.molds.draft import ANGLE, LEAST_SHARE, draft_lines, draftless, slopes
from turgor.core.geometry.molds.drafted import Cast, filled_part, with_casting, with_drafts
from turgor.core.geometry.molds.halves import block, lower_side, pins, pouring_holes
from turgor.core.geometry.molds.mold import Mold, MoldSettings, mold_part
from turgor.core.geometry.molds.parting import SLOPE, Parting, partings, undercut_of
from turgor.core.geometry.molds.taper.pull import Pull
from turgor.core.geometry.shapes.solids import cut, union
from turgor.foundation.errors import TurgorError
from turgor.units import deg

Array = NDArray[np.float64]

#: What is said of a wall that has no draft, because it may not.
STEPPED = "The wall around the opening stays upright: the step of the lower half that carries the core slides along it."

#: Relative change of a volume that is round-off.
UNCHANGED = 1e-9


def two_halves(geometry: Geometry, settings: MoldSettings) -> Mold:
    """Make the mold of a whole part.

    Parameters
    ----------
    geometry : Geometry
        The part; regions are cast as one.
    settings : MoldSettings
        Dimensions of the mold.

    Raises
    ------
    TurgorError
        If no two halves come off, a cavity has no plane opening, or the part is not a whole one of CAD faces.
    """
    plan = _planned(_whole(geometry), geometry.cavities, settings)
    cast = _drafted(plan, settings.draft) if settings.draft else plan.cast
    parts = {
        name: mold_part(f"{name} of the mold of {geometry.name}", name, shape)
        for name, shape in _parts(plan, cast, settings).items()
    }
    lines = _walls(cast, plan, settings)
    if settings.draft and abs(cast.filled.mass / plan.cast.filled.mass - 1) < UNCHANGED and lines:
        raise TurgorError(
            f"draft is {settings.draft / deg:.4g} deg, and this part has no wall that can be tapered, a plane one or a "
            "round one about the pull. Leave draft at 0 deg, or draw it in the CAD part."
        )
    stepped = [STEPPED] if settings.draft and _stepped(plan) else []
    mold = Mold(parts=parts, notes=(*_opening(plan), *lines, *stepped))
    return with_casting(mold, geometry, plan.cast, cast, settings) if settings.draft else mold


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Plan:
    """What is cast as it is drawn, its bounds, the way out of each core by its name, and where the halves part."""

    cast: Cast
    low: Array
    high: Array
    outside: Array
    plugs: dict[str, Plug]
    parting: Parting


def _planned(shape: Any, cavities: Sequence[str], settings: MoldSettings) -> _Plan:
    drawn = union(list(shape.solids))
    faces = list(dict.fromkeys(drawn.faces))
    facets = find_facets(drawn, faces)
    hollows = find_hollows(facets)[0]
    low, high = facets.points.min(axis=0), facets.points.max(axis=0)
    wall = settings.wall / METERS_PER_CAD_UNIT
    far = float(np.ptp(facets.points, axis=0).max()) + 3 * wall
    names = list(cavities) if len(hollows) == len(cavities) else ["cavity"] * len(hollows)
    plugs = [plug_of(name, each, facets, faces, far) for name, each in zip(names, hollows, strict=True)]
    air = cut(block(low - wall, high + wall) - drawn, [plug.shape for plug in plugs])
    inner = _pieces(air, low - wall / 2)[1]
    fillings = [min(inner, key=lambda each: float(each.Distance(plug.shape))) for plug in plugs]
    cast = Cast(filled=filled_part(drawn, fillings), fillings=fillings)
    outside = _corners(cast.filled)
    cores = ["core"] if len(plugs) == 1 else [f"core_{i + 1}" for i in range(len(plugs))]
    return _Plan(
        cast=cast,
        low=low,
        high=high,
        outside=outside,
        plugs=dict(zip(cores, plugs, strict=True)),
        parting=_chosen(outside, plugs, settings),
    )


def _parts(plan: _Plan, cast: Cast, settings: MoldSettings) -> dict[str, Any]:
    """The halves, and the cores, which stand out of the block."""
    low, high, plugs = plan.low, plan.high, list(plan.plugs.values())
    wall = settings.wall / METERS_PER_CAD_UNIT
    air = cut(block(low - wall, high + wall) - cast.filled, [*cast.fillings, *(plug.shape for plug in plugs)])
    shell = union(_pieces(air, low - wall / 2)[0])
    lower = lower_side(plan.parting, plugs, low - wall, high + wall, wall / 4)
    rods, holes = pins(plan.parting, low - wall / 2, high + wall / 2, settings)
    pours = pouring_holes(plan.outside, plan.parting, high + wall, settings)
    around = block(low - 2 * wall, high + 2 * wall)
    cores = [occ.Fuse([each, plug.shape * around]) for each, plug in zip(cast.fillings, plugs, strict=True)]
    halves = {"lower": union([shell * lower, *rods]), "upper": cut(shell - lower, [*holes, *pours])}
    return halves | dict(zip(plan.plugs, cores, strict=True))


def _whole(geometry: Geometry) -> Any:
    shape = geometry._cad
    if not hasattr(shape, "WriteBrep"):
        raise TurgorError("a mold is cut from CAD faces; a part of facets, films or mesh cells has none. Use STEP.")
    if geometry.wedge is not None or any(name.startswith("symmetry_") for name in geometry.faces):
        raise TurgorError("a mold is made for the whole part, and this is a share of it; build it without symmetry.")
    return shape


def _chosen(outside: Array, plugs: list[Plug], settings: MoldSettings) -> Parting:
    """The first plane from which halves come off, and along whose pull no core lies above another one.

    Where cores are pulled out, it is the plane of their openings, if halves come off there: walls with draft are then
    as thick as without.
    """
    ranked = partings(outside)
    pulled = {(each.axis, round(float(each.foot[each.axis]), 6)) for each in plugs if each.trapped < SLOPE}
    if len(pulled) == 1:
        axis, height = pulled.pop()
        undercut = undercut_of(outside, axis, height)
        if undercut <= ranked[0].undercut + SLOPE:
            return replace(ranked[0], axis=axis, height=height, undercut=undercut)
    free = [each for each in ranked if each.undercut * METERS_PER_CAD_UNIT**2 <= settings.undercut]
    if free:
        return next((each for each in free if not _stacked(each.axis, plugs)), free[0])
    parting = ranked[0]
    x, y, z = parting.place
    raise TurgorError(
        f"no two halves come off this part: pulled along {'xyz'[parting.axis]}, the best of x, y and z, "
        f"{parting.undercut:.3g} mm² around ({x:.3g}, {y:.3g}, {z:.3g}) mm hold them back, and undercut is "
        f"{settings.undercut * 1e6:g} mm². Cast it in two parts, or allow what rubber can be peeled off with "
        "MoldSettings(undercut=...)."
    )


def _drafted(plan: _Plan, draft: float) -> Cast:
    """What is cast with draft.

    A wall stays upright where a core leaves through it that lies in a step of the lower half: the step slides along
    this wall. Cores that are wider than their opening stay, because they are not pulled.
    """
    parting, plugs = plan.parting, plan.plugs.values()
    pull = Pull(axis=parting.axis, side=1, height=parting.height, draft=draft)
    cores = [
        None
        if each.trapped > SLOPE
        else Pull(axis=each.axis, side=-each.side, height=float(each.foot[each.axis]), draft=draft)
        for each in plugs
    ]
    return with_drafts(plan.cast, pull, cores, _stepped(plan))


def _stepped(plan: _Plan) -> list[Array]:
    """Openings whose cores lie in a step of the lower half."""
    parting = plan.parting
    return [each.foot for each in plan.plugs.values() if each.steps(parting.axis, parting.height)]


def _stacked(axis: int, plugs: list[Plug]) -> bool:
    """Whether two plugs that leave across an axis lie above each other along it."""
    aside = [each for each in plugs if each.axis != axis]
    boxes = [np.array([[corner[i] for i in range(3)] for corner in each.shape.bounding_box]) for each in aside]
    others = [i for i in range(3) if i != axis]
    return any(
        all(max(a[0, i], b[0, i]) < min(a[1, i], b[1, i]) for i in others)
        for k, a in enumerate(boxes)
        for b in boxes[k + 1 :]
    )


def _pieces(shape: Any, edge: Array) -> tuple[list[Any], list[Any]]:
    """Pieces of a block that reach its edge, and those within."""
    solids = list(shape.solids)
    around = [any(piece.bounding_box[0][i] < edge[i] for i in range(3)) for piece in solids]
    return [s for s, out in zip(solids, around, strict=True) if out], [
        s for s, out in zip(solids, around, strict=True) if not out
    ]


def _opening(plan: _Plan) -> list[str]:
    """How the mold opens."""
    parting, plugs = plan.parting, plan.plugs.values()
    axis = "xyz"[parting.axis]
    lines = [f"The halves part at {axis} = {parting.height + 0.0:.4g} mm and are pulled along {axis}."]
    for i, plug in enumerate(plugs, start=1):
        name = "The core" if len(plugs) == 1 else f"Core {i}"
        way = f"{'-' if plug.side < 0 else '+'}{'xyz'[plug.axis]}"
        if plug.trapped < SLOPE:
            lines.append(f"{name} is pulled out along {way}.")
        else:
            lines.append(
                f"{name} is wider than its opening at {way}: make it of wax or of a material that dissolves, or "
                "stretch the rubber over it."
            )
    return lines


def _walls(cast: Cast, plan: _Plan, settings: MoldSettings) -> list[str]:
    """Undercuts that hold the casting back, and which walls have less draft than requested."""
    outside, draft, parting = round_facets(cast.filled), settings.listed_draft, plan.parting
    area, slope = outside.areas, slopes(outside, parting.axis)
    steep, cap = area[slope < draft - ANGLE].sum() / area.sum(), area[slope > np.pi / 2 - draft].sum()
    lines = []
    if steep > 0.5 * LEAST_SHARE and cap < area.sum():
        remedy = "draw them with it" if settings.draft else "state a draft"
        lines.append(
            f"{steep:.0%} of the outside has a draft below {draft / deg:.4g}°: use a release agent, or {remedy}."
        )
    undercut = undercut_of(_corners(cast.filled), parting.axis, parting.height)
    if undercut > SLOPE:
        lines.append(f"Undercuts of {undercut:.2g} mm² hold the halves back; peel the rubber off them.")
    walls = draftless(outside, parting.axis, draft, "halves")
    for (name, plug), filling in zip(plan.plugs.items(), cast.fillings, strict=True):
        if plug.trapped < SLOPE:  # others are not pulled
            walls += draftless(round_facets(filling), plug.axis, draft, name.replace("_", " "))
    return [*lines, *draft_lines(walls, draft)]


def _corners(shape: Any) -> Array:
    return find_facets(shape, list(dict.fromkeys(shape.faces))).corners()
