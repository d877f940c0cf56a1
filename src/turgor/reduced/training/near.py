"""Near points: which points of a surface ever came near something along the training paths."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.contact.pair_part import PairPart, Partners
from turgor.core.engine.contact.part import Gaps
from turgor.core.engine.contact.settings import PENALTY
from turgor.core.engine.contact.shape_part import ShapePart
from turgor.core.engine.system import System
from turgor.core.model.obstacles.pose import Pose
from turgor.core.results.fields.state_fields import MeshFacts
from turgor.reduced.parts.obstacles import Body, Obstructing, Shaped
from turgor.reduced.parts.touching import Facing, Touching
from turgor.reduced.settings import SAMPLING
from turgor.reduced.training.places import Place

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, slots=True, eq=False)
class Near:
    """Points of one part of contact that came near.

    Parameters
    ----------
    points : (k, 2) int array
        Side and quadrature point.
    pairs : (c, 2) int array
        Place of a point among these, and a side that was near it; empty for planes.
    """

    points: Ints
    pairs: Ints


def near_points(
    system: System, displacements: Sequence[Array], inputs: Sequence[Array], places: Mapping[str, Place]
) -> list[Near]:
    """Find the points of each part of contact that came near something in states.

    Parameters
    ----------
    system : System
    displacements : sequence of (n, 3) arrays
        Scaled.
    inputs : sequence of (1 + n,) arrays
    places : mapping of str to Place
        Of the obstacles.

    Returns
    -------
    list of Near
    """
    every: list[list[Ints]] = [[] for _ in system.contact.parts]
    for displacement, values in zip(displacements, inputs, strict=True):
        position = system.points.copy()
        position[: len(displacement)] += displacement
        for part, seen in zip(system.contact.parts, every, strict=True):
            where = np.zeros(3) if part.obstacle is None else places[part.name].at(values)
            seen.append(_near(part, part.look(position, Pose(where))))
    out = []
    for seen in every:
        rows, count = np.unique(np.concatenate([np.zeros((0, 3), dtype=np.int64), *seen]), axis=0, return_counts=True)
        points, place = np.unique(rows[:, :2], axis=0, return_inverse=True)
        order = np.lexsort((-count, place.ravel()))
        out.append(Near(points, np.column_stack([place.ravel(), rows[:, 2]])[order]))
    return out


def _near(part: PairPart | ShapePart, gaps: Gaps) -> Ints:
    """Side, quadrature point and partner (k, 3) of the points that are near."""
    near = SAMPLING.near if part.obstacle is None else SAMPLING.near_obstacles
    where = np.argwhere(gaps.gap < near * part.surface.height[:, None])
    return np.column_stack([where, gaps.partner[where[:, 0], where[:, 1]]])


def contact_parts(
    system: System, near: Sequence[Near], vectors: Array, places: Mapping[str, Place]
) -> tuple[tuple[Touching | Facing, ...], tuple[Obstructing, ...]]:
    """Make the reduced parts of contact of the points that came near, for modes (3 n, r), and the obstacles.

    Their stiffness is that of the system at present: the largest that the training needed.
    """
    modes = vectors.reshape(system.node_count, 3, -1)
    own: list[Touching | Facing] = []
    obstacles: list[Obstructing] = []
    facts, force = MeshFacts(system.model.mesh), system.stress_scale * system.length**2
    whole = force * system.model.mesh.symmetry_factor * facts.of_whole(np.eye(3)).T
    for part, here in zip(system.contact.parts, near, strict=True):
        if not len(here.points):
            continue
        if part.obstacle is None:
            own.append(_own(system, part, here, modes))
            continue
        place, moved = places[part.name], with_body(modes)
        body: Body = (
            _touching(system, part, here, moved) if isinstance(part, PairPart) else _shaped(system, part, here, moved)
        )
        obstacles.append(Obstructing(part.name, body, place.origin, place.by_inputs, whole))
    return tuple(own), tuple(obstacles)


def _own(system: System, part: PairPart | ShapePart, near: Near, modes: Array) -> Touching | Facing:
    """Contact of the actuator with itself, or with its image in a mirror plane."""
    return _touching(system, part, near, modes) if isinstance(part, PairPart) else _facing(system, part, near, modes)


def with_body(modes: Array) -> Array:
    """Modes (n, 3, r), and those (n, 3, 3) of the translation of a body, which moves no node of the mesh."""
    return np.concatenate([modes, np.zeros((len(modes), 3, 3))], axis=2)


def _shaped(system: System, part: ShapePart, near: Near, modes: Array) -> Shaped:
    """Points before a shape with a formula; they move against the body's translation."""
    side, q = near.points.T
    nodes, N = part.surface.sides[side], part.surface.N[q]
    x, moved = np.einsum("ka,kai->ki", N, system.points[nodes]), np.einsum("ka,kair->kir", N, modes[nodes])
    moved[:, :, -3:] -= np.eye(3)
    stiff = part.surface.spring[side] * part.penalty_scale[side] * part.surface.weights[side, q]
    return Shaped(x, np.ascontiguousarray(moved), stiff, PENALTY.deeper * part.surface.height[side], part.shape)


def _facing(system: System, part: ShapePart, near: Near, modes: Array) -> Facing:
    """Points before a plane."""
    side, q = near.points.T
    nodes, N = part.surface.sides[side], part.surface.N[q]
    x = np.einsum("ka,kai->ki", N, system.points[nodes])
    gap, normal, _ = part.shape.signed_distance(x)
    slopes = np.einsum("ka,ki,kair->kr", N, normal, modes[nodes], optimize=True)
    stiff = part.surface.spring[side] * part.penalty_scale[side] * part.surface.weights[side, q]
    return Facing(gap, slopes, stiff)


def _touching(system: System, part: PairPart, near: Near, modes: Array) -> Touching:
    """Points before sides, and sides around those that they met."""
    surface, partners = part.surface, part.partners
    side, q = near.points.T
    pairs = _with_neighbors(near.pairs, side, partners)
    used, place = np.unique(pairs[:, 1], return_inverse=True)
    mine, theirs = surface.sides[side], partners.sides[used]
    nodes, numbers = np.unique(np.concatenate([mine.ravel(), theirs.ravel()]), return_inverse=True)
    numbers = numbers.ravel()
    points, side_springs = system.points, surface.spring
    if part.rigid is not None:  # its nodes follow those of the mesh, and it has no spring of its own
        translation = np.zeros((len(part.rigid.points), 3, modes.shape[2]))
        translation[:, :, -3:] = np.eye(3)
        points, modes = np.vstack([points, part.rigid.points]), np.concatenate([modes, translation])
        side_springs = np.full(len(partners.sides), np.inf)
    scale = part.penalty_scale[side]
    return Touching(
        rest=points[nodes],
        modes=np.ascontiguousarray(modes[nodes]),
        points=np.ascontiguousarray(numbers[: mine.size].reshape(mine.shape)),
        shape=np.ascontiguousarray(surface.N[q]),
        springs=surface.spring[side],
        areas=part.share * scale * surface.weights[side, q],
        sides=np.ascontiguousarray(numbers[mine.size :].reshape(theirs.shape)),
        side_springs=side_springs[used],
        depth=partners.depth[used],
        overhang=partners.overhang[used],
        candidates=(np.searchsorted(pairs[:, 0], np.arange(len(side) + 1)), place.ravel().astype(np.int64)),
    )


def _with_neighbors(pairs: Ints, side: Ints, partners: Partners) -> Ints:
    """Pairs of points and sides, then the sides around these that the point may touch; those that it met come first.

    ``side`` (k,) is the side of each point.
    """
    start, listed = partners.around
    count = start[pairs[:, 1] + 1] - start[pairs[:, 1]]
    rows = np.repeat(pairs[:, 0], count)
    at = np.arange(count.sum()) - np.repeat(np.cumsum(count) - count, count) + np.repeat(start[pairs[:, 1]], count)
    more = np.column_stack([rows, listed[at]])
    first, never = partners.strangers
    sides = len(partners.sides)
    strange = np.repeat(np.arange(len(first) - 1), np.diff(first)) * sides + never
    exception = np.isin(side[more[:, 0]] * sides + more[:, 1], strange)
    opened = np.ones(sides, dtype=bool) if partners.open is None else partners.open
    more = more[exception != (opened[side[more[:, 0]]] & opened[more[:, 1]])]
    both = np.concatenate([pairs, more])
    _, place = np.unique(both, axis=0, return_index=True)
    first = both[np.sort(place)]
    return np.asarray(first[np.argsort(first[:, 0], kind="stable")])
