"""Rigid bodies of solid cells in a deck: obstacles of triangles, which move as their reference nodes do."""

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from turgor.core.meshing.exchange.formats.abaqus import Keyword
from turgor.core.model.history import points_of, share_at
from turgor.foundation.errors import TurgorError
from turgor.job.decks.account import Account
from turgor.job.decks.deck import Deck, Ints, sides_of, words_of
from turgor.job.decks.motions.rigid import Way, ways_of
from turgor.job.decks.names import MeshNames
from turgor.job.decks.steps import Path
from turgor.job.decks.units import DeckUnits
from turgor.units import format_quantity


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class RigidPair:
    """A pair of a soft surface and a rigid body.

    Parameters
    ----------
    keyword : Keyword
        The rigid body.
    cells : int array
    slave : str
        The soft surface.
    friction : float [-]
    stiffness : float or None [Pa/m]
    """

    keyword: Keyword
    cells: Ints
    slave: str
    friction: float
    stiffness: float | None


def obstacles_of(
    path: Path, names: MeshNames, units: DeckUnits, pairs: Iterable[RigidPair], account: Account
) -> tuple[dict[str, dict[str, Any]], dict[str, str]]:
    """Return the tables ``[obstacles]`` of a job, and the STL files that they name.

    Parameters
    ----------
    path : Path
        What the deck prescribes, at reference nodes too.
    names : MeshNames
        Takes the faces that meet them.
    units : DeckUnits
    pairs : iterable of RigidPair
    account : Account
        Takes what became of each rigid body.
    """
    tables: dict[str, dict[str, Any]] = {}
    files: dict[str, str] = {}
    for pair in pairs:
        try:
            table = _obstacle(path, names, units, pair)
        except TurgorError as error:
            account.missing(pair.keyword, str(error))
            continue
        label = re.sub(r"\W", "_", re.sub("^rigid_", "", pair.keyword.given["elset"].lower()))
        name = label if label not in tables and label.isidentifier() else f"obstacle_{len(tables) + 1}"
        table["file"] = f"{path.deck.path.stem}-{name}.stl"
        files[table["file"]] = _stl(path.deck, pair.cells)
        tables[name] = table
        account.taken(pair.keyword, f"obstacle '{name}' of triangles, in contact with '{table['face']}'")
    return tables, files


def _obstacle(path: Path, names: MeshNames, units: DeckUnits, pair: RigidPair) -> dict[str, Any]:
    deck, sides = path.deck, path.deck.surface(pair.slave)
    reference, turning = deck.reference_nodes(pair.keyword)
    if reference not in deck.place or not sides:
        raise TurgorError("a REF NODE with coordinates, and a surface of sides of solid cells, are needed here.")
    shifts, turns = ways_of(path, reference), ways_of(path, turning) if turning else _turns_at(deck, reference)
    if len(shifts) < 3 or len(turns) < 3:
        raise TurgorError("its reference node is free to move or to turn, which has no form here; state all of it.")
    values: dict[str, Any] = {"shape": "stl", "file": "", "unit": units.word, "friction": pair.friction}
    values["face"] = names.named_surface(pair.slave, sides)
    if pair.stiffness is not None:
        values["stiffness"] = format_quantity(pair.stiffness, "MPa/mm")
    if any(size for size, _ in shifts.values()):
        values["path"] = _way(shifts, units.length, "mm")
    if any(size for size, _ in turns.values()):
        values["rotation"] = _way(turns, 1.0, "rad")
        values["about"] = [format_quantity(x * units.length, "mm") for x in deck.place[reference]]
    return values


def _way(ways: Mapping[int, Way], scale: float, unit: str) -> list[list[Any]]:
    """Points of load factor and three components."""
    factors = sorted({s for _, history in ways.values() for s, _ in points_of(history)})
    return [
        [s, [format_quantity(scale * ways[k][0] * share_at(ways[k][1], s), unit) for k in (1, 2, 3)]] for s in factors
    ]


def _turns_at(deck: Deck, node: int) -> dict[int, Way]:
    """Fixed turns of a node that states its own, freedoms 4 to 6; another value than zero has no form here."""
    fixed: dict[int, Way] = {}
    for keyword in (*deck.model, *(each for step in deck.steps for each in step)):
        for words in map(words_of, keyword.lines if keyword.name == "boundary" else ()):
            numbers = deck.nodes(words[0])
            if numbers is None or node not in numbers or not words[1].isdigit():
                continue
            last = int(words[2]) if len(words) > 2 and words[2] else int(words[1])
            turns = [freedom - 3 for freedom in range(int(words[1]), last + 1) if freedom > 3]
            if turns and len(words) > 3 and float(words[3]):
                raise TurgorError("a turn at its reference node has no form here; state it at a ROT NODE.")
            fixed |= dict.fromkeys(turns, (0.0, ((0.0, 0.0), (1.0, 0.0))))
    return fixed


def _stl(deck: Deck, cells: Ints) -> str:
    """The surface of cells as triangles, in the unit of the deck, seen from outside counterclockwise."""
    sides: dict[tuple[int, ...], tuple[list[int], np.ndarray] | None] = {}
    for kind, rows in deck.every_solid.items():
        for row in rows[np.isin(rows[:, 0], cells), 1:].tolist():
            middle = np.mean([deck.place[node] for node in row], axis=0)
            for side in sides_of(kind):
                corners = [row[k] for k in side]
                key = tuple(sorted(corners))
                sides[key] = None if key in sides else (corners, middle)
    lines = ["solid rigid"]
    for corners, middle in (each for each in sides.values() if each is not None):
        for k in range(1, len(corners) - 1):
            a, b, c = (np.array(deck.place[node]) for node in (corners[0], corners[k], corners[k + 1]))
            if np.cross(b - a, c - a) @ (a - middle) < 0:
                b, c = c, b
            lines += ["facet normal 0 0 0", "outer loop"]
            lines += ["vertex " + " ".join(f"{x:.12g}" for x in point) for point in (a, b, c)]
            lines += ["endloop", "endfacet"]
    return "\n".join([*lines, "endsolid rigid"]) + "\n"
