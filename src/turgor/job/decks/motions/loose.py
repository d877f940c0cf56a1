"""Loose bodies of a deck: supports leave them free, and contact alone stops them."""

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from turgor.job.decks.deck import ROUND, Deck
from turgor.job.decks.directions import NodeAxes
from turgor.job.decks.parts import stays_apart
from turgor.job.decks.steps import Path
from turgor.job.decks.tracks import SHIFT

Array = NDArray[np.float64]

#: Smallest singular value, over the largest, of the supported parts of rigid motions that counts as support.
SUPPORTED = 1e-6


def has_loose_body(path: Path, axes: NodeAxes) -> bool:
    """Whether the supports leave a rigid motion of a body free.

    Parameters
    ----------
    path : Path
        What the deck fixes and moves.
    axes : NodeAxes
        Directions of the degrees of freedom.
    """
    deck = path.deck
    shifted = {target[1:] for target in path.tracks.of if isinstance(target, tuple) and target[0] == SHIFT}
    supported: dict[int, list[int]] = {}
    for node, freedom in (*path.fixed, *shifted):
        supported.setdefault(int(node), []).append(int(freedom))
    return any(_is_loose(deck, axes, supported, nodes.tolist()) for nodes in _bodies(deck))


def _bodies(deck: Deck) -> Iterable[NDArray[np.int64]]:
    """Nodes of each body: cells that share nodes, or nodes at one place where a mesh file makes them one."""
    nodes = deck.solid_nodes
    own = np.arange(len(nodes), dtype=np.float64)[:, None]
    points = own if stays_apart(deck) else np.round([deck.place[node] for node in nodes.tolist()], 9)
    _, place = np.unique(points, axis=0, return_inverse=True)
    pairs = [
        np.stack([np.repeat(rows[:, 1], rows.shape[1] - 1), rows[:, 1:].ravel()], axis=1)
        for rows in deck.solids.values()
    ]
    first, second = place.ravel()[np.searchsorted(nodes, np.concatenate(pairs))].T
    count = int(place.max()) + 1
    _, label = connected_components(coo_array((np.ones(len(first)), (first, second)), shape=(count, count)))
    return (nodes[label[place.ravel()] == k] for k in range(int(label.max()) + 1))


def _is_loose(deck: Deck, axes: NodeAxes, supported: dict[int, list[int]], nodes: list[int]) -> bool:
    points = np.array([deck.place[node] for node in nodes])
    center, size = points.mean(axis=0), float(np.ptp(points, axis=0).max())
    rows = [
        _row(axes.at(node)[freedom - 1], (np.array(deck.place[node]) - center) / size)
        for node in nodes
        for freedom in supported.get(node, ())
    ]
    motions = {ROUND: [1], "": [0, 1, 2, 3, 4, 5]}.get(deck.plane, [0, 1, 5])
    if not rows:
        return True
    values = np.linalg.svd(np.array(rows)[:, motions], compute_uv=False)
    return len(values) < len(motions) or bool(values[-1] < SUPPORTED * values[0])


def _row(direction: Array, arm: Array) -> Array:
    """What a support sees of three shifts and three turns."""
    return np.concatenate([direction, np.cross(arm, direction)])
