"""Marks of a model: where supports and loads act, of which kind, and along which direction; a few for each."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from turgor.core.geometry.cad.symmetry.whole import Image
from turgor.core.meshing.mesh import Mesh
from turgor.core.model.loads.hydrostatic_pressure import HydrostaticPressure
from turgor.core.model.model import Model
from turgor.core.model.places import NodesAt
from turgor.core.model.supports.support import Support
from turgor.core.results.fields.state_fields import StateFields
from turgor.views.pictures.settings import MARKS

Array = NDArray[np.float64]
#: Kind, points (k, 3) [m] of the modeled part, and a direction (k, 3) at each of them; its length does not count.
Row: TypeAlias = tuple[str, Array, Array]

#: Kinds of marks. A roller stands for one direction along which nothing moves.
FIXED, ROLLER, SPRING, MOVED, FORCE, MOMENT = "fixed", "roller", "spring", "moved", "force", "moment"
#: Where a liquid has no pressure of its own; its direction is upwards.
LEVEL = "level"


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Mark:
    """A mark of a support or a load.

    Parameters
    ----------
    kind : str
        ``"fixed"``, ``"roller"``, ``"spring"``, ``"moved"``, ``"force"``, ``"moment"`` or ``"level"``.
    place : (3,) array [m]
        Point of the whole actuator at rest.
    direction : (3,) array
        Unit vector; zero for ``"fixed"``.
    """

    kind: str
    place: Array
    direction: Array


def marks_of(at: StateFields) -> tuple[Mark, ...]:
    """List the marks of the supports and loads of a state, at rest and on all images of the modeled part.

    Mirror planes, pressures and what acts on whole bodies, such as gravity, have none; of a liquid its level is shown.

    Parameters
    ----------
    at : StateFields
    """
    mesh, images = at.mesh, at.facts.images
    size = float(np.ptp(mesh.points, axis=0).max())
    marks: list[Mark] = []
    for kind, points, directions in _rows(at.model, images):
        whole = np.concatenate([image.of(points) for image in images])
        turned = np.concatenate([directions @ image.turn.T for image in images])
        for row in _spread(whole, MARKS.apart * size):
            length = np.linalg.norm(turned[row])
            marks.append(Mark(kind=kind, place=whole[row], direction=turned[row] / (length or 1.0)))
    return tuple(marks)


def _rows(model: Model, images: Sequence[Image]) -> Iterator[Row]:
    for support in model.supports:
        yield from _of_support(model, support, images)
    for name, point in model.points.items():
        place = _points_at(model, name, images)
        yield from ((SPRING, place, np.eye(3)[[axis]]) for axis in range(3) if point.stiffness[axis])
    for load in model.loads:
        if load.arrow is not None and load.spot and any(load.arrow):
            place = _points_at(model, load.spot, images)
            moment = load.turning is not None and load.turning.is_moment
            yield MOMENT if moment else FORCE, place, np.tile(np.array(load.arrow, dtype=float), (len(place), 1))
        if load.liquid is not None:
            yield from _of_liquid(model.mesh, load.liquid, images)


def _of_liquid(mesh: Mesh, liquid: HydrostaticPressure, images: Sequence[Image]) -> Iterator[Row]:
    """The level of a liquid: in the middle of a cavity, next to the two ends of a body; none far from what it wets."""
    down = np.array(liquid.direction)
    up = -down / np.linalg.norm(down)
    nodes = mesh.points[mesh.face_nodes(liquid.face)]
    wet = np.concatenate([image.of(nodes) for image in images])
    heights, extents = wet @ up, np.ptp(wet, axis=0)
    if not -MARKS.apart <= (liquid.level - heights.min()) / (np.ptp(heights) or 1.0) <= 1 + MARKS.apart:
        return
    middle = wet.mean(axis=0)
    middle += (liquid.level - middle @ up) * up
    along = np.eye(3)[np.argmax(extents * (1 - up**2))]
    aside = (0.5 + MARKS.aside) * (along @ extents)
    places = middle + np.outer([-aside, aside] if liquid.free_surface else [0.0], along)
    yield LEVEL, places, np.tile(up, (len(places), 1))


def _of_support(model: Model, support: Support, images: Sequence[Image]) -> Iterator[Row]:
    mesh, (place, letters) = model.mesh, support.prescribed
    normals = support.normals(mesh)
    if any(support.bedding):
        nodes, outward = _normals(mesh, support.place)
        yield SPRING, mesh.points[nodes], outward
    if not (support.moves or letters or normals):
        return
    points = _points_at(model, place, images) if place in model.points else mesh.points[support.nodes(mesh)]
    moved = _largest_move(mesh, support, points) if support.moves else np.zeros_like(points)
    if moved.any():
        yield MOVED, points, moved
    elif normals is not None:
        yield ROLLER, mesh.points[normals[0]], normals[1]
    elif set(letters) == set("xyz"):
        yield FIXED, points, moved
    else:
        yield from ((ROLLER, points, np.tile(np.eye(3)["xyz".index(each)], (len(points), 1))) for each in letters)


def _largest_move(mesh: Mesh, support: Support, points: Array) -> Array:
    """Prescribed displacement (k, 3) [m] where it is largest on the way: what returns was moved, too."""
    free = [axis for axis in range(3) if support.prescribed[1] and axis not in support.components(mesh)]
    ways = [support.displacement(points, factor) for factor in np.linspace(0, 1, MARKS.factors)[1:]]
    largest = np.array(max(ways, key=lambda way: float(np.abs(np.delete(way, free, axis=1)).max())))
    largest[:, free] = 0.0
    return largest


def _points_at(model: Model, spot: str | NodesAt | tuple[float, float, float], images: Sequence[Image]) -> Array:
    """Points (k, 3) [m] of a face, a place, a reference point or a point."""
    mesh = model.mesh
    if isinstance(spot, NodesAt):
        return mesh.points[spot.nodes(mesh)]
    if not isinstance(spot, str):
        return np.array([spot], dtype=np.float64)
    if spot not in model.points:
        return mesh.points[mesh.face_nodes(spot)]
    point = model.points[spot]
    if point.at is not None:
        return np.array([point.at])
    nodes = mesh.points[mesh.face_nodes(point.face)]
    return np.mean([image.of(nodes).mean(axis=0) for image in images], axis=0, keepdims=True)


def _normals(mesh: Mesh, face: str) -> tuple[NDArray[np.int64], Array]:
    """Nodes of a face that are corners of its sides, and the normals there, out of the body."""
    sides = mesh.face(face)
    a, b, c = (mesh.points[sides[:, k]] for k in range(3))
    sums = np.zeros_like(mesh.points)
    for k in range(3):
        np.add.at(sums, sides[:, k], np.cross(b - a, c - a))
    nodes = np.unique(sides[:, :3])
    return nodes, sums[nodes]


def _spread(points: Array, apart: float) -> list[int]:
    """Rows of a few points, at least ``apart`` [m] from each other, the corners of what they are spread over first."""
    outside = np.linalg.norm(points - points.mean(axis=0), axis=1)
    rows, distance = [int(outside.argmax())], np.full(len(points), np.inf)
    while len(rows) < MARKS.most:
        distance = np.minimum(distance, np.linalg.norm(points - points[rows[-1]], axis=1))
        if distance.max() <= apart:
            break
        rows.append(int(np.where(distance > apart, distance + outside / 2, 0.0).argmax()))
    return rows
