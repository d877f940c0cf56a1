"""Multi-point constraints of a deck, ``*MPC``, as the terms of linear equations where they are linear."""

from collections.abc import Iterator

import numpy as np

from turgor.core.meshing.exchange.formats.abaqus import Keyword
from turgor.foundation.errors import TurgorError
from turgor.foundation.round_off import ROUND_OFF
from turgor.job.decks.deck import Deck, words_of

#: Types that are linear, with how many nodes the first one follows.
_LINEAR = {"PIN": 1, "TIE": 1, "LINEAR": 2}


def equations_of_mpc(deck: Deck, keyword: Keyword) -> Iterator[list[list[str]]]:
    """Terms (node, degree of freedom, factor) of the equations of a ``*MPC``.

    ``PIN`` and ``TIE`` move a node as another one, ``LINEAR`` as the straight line between two others on which it lies.
    Sets of nodes are paired in the order of their numbers, as Abaqus does.

    Parameters
    ----------
    deck : Deck
    keyword : Keyword

    Raises
    ------
    TurgorError
        If the type turns with large displacements, or its nodes are none or do not fit each other.
    """
    for line in keyword.lines:
        kind, *names = words_of(line)
        if kind.upper() not in _LINEAR:
            raise TurgorError(
                f"the type {kind.upper()} has no form here: it turns with large displacements, and equations do not; "
                f"{', '.join(_LINEAR)} have one."
            )
        if len(names) != 1 + _LINEAR[kind.upper()]:
            raise TurgorError(f"{kind.upper()} has {len(names)} nodes or sets; {1 + _LINEAR[kind.upper()]} are needed.")
        columns = [deck.nodes(name) for name in names]
        if (
            any(column is None for column in columns)
            or len({len(column) for column in columns if column is not None}) > 1
        ):
            raise TurgorError(f"the sets {', '.join(names)} must be known, and have as many nodes each.")
        for row in np.array(columns).T.tolist():
            yield from _follows(deck, row)


def _follows(deck: Deck, nodes: list[int]) -> Iterator[list[list[str]]]:
    """One equation for each degree of freedom: the first node moves as the others."""
    factors = [-1.0, 1.0] if len(nodes) == 2 else [-1.0, *_shares(deck, nodes)]
    for freedom in deck.freedoms:
        yield [[str(node), str(freedom), repr(factor)] for node, factor in zip(nodes, factors, strict=True) if factor]


def _shares(deck: Deck, nodes: list[int]) -> tuple[float, float]:
    """How much of the motion of each end a node has that lies between them."""
    point, start, end = (np.array(deck.place[node]) for node in nodes)
    along = end - start
    length = float(np.linalg.norm(along))
    share = float((point - start) @ along) / length**2 if length else 0.0
    away = float(np.linalg.norm(start + share * along - point))
    if not length or away > ROUND_OFF.mesh_digits * length or not 0 <= share <= 1:
        raise TurgorError(f"node {nodes[0]} does not lie between the nodes {nodes[1]} and {nodes[2]}.")
    return 1 - share, share
