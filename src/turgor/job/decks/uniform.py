"""Uniform tractions that a deck states as forces on nodes.

Cells of turgor have nodes in the middle of their sides that those of a deck lack. Forces that were spread over the
nodes of a deck for a uniform traction would then be another traction, so they are recognized and become a force on the
face.
"""

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from turgor.core.meshing.exchange.formats.raw import KINDS
from turgor.core.meshing.exchange.splitting import EDGES
from turgor.job.decks.deck import ROUND, Deck, sides_of

Array = NDArray[np.float64]

#: Shares of the corners and of the mid-side nodes in the force of a uniform traction, by corners and order of a side:
#: integrals of the shape functions over a flat side.
_SHARES = {
    (2, 1): (1 / 2, 0.0),
    (2, 2): (1 / 6, 2 / 3),
    (3, 1): (1 / 3, 0.0),
    (3, 2): (0.0, 1 / 3),
    (4, 1): (1 / 4, 0.0),
    (4, 2): (-1 / 12, 1 / 3),
}

#: Largest difference from a uniform traction, relative to the largest force: decks round these forces.
ROUNDED = 1e-3


def uniform_sides(deck: Deck, forces: Mapping[int, Array]) -> tuple[tuple[int, str], ...]:
    """Return the sides over which forces on nodes are a uniform traction; none where they are not.

    Parameters
    ----------
    deck : Deck
    forces : mapping of int to (3,) array
        Force on each node, all with one history.
    """
    if len(forces) < len(deck.freedoms) or deck.plane == ROUND:
        return ()
    sides, expected = [], dict.fromkeys(forces, 0.0)
    area = 0.0
    for cell, label, shares in _outer(deck):
        if all(node in forces for node, share in shares.items() if share):
            size = _area(deck, list(shares))
            area += size
            sides.append((cell, label))
            for node, share in shares.items():
                expected[node] = expected.get(node, 0.0) + share * size
    if not area:
        return ()
    traction = np.sum(list(forces.values()), axis=0) / area
    largest = max(float(np.linalg.norm(force)) for force in forces.values())
    zero = np.zeros(3)
    off = [np.linalg.norm(forces.get(node, zero) - share * traction) for node, share in expected.items()]
    return tuple(sides) if max(off) <= ROUNDED * largest else ()


def _outer(deck: Deck) -> list[tuple[int, str, dict[int, float]]]:
    """Outer sides of all cells: number of the cell, label, share of each node with the corners first."""
    outer = {tuple(sorted(side)) for sides in deck.outer_sides for side in sides.tolist()}
    rows_of: list[tuple[int, str, dict[int, float]]] = []
    for kind, rows in deck.solids.items():
        corners = KINDS[kind].corners
        between = sides_of(kind) if deck.plane else EDGES[kind.rstrip("0123456789")]
        edges = {frozenset(edge): corners + k for k, edge in enumerate(between)}
        order = 2 if KINDS[kind].nodes > corners else 1
        for number, side in enumerate(sides_of(kind), start=1):
            at_corner, at_middle = _SHARES[len(side), order]
            pairs = [(side[0], side[1])] if deck.plane else list(zip(side, (*side[1:], side[0]), strict=True))
            middles = [edges[frozenset(pair)] for pair in pairs] if order == 2 else []
            for cell, *nodes in rows.tolist():
                if tuple(sorted(nodes[i] for i in side)) in outer:
                    shares = {nodes[i]: at_corner for i in side} | {nodes[i]: at_middle for i in middles}
                    rows_of.append((cell, f"S{number}", shares))
    return rows_of


def _area(deck: Deck, nodes: list[int]) -> float:
    """Area of a flat side from its corners, which stand first: three, or four; of plane cells the length of an edge."""
    if deck.plane:
        return float(np.linalg.norm(np.subtract(deck.place[nodes[1]], deck.place[nodes[0]])))
    count = 3 if len(nodes) in (3, 6) else 4
    points = np.array([deck.place[node] for node in nodes[:count]])
    one, other = points[2] - points[0], points[-1] - points[1]
    return 0.5 * float(np.linalg.norm(np.cross(one, other if count == 4 else points[1] - points[0])))
