"""Loads of a job from the pressures, forces and weights of a deck."""

from collections.abc import Iterable, Mapping
from dataclasses import replace

import numpy as np

from turgor.core.geometry.directions import DIRECTIONS
from turgor.core.model.history import History
from turgor.core.model.loads import Centrifugal, Force, Gravity, Load, Pressure, Traction
from turgor.core.model.places import NodesAt
from turgor.job.decks.account import Account
from turgor.job.decks.deck import ROUND
from turgor.job.decks.directions import NodeAxes
from turgor.job.decks.names import MeshNames
from turgor.job.decks.steps import Path
from turgor.job.decks.tracks import FORCE, GRAVITY, PRESSURE, SAME, SPIN, TRACTION
from turgor.job.decks.uniform import uniform_sides
from turgor.job.decks.units import DeckUnits

#: Most nodes with a force of their own: each is a table of the job file.
MOST_FORCES = 400

#: Why a load on a body of revolution is refused.
ACROSS = "a load across the axis of a body of revolution has no form here; a pressure, and loads along y, have one."


def loads_of(
    path: Path, names: MeshNames, axes: NodeAxes, units: DeckUnits, account: Account, images: int = 1
) -> tuple[Load, ...]:
    """Make the loads of a job.

    Parameters
    ----------
    path : Path
        What the deck prescribes.
    names : MeshNames
        Gets the faces and node sets that loads need.
    axes : NodeAxes
        Directions of the degrees of freedom.
    units : DeckUnits
    account : Account
        Gets the keywords that a job cannot express.
    images : int
        How many images of the deck the whole body is; forces count for the whole.
    """
    whole = replace(units, force=units.force * images)
    return (
        *_pressures(path, names, units, account),
        *_tractions(path, names, units, account),
        *_gravities(path, units, account),
        *_spins(path, units, account),
        *_forces(path, names, axes, whole, account),
    )


def _pressures(path: Path, names: MeshNames, units: DeckUnits, account: Account) -> Iterable[Load]:
    """One pressure for all sides with the same value and history."""
    solid = set(path.deck.solid_numbers.tolist())
    alike: dict[tuple[float, History], list[tuple[str, tuple[int, str]]]] = {}
    for target, track in path.tracks.of.items():
        if not isinstance(target, tuple) or target[0] != PRESSURE:
            continue
        _, where, label = target
        named = path.deck.surface(where) if not label else None
        cells = path.deck.cells(where) if label else None
        sides = named if named is not None else tuple((int(c), label) for c in (() if cells is None else cells))
        if any(side[0] not in solid for side in sides):
            account.missing(path.tracks.keywords[target], "pressure on cells that are no solid ones has no form here.")
            continue
        alike.setdefault(track.history(), []).extend((where if not label else "pressed", side) for side in sides)
    for (value, history), rows in alike.items():
        wishes = {wish for wish, _ in rows}
        name = names.loaded_surface(wishes.pop() if len(wishes) == 1 else "pressed", (side for _, side in rows))
        if value:
            yield Pressure(name, value * units.stress, history)


def _tractions(path: Path, names: MeshNames, units: DeckUnits, account: Account) -> Iterable[Load]:
    """A traction for each surface and direction."""
    solid = set(path.deck.solid_numbers.tolist())
    for target, track in path.tracks.of.items():
        if not isinstance(target, tuple) or target[0] != TRACTION:
            continue
        _, where, direction = target
        sides = path.deck.surface(where) or ()
        size, history = track.history()
        length = float(np.linalg.norm(direction))
        if path.deck.plane == ROUND and direction[0]:
            account.missing(path.tracks.keywords[target], ACROSS)
        elif any(side[0] not in solid for side in sides) or not length:
            account.missing(path.tracks.keywords[target], "a traction needs solid cells and a direction.")
        elif size:
            vector = size * units.stress / length * np.array(direction)
            yield Traction(names.loaded_surface(where, sides), _rounded(vector), history)


def _gravities(path: Path, units: DeckUnits, account: Account) -> Iterable[Load]:
    weights = {t: track for t, track in path.tracks.of.items() if isinstance(t, tuple) and t[0] == GRAVITY}
    for target, track in weights.items():
        keyword = path.tracks.keywords[target]
        size, history = track.history()
        vector = np.array(target[1]) * np.sign(size)
        along = next((each for each in DIRECTIONS.values() if np.allclose(vector / np.linalg.norm(vector), each)), None)
        if path.deck.plane == ROUND and target[1][0]:
            account.missing(keyword, ACROSS)
        elif along is None or len(weights) > 1:
            account.missing(keyword, f"gravity along {target[1]} has no form here; one along x, y or z has.")
        elif size:
            acceleration = abs(size) * float(np.linalg.norm(vector)) * units.length
            yield Gravity(along, float(f"{acceleration:.12g}"), history)


def _spins(path: Path, units: DeckUnits, account: Account) -> Iterable[Load]:
    """A centrifugal force for each axis; the deck states the square of the speed."""
    for target, track in path.tracks.of.items():
        if not isinstance(target, tuple) or target[0] != SPIN:
            continue
        _, center, axis = target
        size, history = track.history()
        if size < 0 or len(axis) < 3 or not np.linalg.norm(axis):
            account.missing(path.tracks.keywords[target], "CENTRIF needs a square of a speed, a point and a direction.")
        elif size:
            through = _rounded(units.length * np.array(center))
            yield Centrifugal(speed=float(f"{size**0.5:.12g}"), axis=axis, through=through, history=history)


def _forces(path: Path, names: MeshNames, axes: NodeAxes, units: DeckUnits, account: Account) -> Iterable[Load]:
    """A force on a face where those on its nodes are a uniform traction; else one on each node."""
    solid = set(path.deck.solid_nodes.tolist())
    vectors: dict[tuple[int, History], np.ndarray] = {}
    for target, track in path.tracks.of.items():
        if not isinstance(target, tuple) or target[0] != FORCE:
            continue
        _, node, freedom = target
        size, history = track.history()
        if path.deck.plane == ROUND and abs(axes.at(node)[freedom - 1][1]) < 1 and size:
            account.missing(path.tracks.keywords[target], ACROSS)
        elif node not in solid:
            account.missing(path.tracks.keywords[target], f"a force on node {node}, which is on no solid cell.")
        elif size:
            known = next((h for n, h in vectors if n == node and _same(h, history)), history)
            vector = vectors.setdefault((node, known), np.zeros(3))
            vector += size * units.force * axes.at(node)[freedom - 1]
    for history in dict.fromkeys(history for _, history in vectors):
        alike = {node: vector for (node, each), vector in vectors.items() if each == history}
        sides = uniform_sides(path.deck, alike)
        if sides:
            yield Force(names.loaded_surface("pulled", sides), _rounded(sum(alike.values(), np.zeros(3))), history)
            vectors = {key: vector for key, vector in vectors.items() if key[1] != history}
    if len(vectors) > MOST_FORCES:
        keyword = next(k for t, k in path.tracks.keywords.items() if isinstance(t, tuple) and t[0] == FORCE)
        account.missing(
            keyword, f"{len(vectors)} forces on single nodes; {MOST_FORCES} are the most, state a traction."
        )
        return
    yield from _each(vectors, names)


def _each(vectors: Mapping[tuple[int, History], np.ndarray], names: MeshNames) -> Iterable[Load]:
    for (node, history), vector in vectors.items():
        name = names.new_set(f"node_{node}", np.array([node]))
        yield Force(NodesAt(name, node_set=name), _rounded(vector), history)


def _rounded(vector: np.ndarray) -> list[float]:
    """A vector without round-off of units."""
    return [float(f"{part:.12g}") for part in vector]


def _same(one: History, other: History) -> bool:
    if isinstance(one, str) or isinstance(other, str) or len(one) != len(other):
        return one == other
    return bool(np.allclose(one, other, atol=SAME))
