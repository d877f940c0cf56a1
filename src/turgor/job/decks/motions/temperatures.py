"""Temperatures of a deck: each body that is warmed alike everywhere expands.

Expansion and stiffness are constant, so only differences count. A job states them from its own temperature at rest,
whatever the scale of the deck is.
"""

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from turgor.core.materials.material import Material
from turgor.core.meshing.exchange.formats.abaqus import Keyword
from turgor.core.model.history import RAMP, History
from turgor.core.model.loads import Load, Temperature
from turgor.core.model.loads.temperature import ROOM
from turgor.foundation.errors import TurgorError
from turgor.job.decks.account import Account
from turgor.job.decks.deck import Deck, words_of
from turgor.job.decks.names import MeshNames
from turgor.job.decks.parts import Entries
from turgor.job.decks.steps import Path
from turgor.job.decks.tracks import HEAT

Ints = NDArray[np.int64]


def is_heated(deck: Deck) -> bool:
    """Whether a step states temperatures."""
    return any(keyword.name == "temperature" for step in deck.steps for keyword in step)


def temperatures_of(path: Path, names: MeshNames, entries: Entries, account: Account) -> Iterable[Load]:
    """Make a temperature of each body and sheet that expands.

    Parameters
    ----------
    path : Path
        What the deck prescribes: the rise of the temperature of each node.
    names : MeshNames
        Bodies and sheets with their cells.
    entries : dict of str to Material or Sheet
        Material of each, with its thermal expansion if it has one.
    account : Account
        Gets a temperature that has no form here.
    """
    rises = {t[1]: track for t, track in path.tracks.of.items() if isinstance(t, tuple) and t[0] == HEAT}
    if not rises:
        return
    keyword: Keyword = next(iter(path.tracks.keywords[HEAT, node] for node in rises))
    materials = {name: each if isinstance(each, Material) else each.material for name, each in entries.items()}
    for name in (name for name, material in materials.items() if material.expansion):
        nodes = _nodes(names, name)
        alike: set[tuple[float, History]] = {
            rises[node].history() if node in rises else (0.0, RAMP) for node in nodes.tolist()
        }
        if len(alike) > 1:
            account.missing(keyword, f"body '{name}' is not at one temperature, as it must be here.")
            continue
        rise, history = alike.pop()
        if not rise:
            continue
        try:
            load = Temperature(name, ROOM + rise, history=history)
            load.of_materials(entries)
        except TurgorError as error:
            account.missing(keyword, str(error))
        else:
            yield load


def _nodes(names: MeshNames, name: str) -> Ints:
    """Nodes of a body or sheet."""
    deck = names.deck
    numbers, tables = (names.bodies[name], deck.solids) if name in names.bodies else (names.sheets[name], deck.sheets)
    rows = [table[np.isin(table[:, 0], numbers)][:, 1:].ravel() for table in tables.values()]
    return np.unique(np.concatenate(rows))


def initial_of(deck: Deck, account: Account) -> dict[int, float]:
    """Return the temperature of each node in the shape of the mesh, 0 for the others."""
    initial: dict[int, float] = {}
    for keyword in deck.model:
        if keyword.name != "initial conditions" or keyword.given.get("type", "").lower() != "temperature":
            continue
        try:
            initial.update(node for line in keyword.lines for node in _stated(deck, line))
        except (TurgorError, IndexError, ValueError) as error:
            account.missing(keyword, f"a line of data is damaged ({error})")
        else:
            account.taken(keyword, "temperature in the shape of the mesh; only the rise from it counts")
    return initial


def _stated(deck: Deck, line: str) -> Iterable[tuple[int, float]]:
    where, value = words_of(line)[:2]
    nodes = deck.nodes(where)
    if nodes is None:
        raise TurgorError(f"'{where}' is no set of nodes")
    return ((node, float(value)) for node in nodes.tolist())
