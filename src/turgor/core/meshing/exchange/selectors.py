"""Selectors for the sides and cells of a mesh: those of CAD files (`turgor.core.geometry.cad.selectors`)."""

from collections.abc import Sequence
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from turgor.core.geometry.cad.selectors import SLACK, ByColor, ByName, InBox, NearestTo, Selector, WithNormal
from turgor.core.geometry.shapes.tolerances import TOLERANCE
from turgor.core.meshing.exchange.boundary import Sides
from turgor.core.meshing.exchange.formats.raw import Array, Ints
from turgor.core.meshing.exchange.node_selectors import ByNodes, BySides
from turgor.core.meshing.quality.settings import FACING
from turgor.foundation.errors import TurgorError

Mask = NDArray[np.bool_]

#: What `read_mesh` takes for a name: a name in the file, a selector, or several selectors that must all hold.
Choice: TypeAlias = str | Selector | ByNodes | BySides | Sequence[Selector | ByNodes | BySides]


def parts_of(choice: Choice) -> tuple[str | None, tuple[Selector | ByNodes | BySides, ...]]:
    """Split a choice into a name of the file and selectors by place; one of them is empty.

    Parameters
    ----------
    choice : Choice

    Returns
    -------
    name : str or None
    selectors : tuple of Selector

    Raises
    ------
    TurgorError
        If a name stands among other selectors.
    """
    if isinstance(choice, str):
        return choice, ()
    parts: tuple[Selector | ByNodes | BySides, ...]
    if isinstance(choice, ByName | ByColor | NearestTo | InBox | WithNormal | ByNodes | BySides):
        parts = (choice,)
    else:
        parts = tuple(choice)
    names = [part.name for part in parts if isinstance(part, ByName)]
    if names and len(parts) > 1:
        raise TurgorError(f"the name '{names[0]}' of a group cannot be combined with other selectors.")
    return (names[0], ()) if names else (None, parts)


def picked_sides(selectors: Sequence[Selector], sides: Sides, rows: Ints) -> Ints:
    """Find the sides to which all selectors apply.

    A box picks the sides wholly in it; a normal the plane sides that look in its direction and lie furthest out; a
    point the side nearest to it and all sides that continue it smoothly.

    Parameters
    ----------
    selectors : sequence of Selector
    sides : Sides
    rows : (f,) int array
        Sides to choose from.

    Returns
    -------
    int array
        Some of ``rows``.
    """
    mask = np.ones(len(rows), dtype=bool)
    for selector in selectors:
        mask &= _side_mask(selector, sides, rows)
    return rows[mask]


def _side_mask(selector: Selector, sides: Sides, rows: Ints) -> Mask:
    positions, normals = sides.positions[rows], sides.normals[rows]
    match selector:
        case InBox(low, high):
            inside = (positions >= np.array(low) - SLACK) & (positions <= np.array(high) + SLACK)
            return np.asarray(inside.all(axis=(1, 2)))
        case WithNormal(normal):
            looking = normals @ np.array(normal) >= TOLERANCE.direction
            depth = positions.mean(axis=1) @ np.array(normal)
            furthest = depth[looking].max(initial=-np.inf) - 1e-6 * float(np.ptp(positions.reshape(-1, 3)))
            return np.asarray(looking & (depth >= furthest))
        case NearestTo(point):
            start = int(np.linalg.norm(positions.mean(axis=1) - point, axis=1).argmin())
            return _smooth_part(sides, rows, normals, start)
    raise TurgorError(f"{type(selector).__name__} is for CAD files; mesh files have no colors.")


def _smooth_part(sides: Sides, rows: Ints, normals: Array, start: int) -> Mask:
    """The sides that continue one side over smooth edges."""
    pairs = np.array(sides.kind.side.edges)
    edges = np.sort(sides.nodes[rows][:, pairs], axis=2).reshape(-1, 2)
    owner = np.repeat(np.arange(len(rows)), len(pairs))
    order = np.lexsort(edges.T)
    same = np.flatnonzero((edges[order][1:] == edges[order][:-1]).all(axis=1))
    left, right = owner[order[same]], owner[order[same + 1]]
    smooth = np.einsum("ei,ei->e", normals[left], normals[right]) > FACING.continued
    left, right = left[smooth], right[smooth]
    mask = np.zeros(len(rows), dtype=bool)
    mask[start] = True
    while True:
        grown = mask.copy()
        grown[right[mask[left]]] = grown[left[mask[right]]] = True
        if (grown == mask).all():
            return mask
        mask = grown


def picked_cells(selectors: Sequence[Selector | ByNodes | BySides], centers: Array) -> Ints:
    """Find the cells whose centers (c, 3) lie in all boxes; other selectors do not mean cells."""
    mask = np.ones(len(centers), dtype=bool)
    for selector in selectors:
        if not isinstance(selector, InBox):
            raise TurgorError(
                f"{type(selector).__name__} does not mean cells; regions are groups of the file or boxes."
            )
        mask &= ((centers >= np.array(selector.low)) & (centers <= np.array(selector.high))).all(axis=1)
    return np.flatnonzero(mask)
