"""Directions of a node: x, y and z, or those of a ``*TRANSFORM``."""

from collections.abc import Iterable
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from turgor.core.meshing.exchange.formats.abaqus import Keyword
from turgor.core.meshing.exchange.formats.raw import numbers
from turgor.job.decks.account import Account
from turgor.job.decks.deck import Deck

Array = NDArray[np.float64]

#: Distance from the axis, over the distance of its two points, within which a node has no radial direction.
ON_AXIS = 1e-9


@dataclass(slots=True)
class NodeAxes:
    """Directions in which the degrees of freedom of nodes count, by their numbers."""

    deck: Deck
    of: dict[int, tuple[str, Array, Array]] = field(default_factory=dict)

    def at(self, node: int) -> Array:
        """Three directions (3, 3) of one node, a row for each degree of freedom."""
        if node not in self.of:
            return np.eye(3)
        kind, a, b = self.of[node]
        if kind == "R":
            first = a / np.linalg.norm(a)
            third = np.cross(first, b)
            third /= np.linalg.norm(third)
            return np.stack([first, np.cross(third, first), third])
        along = (b - a) / np.linalg.norm(b - a)
        out = np.array(self.deck.place[node]) - a
        out = out - (out @ along) * along
        far = float(np.linalg.norm(out))
        if not far > ON_AXIS * float(np.linalg.norm(b - a)):  # as CalculiX: any direction across the axis
            out = np.cross(along, np.eye(3)[int(np.argmin(np.abs(along)))])
            far = float(np.linalg.norm(out))
        return np.stack([out / far, np.cross(along, out / far), along])


def axes_of(deck: Deck, keywords: Iterable[Keyword], account: Account) -> NodeAxes:
    """Read the transforms of a deck.

    Parameters
    ----------
    deck : Deck
    keywords : iterable of Keyword
    account : Account
        Takes what became of each keyword.
    """
    axes = NodeAxes(deck)
    for keyword in keywords:
        if keyword.name != "transform":
            continue
        kind = keyword.given.get("type", "R").upper()
        nodes = deck.nodes(keyword.given.get("nset", ""))
        if nodes is None or kind not in ("R", "C") or not keyword.lines:
            account.missing(keyword, "a set of nodes and the type R or C are needed.")
            continue
        a, b = np.array(numbers(keyword.lines[0], keyword.path, "a transform")[:6]).reshape(2, 3)
        axes.of.update((int(node), (kind, a, b)) for node in nodes)
        account.taken(keyword, f"directions of {len(nodes)} nodes")
    return axes
