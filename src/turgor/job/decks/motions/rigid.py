"""Rigid bodies of a deck: a face whose nodes follow a reference node becomes one with a reference point."""

from typing import Any

import numpy as np

from turgor.core.meshing.exchange.formats.abaqus import Keyword
from turgor.core.model.history import RAMP, History
from turgor.foundation.errors import TurgorError
from turgor.job.decks.account import Account
from turgor.job.decks.deck import Deck, words_of
from turgor.job.decks.names import MeshNames
from turgor.job.decks.steps import Path
from turgor.job.decks.tracks import FORCE, SHIFT
from turgor.job.decks.units import DeckUnits
from turgor.job.text.load_values import history_values
from turgor.units import format_quantity

#: What one direction of a reference node does: its largest value and its way there.
Way = tuple[float, History]


def points_of(path: Path, names: MeshNames, units: DeckUnits, account: Account) -> dict[str, dict[str, Any]]:
    """Return the table ``[points]`` of a job.

    Parameters
    ----------
    path : Path
        What the deck prescribes, at reference nodes too.
    names : MeshNames
        Takes the faces.
    units : DeckUnits
    account : Account
        Takes what became of each rigid body.
    """
    points: dict[str, dict[str, Any]] = {}
    for keyword in path.deck.model:
        if keyword.name != "rigid body" or any(keyword is body for body, _ in path.deck.rigid_bodies):
            continue
        try:
            table = _point(path, names, keyword, units)
        except TurgorError as error:
            account.missing(keyword, str(error))
        else:
            name = names.free("reference_point")
            points[name if name not in points else f"{name}_{len(points) + 1}"] = table
            account.taken(keyword, f"reference point to which the face '{table['face']}' is tied")
    return points


def _point(path: Path, names: MeshNames, keyword: Keyword, units: DeckUnits) -> dict[str, Any]:
    deck = path.deck
    nodes = deck.nodes(keyword.given.get("nset", ""))
    reference, turned = deck.reference_nodes(keyword)
    if nodes is None or reference not in deck.place or np.isin([reference, turned], deck.solid_nodes).any():
        raise TurgorError("NSET and a REF NODE with coordinates are needed here, apart from the cells.")
    if names.mirrors or deck.plane:
        raise TurgorError("a rigid body of a half or of a plane model has no form here.")
    if not names.is_face(nodes):
        raise TurgorError("its nodes are no whole face of a body, which a reference point needs here.")
    if any(isinstance(t, tuple) and t[0] == FORCE and t[1] in (reference, turned) for t in path.tracks.of):
        raise TurgorError("a force or moment on its nodes has no form here.")
    _check_freedoms(deck, {reference, turned})
    shifts, turns = ways_of(path, reference), ways_of(path, turned)
    histories = {history for size, history in (*shifts.values(), *turns.values()) if size}
    if len(histories) > 1:
        raise TurgorError("its directions go different ways, and a reference point has one history.")
    values: dict[str, Any] = {"face": names.new_set(keyword.given["nset"], nodes)}
    values["at"] = [format_quantity(x * units.length, "mm") for x in deck.place[reference]]
    if shifts:
        values["prescribed"] = "".join("xyz"[freedom - 1] for freedom in sorted(shifts))
    if any(size for size, _ in shifts.values()):
        vector = [shifts.get(freedom, (0.0, RAMP))[0] * units.length for freedom in (1, 2, 3)]
        values["displacement"] = [format_quantity(part, "mm") for part in vector]
    return values | _turn(turns) | history_values(histories.pop() if histories else RAMP)


def ways_of(path: Path, node: int) -> dict[int, Way]:
    """Prescribed directions of a node."""
    ways: dict[int, Way] = {freedom: (0.0, RAMP) for at, freedom in path.fixed if at == node}
    for target, track in path.tracks.of.items():
        if isinstance(target, tuple) and target[:2] == (SHIFT, node):
            ways[target[2]] = track.history()
    return ways


def _turn(turns: dict[int, Way]) -> dict[str, Any]:
    """The rotation: about one axis alone, or with free tilts."""
    if not turns:
        return {}
    moved = [freedom for freedom, (size, _) in turns.items() if size] or [min(turns)]
    if len(moved) > 1 or len(turns) == 2:
        raise TurgorError("its nodes turn about one axis here, and do not tilt or are free to.")
    axis = [float(freedom == moved[0]) for freedom in (1, 2, 3)]
    values = {"rotation": format_quantity(turns[moved[0]][0], "rad"), "axis": axis}
    return values | ({"tilts": True} if len(turns) == 1 else {})


def _check_freedoms(deck: Deck, nodes: set[int]) -> None:
    """Refuse turns that the reference node states itself, which are read nowhere."""
    for keyword in (*deck.model, *(each for step in deck.steps for each in step)):
        for words in map(words_of, keyword.lines if keyword.name in ("boundary", "cload") else ()):
            last = next((word for word in words[2:0:-1] if word.isdigit()), "0")
            numbers = deck.nodes(words[0])
            if int(last) > 3 and numbers is not None and nodes.intersection(numbers.tolist()):
                raise TurgorError(f"degree of freedom {last} of its node has no form here; state turns by a ROT NODE.")
