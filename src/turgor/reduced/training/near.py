"""Near points: which points of a surface ever came near something along the training paths."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.contact.pair_part import PairPart, Partners
from turgor.core.engine.contact.part import Gaps
from turgor.core.engine.contact.shape_part import ShapePart
from turgor.core.engine.system import System
from turgor.reduced.parts.touching import Facing, Touching
from turgor.reduced.settings import SAMPLING

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


def near_points(system: System, displacements: Sequence[Array]) -> list[Near]:
    """Find the points of each part of contact that came near something in states, given by scaled displacements (n, 3).

    Returns
    -------
    list of Near
    """
    every: list[list[Ints]] = [[] for _ in system.contact.parts]
    for displacement in displacements:
        position = system.points + displacement
        for part, seen in zip(system.contact.parts, every, strict=True):
            gaps = part.look(position, np.zeros(3))
            seen.append(_near(part, gaps))
    out = []
    for seen in every:
        rows, count = np.unique(np.concatenate([np.zeros((0, 3), dtype=np.int64), *seen]), axis=0, return_counts=True)
        points, place = np.unique(rows[:, :2], axis=0, return_inverse=True)
        order = np.lexsort((-count, place.ravel()))
        out.append(Near(points, np.column_stack([place.ravel(), rows[:, 2]])[order]))
    return out


def _near(part: PairPart | ShapePart, gaps: Gaps) -> Ints:
    """Side, quadrature point and partner (k, 3) of the points that are near."""
    where = np.argwhere(gaps.gap < SAMPLING.near * part.surface.height[:, None])
    return np.column_stack([where, gaps.partner[where[:, 0], where[:, 1]]])


def contact_parts(system: System, near: Sequence[Near], vectors: Array) -> tuple[Touching | Facing, ...]:
    """Make the reduced parts of contact of the points that came near, for modes (3 n, r).

    Their stiffness is that of the system at present: the largest that the training needed.
    """
    modes = vectors.reshape(system.node_count, 3, -1)
    out: list[Touching | Facing] = []
    for part, here in zip(system.contact.parts, near, strict=True):
        if not len(here.points):
            continue
        out.append(
            _touching(system, part, here, modes) if isinstance(part, PairPart) else _facing(system, part, here, modes)
        )
    return tuple(out)


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
    every = np.concatenate([surface.sides[side], partners.sides[used]])
    nodes, numbers = np.unique(every, return_inverse=True)
    numbers = numbers.reshape(every.shape)
    scale = part.penalty_scale[side]
    return Touching(
        rest=system.points[nodes],
        modes=np.ascontiguousarray(modes[nodes]),
        points=np.ascontiguousarray(numbers[: len(side)]),
        shape=np.ascontiguousarray(surface.N[q]),
        springs=surface.spring[side],
        areas=part.share * scale * surface.weights[side, q],
        sides=np.ascontiguousarray(numbers[len(side) :]),
        side_springs=surface.spring[used],
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
    more = more[~np.isin(side[more[:, 0]] * sides + more[:, 1], strange)]
    both = np.concatenate([pairs, more])
    _, place = np.unique(both, axis=0, return_index=True)
    first = both[np.sort(place)]
    return np.asarray(first[np.argsort(first[:, 0], kind="stable")])
