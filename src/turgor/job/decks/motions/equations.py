"""Linear equations of a deck: ``*EQUATION``, and ``*MPC`` where that is linear."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from itertools import groupby

import numpy as np

from turgor.core.meshing.exchange.formats.abaqus import Keyword
from turgor.core.model.supports import Equation
from turgor.core.model.supports.equation import matched
from turgor.foundation.errors import TurgorError
from turgor.foundation.round_off import ROUND_OFF
from turgor.job.decks.account import Account
from turgor.job.decks.deck import words_of
from turgor.job.decks.directions import NodeAxes
from turgor.job.decks.motions.multi_point import equations_of_mpc
from turgor.job.decks.names import MeshNames
from turgor.job.decks.steps import Path
from turgor.job.decks.tracks import FORCE, SHIFT

Vector = tuple[float, float, float]

#: Terms of an equation: nodes, and the vectors by which their displacements are multiplied.
Terms = list[tuple[int, Vector]]

#: Most equations of a job, each of which is a table, where those of many nodes are no copies of each other.
MOST_EQUATIONS = 300


@dataclass(slots=True)
class _Rows:
    """Equations with the same vectors: a column of nodes for each term."""

    vectors: tuple[Vector, ...]
    nodes: list[tuple[int, ...]] = field(default_factory=list)


def equations_of(path: Path, names: MeshNames, axes: NodeAxes, account: Account) -> tuple[Equation, ...]:
    """Return the linear equations of a job; those of many nodes that lie alike are one.

    Parameters
    ----------
    path : Path
        What the deck prescribes.
    names : MeshNames
        Takes sets of nodes.
    axes : NodeAxes
        Directions of the degrees of freedom.
    account : Account
        Takes what became of each keyword.
    """
    alike: dict[tuple[Vector, ...], _Rows] = {}
    for keyword in path.deck.model:
        if keyword.name not in ("equation", "mpc"):
            continue
        try:
            stated = _stated(keyword) if keyword.name == "equation" else equations_of_mpc(path.deck, keyword)
            every = [_terms(path, axes, each) for each in stated]
            for terms in every:
                vectors = tuple(vector for _, vector in terms)
                alike.setdefault(vectors, _Rows(vectors)).nodes.append(tuple(node for node, _ in terms))
            account.taken(keyword, f"{len(every)} equation{'s' * (len(every) != 1)} between displacements")
        except TurgorError as error:
            account.missing(keyword, str(error))
    groups = [group for rows in alike.values() for group in _groups(names, rows)]
    if len(groups) > MOST_EQUATIONS:
        first = next(each for each in path.deck.model if each.name in ("equation", "mpc"))
        account.missing(first, f"{len(groups)} equations of single nodes; {MOST_EQUATIONS} are the most.")
        groups = []
    return tuple(_equation(names, number, group) for number, group in enumerate(groups, start=1))


def _stated(keyword: Keyword) -> Iterator[list[list[str]]]:
    """Terms (node, degree of freedom, factor) of each equation of a keyword."""
    words = [word for line in keyword.lines for word in words_of(line)]
    while words:
        count = int(words[0]) if words[0].isdigit() else 0
        terms = [words[1 + 3 * k : 4 + 3 * k] for k in range(count)]
        if not count or len(terms[-1]) < 3:
            raise TurgorError(f"'{words[0]}' terms are stated, and {(len(words) - 1) // 3} follow.")
        yield terms
        words = words[1 + 3 * count :]


def _terms(path: Path, axes: NodeAxes, stated: Iterable[Sequence[str]]) -> Terms:
    """One term for each node, without those that stay where they are and belong to no cell."""
    solid, by_node = set(path.deck.solid_nodes.tolist()), dict[int, np.ndarray]()
    for where, freedom, factor in stated:
        nodes = path.deck.nodes(where)
        if nodes is None or len(nodes) != 1:
            count = "no" if nodes is None else len(nodes)
            raise TurgorError(f"'{where}' names {count} nodes; a term needs one here.")
        node = int(nodes[0])
        if int(freedom) not in path.deck.freedoms:
            raise TurgorError(f"degree of freedom {freedom} has no form here; nodes have {path.deck.freedoms}.")
        if node not in solid:
            _check_still(path, node, int(freedom))
            continue
        by_node.setdefault(node, np.zeros(3))
        by_node[node] += float(factor) * axes.at(node)[int(freedom) - 1]
    if len(by_node) < 2:
        raise TurgorError("an equation of one node has no form here; state a support.")
    return [(node, _rounded(vector)) for node, vector in by_node.items()]


def _check_still(path: Path, node: int, freedom: int) -> None:
    """Refuse a node of no cell that moves or bears a force."""
    targets = {(SHIFT, node, freedom), (FORCE, node, freedom)}
    if (node, freedom) not in path.fixed or targets & set(path.tracks.of):
        raise TurgorError(f"node {node} is on no solid cell; only one that is fixed has a form in an equation.")


def _rounded(vector: np.ndarray) -> Vector:
    least = ROUND_OFF.mesh_digits * np.abs(vector).max()
    x, y, z = (float(f"{part:.9g}") if abs(part) > least else 0.0 for part in vector)
    return x, y, z


def _groups(names: MeshNames, rows: _Rows) -> Iterator[_Rows]:
    """Equations that one with sets of nodes states, else each for itself."""
    if (whole := _joined(names, rows)) is not None:
        yield whole
        return
    place = names.deck.place
    size = float(np.ptp(np.array(list(place.values())), axis=0).max())

    def offset(nodes: tuple[int, ...]) -> tuple[float, ...]:
        ends = np.array(place[nodes[-1]][:3]) - np.array(place[nodes[0]][:3])
        return tuple((np.round(ends / size, 5) + 0.0).tolist())

    for _, group in groupby(sorted(rows.nodes, key=offset), key=offset):
        part = _Rows(rows.vectors, list(group))
        joined = _joined(names, part)
        if joined is None:
            yield from (_Rows(part.vectors, [nodes]) for nodes in part.nodes)
        else:
            yield joined


def _joined(names: MeshNames, rows: _Rows) -> _Rows | None:
    """The same with a first column of different nodes, where all columns are one node or lie alike; else None."""
    if len(rows.nodes) < 2:
        return rows
    columns = np.array(rows.nodes).T
    kinds = [len(np.unique(column)) for column in columns]
    order = sorted(range(len(kinds)), key=lambda k: -kinds[k])
    if names.deck.plane or set(kinds) - {1, len(rows.nodes)} or kinds[order[0]] == 1:
        return None
    points = [np.array([names.deck.place[int(node)] for node in column]) for column in columns]
    size = float(np.ptp(np.array(list(names.deck.place.values())), axis=0).max())
    for k in order:
        if kinds[k] > 1 and not _usable(names, columns[k]):
            return None
        paired, away = matched(points[order[0]], points[k]) if kinds[k] > 1 else (np.arange(kinds[0]), 0.0)
        if kinds[k] > 1 and (away > ROUND_OFF.mesh_digits * size or (paired != np.arange(len(paired))).any()):
            return None
    return _Rows(tuple(rows.vectors[k] for k in order), [tuple(nodes[k] for k in order) for nodes in rows.nodes])


def _usable(names: MeshNames, nodes: np.ndarray) -> bool:
    """Whether a set of these nodes is no more than they: not a face of cells whose middles of sides are left out."""
    if names.is_everything(nodes):
        return False
    corners = np.isin(nodes, names.deck.corner_nodes)
    second_order = len(names.deck.solid_nodes) > len(names.deck.corner_nodes)
    return not (second_order and corners.all() and names.is_face(nodes))


def _equation(names: MeshNames, number: int, rows: _Rows) -> Equation:
    places = []
    for column in np.array(rows.nodes).T:
        nodes = np.unique(column)
        places.append(names.named_set(f"node_{nodes[0]}" if len(nodes) == 1 else "tied", nodes))
    terms = [(place, vector, 1.0) for place, vector in zip(places, rows.vectors, strict=True)]
    return Equation(names.free(f"equation_{number}"), [_simple(term) for term in terms])


def _simple(term: tuple[str, Vector, float]) -> tuple[str, str | Vector, float]:
    """A term along x, y or z by its letter."""
    place, vector, _ = term
    axes = [axis for axis in range(3) if vector[axis]]
    return (place, "xyz"[axes[0]], vector[axes[0]]) if len(axes) == 1 else term
