"""Mold of any part: two halves that come apart along an axis, and a core for each cavity."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from turgor.core.geometry import occ
from turgor.core.geometry.cad.cavities import find_hollows
from turgor.core.geometry.cad.facets import find_facets
from turgor.core.geometry.cad_unit import METERS_PER_CAD_UNIT
from turgor.core.geometry.geometry import Geometry
from turgor.core.geometry.molds.cores import Plug, plug_of
from turgor.core.geometry.molds.draft import draft_lines, draftless
from turgor.core.geometry.molds.mold import Mold, MoldSettings, mold_part
from turgor.core.geometry.molds.parting import SLOPE, Parting, areas, partings
from turgor.core.geometry.shapes.solids import cut, union
from turgor.foundation.errors import TurgorError
from turgor.units import deg

Array = NDArray[np.float64]

#: How far the holes to pour reach into the casting's top, for tops that are round [CAD units].
REACH = 0.3

#: Share of the height below its top in which a casting is poured from.
TOP = 0.02


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
    body = union(list(_whole(geometry).solids))
    faces = list(dict.fromkeys(body.faces))
    facets = find_facets(body, faces)
    hollows = find_hollows(facets)[0]
    low, high = facets.points.min(axis=0), facets.points.max(axis=0)
    wall = settings.wall / METERS_PER_CAD_UNIT
    far = float(np.ptp(facets.points, axis=0).max()) + 3 * wall
    names = list(geometry.cavities) if len(hollows) == len(geometry.cavities) else [""] * len(hollows)
    plugs = [plug_of(n or "cavity", each, facets, faces, far) for n, each in zip(names, hollows, strict=True)]
    inside = np.concatenate([np.zeros(0, dtype=np.int64), *[np.array(each.faces) for each in hollows]])
    on_outside = ~np.isin(facets.face, inside)
    outside = facets.points[facets.triangles[on_outside]]
    parting = _chosen(partings(outside), plugs, settings)
    block = _box(low - wall, high + wall)
    pieces = list(cut(block - body, [plug.shape for plug in plugs]).solids)
    around = [any(piece.bounding_box[0][i] < low[i] - wall / 2 for i in range(3)) for piece in pieces]
    shell = union([piece for piece, out in zip(pieces, around, strict=True) if out])
    fillings = [piece for piece, out in zip(pieces, around, strict=True) if not out]
    cores = _cores(fillings, plugs, _box(low - 2 * wall, high + 2 * wall))
    lower = _lower_side(parting, plugs, low - wall, high + wall, wall / 4)
    pins, holes = _pins(parting, low - wall / 2, high + wall / 2, settings)
    pours = _pours(outside, parting, high + wall, settings)
    shapes = {"lower": union([shell * lower, *pins]), "upper": cut(shell - lower, [*holes, *pours])}
    named = ["core"] if len(cores) == 1 else [f"core_{i}" for i in range(1, len(cores) + 1)]
    shapes |= dict(zip(named, cores, strict=True))
    parts = {name: mold_part(f"{name} of the mold of {geometry.name}", name, each) for name, each in shapes.items()}
    walls = draftless(outside, facets.face[on_outside], parting.axis, settings.draft, "halves")
    for name, hollow, plug in zip(named, hollows, plugs, strict=True):
        rows = np.isin(facets.face, np.array(hollow.faces))
        corners = facets.points[facets.triangles[rows]]
        walls += draftless(corners, facets.face[rows], plug.axis, settings.draft, name.replace("_", " "))
    return Mold(parts=parts, notes=(*_notes(parting, outside, plugs, settings), *draft_lines(walls, settings.draft)))


def _whole(geometry: Geometry) -> Any:
    shape = geometry._cad
    if not hasattr(shape, "WriteBrep"):
        raise TurgorError("a mold is cut from CAD faces; a part of facets, films or mesh cells has none. Use STEP.")
    if geometry.wedge is not None or any(name.startswith("symmetry_") for name in geometry.faces):
        raise TurgorError("a mold is made for the whole part, and this is a share of it; build it without symmetry.")
    return shape


def _chosen(ranked: list[Parting], plugs: list[Plug], settings: MoldSettings) -> Parting:
    """The first plane from which halves come off, and along whose pull no core lies above another one."""
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


def _box(low: Array, high: Array) -> Any:
    return occ.Box(occ.Pnt(*map(float, low)), occ.Pnt(*map(float, high)))


def _cores(fillings: list[Any], plugs: list[Plug], around: Any) -> list[Any]:
    """Join each plug to the filling that it touches; it stands out of the block."""
    cores = []
    for plug in plugs:
        away = [float(each.Distance(plug.shape)) for each in fillings]
        cores.append(occ.Fuse([fillings[int(np.argmin(away))], plug.shape * around]))
    return cores


def _lower_side(parting: Parting, plugs: list[Plug], low: Array, high: Array, rim: float) -> Any:
    """Space of the lower half: below the plane, with steps, wider by a rim, to the middle of plugs across the pull."""
    top, axis = high.copy(), parting.axis
    top[axis] = parting.height
    side = _box(low, top) if parting.height > low[axis] else None
    for plug in (each for each in plugs if each.axis != axis):
        near, far = (np.array([corner[i] for i in range(3)]) for corner in plug.shape.bounding_box)
        middle = (near[axis] + far[axis]) / 2
        near[axis], far[axis] = sorted((middle, parting.height))
        if far[axis] - near[axis] < 1e-6:
            continue
        aside = 3 - axis - plug.axis
        near[aside], far[aside] = near[aside] - rim, far[aside] + rim
        step = _box(near, far)
        side = side - step if middle < parting.height else side + step
    return side


def _pins(parting: Parting, low: Array, high: Array, settings: MoldSettings) -> tuple[list[Any], list[Any]]:
    """Pins on the lower half, in the corners of the parting plane, and their holes in the upper one."""
    across = [i for i in range(3) if i != parting.axis]
    radius, tall, clear = (
        each / METERS_PER_CAD_UNIT for each in (settings.pin_diameter / 2, settings.pin_height, settings.clearance)
    )
    pins, holes = [], []
    for a in (low[across[0]], high[across[0]]):
        for b in (low[across[1]], high[across[1]]):
            foot = np.zeros(3)
            foot[parting.axis], foot[across[0]], foot[across[1]] = parting.height, a, b
            pins.append(_rod(foot, parting.axis, radius, tall))
            holes.append(_rod(foot, parting.axis, radius + clear, tall + clear))
    return pins, holes


def _pours(outside: Array, parting: Parting, high: Array, settings: MoldSettings) -> list[Any]:
    """Two holes from the ends of the casting's top out of the upper half: to pour in, and for the air."""
    axis, points = parting.axis, outside.reshape(-1, 3)
    level = points[:, axis].max()
    top = points[points[:, axis] > level - TOP * np.ptp(points[:, axis])]
    longest = max((i for i in range(3) if i != axis), key=lambda i: float(np.ptp(points[:, i])))
    radius = settings.pour_diameter / 2 / METERS_PER_CAD_UNIT
    holes = []
    for end in (top[:, longest].min(), top[:, longest].max()):
        near = top[np.abs(top[:, longest] - end) < 2 * radius + 1e-6]
        foot = (near.min(axis=0) + near.max(axis=0)) / 2
        foot[axis] = level - REACH
        holes.append(_rod(foot, axis, radius, float(high[axis] - foot[axis])))
    return holes


def _rod(foot: Array, axis: int, radius: float, height: float) -> Any:
    return occ.Cylinder(occ.Pnt(*map(float, foot)), (occ.X, occ.Y, occ.Z)[axis], r=radius, h=height)


def _notes(parting: Parting, outside: Array, plugs: list[Plug], settings: MoldSettings) -> tuple[str, ...]:
    axis = "xyz"[parting.axis]
    area, normal = areas(outside)
    slope = np.abs(normal[:, parting.axis])
    steep = area[slope < np.sin(settings.draft)].sum() / area.sum()
    cap = area[slope > np.cos(settings.draft)].sum()
    lines = [f"The halves part at {axis} = {parting.height:.4g} mm and are pulled along {axis}."]
    if steep > 0 and cap < area.sum():
        lines.append(
            f"{steep:.0%} of the outside has a draft below {settings.draft / deg:g}°: use a release agent, or draw it "
            "with a draft."
        )
    if parting.undercut > SLOPE:
        lines.append(f"Undercuts of {parting.undercut:.2g} mm² hold the halves back; peel the rubber off them.")
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
    return tuple(lines)
