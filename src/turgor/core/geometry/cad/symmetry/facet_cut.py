"""Mirror planes of a part that is given by facets, and its half: facets are clipped, and a plane cap closes the cut."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from manifold3d import triangulate
from numpy.typing import NDArray

from turgor.core.geometry.cad.part import Part
from turgor.core.geometry.cad.surface.part import surface_facets, surface_items
from turgor.core.geometry.cad.surface.repair import manifold
from turgor.core.geometry.cad.surface.shape import SurfaceFace, SurfaceShape
from turgor.core.geometry.cad.symmetry.find import MirrorPlane, PartSymmetry
from turgor.core.geometry.cad.symmetry.settings import SYMMETRY
from turgor.core.geometry.shapes.tolerances import TOLERANCE
from turgor.foundation.errors import TurgorError

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


def facet_symmetry(part: Part, names: Sequence[str]) -> PartSymmetry:
    """Find the mirror planes across x, y and z through the middle of a part that is given by facets.

    Parameters
    ----------
    part : Part
        Whose shape is a `SurfaceShape`.
    names : sequence of str
        Name of each of its faces.

    Returns
    -------
    PartSymmetry
        No turns are looked for, and nothing is found where facets cut through each other so that they enclose no body.
    """
    shape: SurfaceShape = part.shape
    try:
        body = manifold(shape.points, shape.triangles, part.path.name)
    except TurgorError:
        return PartSymmetry(mirrors=(), axis="", fold=1, center=(0.0, 0.0, 0.0))
    low, high = shape.points.min(axis=0), shape.points.max(axis=0)
    middle = (low + high) / 2
    middle[np.abs(middle) < TOLERANCE.round_off * (high - low).max()] = 0.0
    mirrors = []
    for axis, letter in enumerate("xyz"):
        flip = np.eye(3)[axis]
        image = body.translate(-middle).mirror(flip).translate(middle)
        if (body - image).volume() > SYMMETRY.same * body.volume():
            continue
        joined = _joined(shape, names, axis, float(middle[axis]))
        if joined is not None:
            mirrors.append(MirrorPlane(normal=letter, position=float(middle[axis]), joined=joined))
    x, y, z = (float(value) for value in middle)
    return PartSymmetry(mirrors=tuple(mirrors), axis="", fold=1, center=(x, y, z))


def facet_half(part: Part, names: Sequence[str], plane: MirrorPlane) -> tuple[Part, tuple[str, ...]]:
    """The side of a part above a plane, with the names of its faces; that in the plane is named after it.

    Parameters
    ----------
    part : Part
        Whose shape is a `SurfaceShape`.
    names : sequence of str
        Name of each of its faces.
    plane : MirrorPlane

    Raises
    ------
    TurgorError
        If the cut touches itself, so that no cap closes it.
    """
    shape: SurfaceShape = part.shape
    axis = "xyz".index(plane.normal)
    points, triangles, face = _clipped(shape, axis, plane.position)
    cap = _cap(points, triangles, axis, str(part.path))
    numbers, face = np.unique(np.append(face, np.full(len(cap), len(names))), return_inverse=True)
    triangles = np.concatenate([triangles, cap])
    named = [*names, f"symmetry_{plane.normal}"]
    own = tuple(named[number] for number in numbers)
    used, places = np.unique(triangles, return_inverse=True)
    half = SurfaceShape(points=points[used], triangles=places.reshape(-1, 3).astype(np.int64), face=face, faces=())
    areas = np.bincount(face, weights=np.linalg.norm(half.vector_areas, axis=1))
    half = replace(half, faces=tuple(SurfaceFace(name=n, mass=float(a)) for n, a in zip(own, areas, strict=True)))
    items = tuple(replace(item, name=name) for item, name in zip(surface_items(half), own, strict=True))
    facets, owners = surface_facets(half), (part.regions,) * len(own)
    return replace(part, shape=half, faces=list(half.faces), facets=facets, items=items, owners=owners), own


def _joined(shape: SurfaceShape, names: Sequence[str], axis: int, at: float) -> tuple[tuple[str, str], ...] | None:
    """Pairs of names that a plane maps onto each other; None where a face has no image."""
    areas = np.linalg.norm(shape.vector_areas, axis=1)
    points, triangles, face = _clipped(shape, axis, at)
    one, two = (points[triangles[:, i]] - points[triangles[:, 0]] for i in (1, 2))
    above = np.linalg.norm(np.cross(one, two), axis=1) / 2
    sides = {}
    for name in dict.fromkeys(names):
        own = [number for number, each in enumerate(names) if each == name]
        whole, high = areas[np.isin(shape.face, own)].sum(), above[np.isin(face, own)].sum()
        sides[name] = (high, whole - high)
    uneven = {n: s for n, s in sides.items() if abs(s[0] - s[1]) > SYMMETRY.alike * sum(s)}
    pairs = set()
    for name, (high, low) in uneven.items():
        image = next(
            (
                n
                for n, (h, w) in uneven.items()
                if n != name and max(abs(h - low), abs(w - high)) < SYMMETRY.alike * (h + w)
            ),
            None,
        )
        if image is None:
            return None
        first, second = sorted((name, image))
        pairs.add((first, second))
    return tuple(sorted(pairs))


def _clipped(shape: SurfaceShape, axis: int, at: float) -> tuple[Array, Ints, Ints]:
    """Points, triangles above a plane, and their faces; triangles that cross the plane are cut."""
    points = shape.points.copy()
    away = points[:, axis] - at
    away[np.abs(away) < TOLERANCE.round_off * float(np.ptp(points, axis=0).max())] = 0.0
    points[away == 0.0, axis] = at
    side = np.sign(away)[shape.triangles]
    above = (side >= 0).all(axis=1) & (side > 0).any(axis=1)
    triangles, face = shape.triangles[above].tolist(), shape.face[above].tolist()
    places: dict[tuple[int, int], int] = {}
    new: list[Array] = []
    for number in np.flatnonzero((side > 0).any(axis=1) & (side < 0).any(axis=1)):
        corners = shape.triangles[number].tolist()
        rim: list[int] = []
        for a, b in zip(corners, [*corners[1:], corners[0]], strict=True):
            if away[a] >= 0:
                rim.append(a)
            if away[a] * away[b] < 0:
                key = (min(a, b), max(a, b))
                if key not in places:
                    places[key] = len(points) + len(new)
                    share = away[key[0]] / (away[key[0]] - away[key[1]])
                    cut = points[key[0]] + share * (points[key[1]] - points[key[0]])
                    cut[axis] = at
                    new.append(cut)
                rim.append(places[key])
        triangles += [[rim[0], rim[i], rim[i + 1]] for i in range(1, len(rim) - 1)]
        face += [int(shape.face[number])] * (len(rim) - 2)
    grown = np.concatenate([points, np.array(new).reshape(-1, 3)])
    return grown, np.array(triangles, dtype=np.int64), np.array(face, dtype=np.int64)


def _cap(points: Array, triangles: Ints, axis: int, name: str) -> Ints:
    """Triangles that close the cut, looking against the axis."""
    edges = triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
    count = len(points)
    free = edges[~np.isin(edges[:, 0] * count + edges[:, 1], edges[:, 1] * count + edges[:, 0])]
    after = {b: a for a, b in free.tolist()}  # the cap goes along these edges the other way
    if len(after) < len(free):
        raise TurgorError(
            f"symmetry: where '{name}' is cut at a mirror plane, the rims of its walls touch each other; model the "
            "whole of it, or cut it where it was made and name the cut symmetry_x, symmetry_y or symmetry_z."
        )
    loops, remaining = [], set(after)
    while remaining:
        loop = [min(remaining)]
        while after[loop[-1]] != loop[0]:
            loop.append(after[loop[-1]])
        remaining -= set(loop)
        loops.append(loop)
    flat = points[:, [(axis + 2) % 3, (axis + 1) % 3]]
    triangles_of_cap = triangulate([np.ascontiguousarray(flat[loop]) for loop in loops])
    return np.concatenate([np.array(loop) for loop in loops])[np.asarray(triangles_of_cap, dtype=np.int64)]
