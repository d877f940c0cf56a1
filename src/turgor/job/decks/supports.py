"""Supports of a job from the nodes that a deck fixes and moves."""

from collections.abc import Iterable
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from turgor.core.meshing.exchange.formats.abaqus import Keyword
from turgor.core.model.history import RAMP, History
from turgor.core.model.places import NodesAt
from turgor.core.model.supports import Displacement, Fixed, Roller, Shift, Support
from turgor.job.decks.account import Account
from turgor.job.decks.deck import ROUND
from turgor.job.decks.directions import NodeAxes
from turgor.job.decks.names import MeshNames
from turgor.job.decks.steps import Path
from turgor.job.decks.tracks import SHIFT
from turgor.job.decks.units import DeckUnits

#: Most directions that are not x, y or z: a support for each; nodes of a curved surface have one each.
MOST_DIRECTIONS = 50

Direction = tuple[float, float, float]


@dataclass(slots=True)
class _Group:
    """Nodes with one direction and one way to go there."""

    keyword: Keyword
    nodes: list[int] = field(default_factory=list)


def supports_of(
    path: Path, names: MeshNames, axes: NodeAxes, units: DeckUnits, account: Account
) -> tuple[Support, ...]:
    """Make the supports of a job: a face where whole sides of cells are fixed, else a set of nodes.

    Parameters
    ----------
    path : Path
        What the deck prescribes.
    names : MeshNames
        Gets the faces and node sets that supports need.
    axes : NodeAxes
        Directions of the degrees of freedom.
    units : DeckUnits
    account : Account
        Gets the keywords that a job cannot express.
    """
    solid = set(path.deck.solid_nodes.tolist())
    ways: dict[tuple[Direction, float, History], _Group] = {}
    for (node, freedom), keyword in path.fixed.items():
        if node in solid:
            _add(ways, axes, (node, freedom), (0.0, RAMP), keyword)
    for target, track in path.tracks.of.items():
        if isinstance(target, tuple) and target[0] == SHIFT and target[1] in solid:
            _add(ways, axes, target[1:], track.history(), path.tracks.keywords[target])
    if path.deck.plane == ROUND:
        _close_rings(ways, account)
    askew = [key for key in ways if max(map(abs, key[0])) < 1 - 1e-9]
    if len(askew) > MOST_DIRECTIONS:
        account.missing(
            ways[askew[0]].keyword, f"{len(askew)} directions that are not x, y or z; {MOST_DIRECTIONS} are the most."
        )
        askew = []
    rollers = [_roller(names, key, ways[key], units, account) for key in askew]
    plain = {key: group for key, group in ways.items() if max(map(abs, key[0])) >= 1 - 1e-9}
    return (*_along_axes(names, plain, units), *(each for each in rollers if each is not None))


def _close_rings(ways: dict[tuple[Direction, float, History], _Group], account: Account) -> None:
    """Fix both directions across the axis where the radius is fixed; rings that become wider have no form."""
    for (direction, size, history), group in list(ways.items()):
        if direction == (0.0, 1.0, 0.0):
            continue
        if size or direction != (1.0, 0.0, 0.0):
            account.missing(group.keyword, "rings of a body of revolution are fixed here, or move along their axis.")
            del ways[direction, size, history]
        else:
            ways[(0.0, 0.0, 1.0), size, history] = group


def _add(
    ways: dict[tuple[Direction, float, History], _Group],
    axes: NodeAxes,
    place: tuple[int, int],
    way: tuple[float, History],
    keyword: Keyword,
) -> None:
    node, freedom = place
    size, history = way
    x, y, z = (float(part) for part in np.round(axes.at(node)[freedom - 1], 9) + 0.0)
    if min(x, y, z) < 0 and max(map(abs, (x, y, z))) >= 1 - 1e-9:  # against x, y or z
        x, y, z, size = -x + 0.0, -y + 0.0, -z + 0.0, -size
    group = ways.setdefault(((x, y, z), size + 0.0, history if size else RAMP), _Group(keyword))
    group.nodes.append(node)


def _roller(
    names: MeshNames, key: tuple[Direction, float, History], group: _Group, units: DeckUnits, account: Account
) -> Support | None:
    direction, size, _ = key
    if size:
        account.missing(group.keyword, "a displacement along a direction that is not x, y or z has no form here.")
        return None
    return Roller(_place(names, np.unique(group.nodes), "roller", units), direction)


def _along_axes(
    names: MeshNames, ways: dict[tuple[Direction, float, History], _Group], units: DeckUnits
) -> Iterable[Support]:
    """Supports along x, y and z; directions of the same nodes that go the same way are one."""
    by_nodes: dict[tuple[int, ...], list[tuple[int, float, History]]] = {}
    for (direction, size, history), group in ways.items():
        axis = int(np.argmax(np.abs(direction)))
        by_nodes.setdefault(tuple(sorted(set(group.nodes))), []).append((axis, size, history))
    for nodes, parts in by_nodes.items():
        fixed = [axis for axis, size, _ in parts if not size]
        moved: dict[History, list[tuple[int, float]]] = {}
        for axis, size, history in parts:
            if size:
                moved.setdefault(history, []).append((axis, size))
        if not moved:
            yield Fixed(_place(names, np.array(nodes), "fixed", units), _letters(fixed))
        for number, (history, along) in enumerate(moved.items()):
            vector = [0.0, 0.0, 0.0]
            for axis, size in along:
                vector[axis] = size * units.length
            free = _letters([axis for axis, _ in along] + (fixed if number == 0 else []))
            yield Displacement(_place(names, np.array(nodes), "moved", units), Shift(vector, history), free)


def _letters(axes: Iterable[int]) -> str:
    return "".join("xyz"[axis] for axis in sorted(axes))


def _place(names: MeshNames, nodes: NDArray[np.int64], wish: str, units: DeckUnits) -> str | NodesAt:
    """A name for the nodes that no other support has: of a face, of a set, or of a box around all."""
    known = next((name for name, each in names.deck.content.node_sets.items() if _same(names, name, nodes)), wish)
    if names.is_everything(nodes):  # a set of all nodes has no name in a mesh
        points = units.length * np.array([names.deck.place[node] for node in nodes.tolist()])
        if names.deck.plane:  # its thickness, or what is turned about the axis
            reach = units.length * names.deck.thickness + np.abs(points).max()
            points = np.concatenate([points - [reach, 0, reach], points + [reach, 0, reach]])
        return NodesAt(names.new_set("all", nodes), box=(points.min(axis=0).tolist(), points.max(axis=0).tolist()))
    name = names.new_set(known, nodes)
    return name if names.is_face(nodes) else NodesAt(name, node_set=name)


def _same(names: MeshNames, name: str, nodes: NDArray[np.int64]) -> bool:
    own = names.deck.node_sets.numbers(name)
    return own is not None and np.array_equal(np.unique(own), np.unique(nodes))
