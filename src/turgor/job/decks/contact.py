"""Contact of a deck: pairs of surfaces become contact of walls wherever they meet."""

from dataclasses import dataclass, field

import numpy as np

from turgor.core.meshing.exchange.formats.abaqus import Keyword
from turgor.core.meshing.exchange.formats.raw import numbers
from turgor.foundation.errors import TurgorError
from turgor.job.decks.account import Account
from turgor.job.decks.deck import Deck, Ints, words_of
from turgor.job.decks.motions.obstacles import RigidPair
from turgor.job.decks.parts import coinciding, is_tied, nodes_of_surface, stays_apart
from turgor.job.decks.units import DeckUnits
from turgor.units import format_quantity


@dataclass(slots=True)
class _Interaction:
    """Friction and penalty of an interaction."""

    friction: float = 0.0
    stiffness: float | None = None


@dataclass(slots=True)
class _Contact:
    """What the keywords of contact have stated so far."""

    deck: Deck
    units: DeckUnits
    interactions: dict[str, _Interaction] = field(default_factory=dict)
    last: str = ""
    used: list[str] = field(default_factory=list)
    rigid: list[tuple[str, tuple[Keyword, Ints], str]] = field(default_factory=list)


def contact_of(deck: Deck, units: DeckUnits, account: Account) -> tuple[dict[str, object], tuple[RigidPair, ...]]:
    """Return the table ``[contact]`` of a job, without which walls do not touch, and the pairs with rigid bodies.

    Parameters
    ----------
    deck : Deck
    units : DeckUnits
    account : Account
        Takes what became of the pairs.
    """
    state = _Contact(deck, units)
    for keyword in deck.model:
        take = _TAKERS.get(keyword.name)
        if take is None or (keyword.name == "contact pair" and is_tied(deck, keyword)):
            continue
        try:
            account.taken(keyword, take(state, keyword))
        except (TurgorError, IndexError) as error:
            account.missing(keyword, str(error))
    rigid = []
    for slave, (body, cells), interaction in state.rigid:
        one = state.interactions.get(interaction, _Interaction())
        pair = RigidPair(keyword=body, cells=cells, slave=slave, friction=one.friction, stiffness=one.stiffness)
        rigid.append(pair)
    return _table(state), tuple(rigid)


def _table(state: _Contact) -> dict[str, object]:
    if not state.used:
        return {"self_contact": False}
    one = state.interactions.get(state.used[0], _Interaction())
    values: dict[str, object] = {"self_contact": True, "friction": one.friction}
    if one.stiffness is not None:
        values["stiffness"] = format_quantity(one.stiffness, "MPa/mm")
    return values


def _take_interaction(state: _Contact, keyword: Keyword) -> str:
    state.last = keyword.given.get("name", "").lower()
    state.interactions[state.last] = _Interaction()
    return "contact"


def _take_friction(state: _Contact, keyword: Keyword) -> str:
    coefficient = numbers(keyword.lines[0], keyword.path, "friction")[0]
    state.interactions.setdefault(state.last, _Interaction()).friction = coefficient
    return f"friction = {coefficient:g}; where walls stick, turgor chooses how elastically"


def _take_behavior(state: _Contact, keyword: Keyword) -> str:
    kind = keyword.given.get("pressure-overclosure", "hard").lower()
    if kind == "tied":
        return "a tie of the surfaces"
    if kind != "linear":
        return "penalty that turgor chooses from the material"
    slope = numbers(keyword.lines[0], keyword.path, "a penalty")[0] * state.units.stress / state.units.length
    state.interactions.setdefault(state.last, _Interaction()).stiffness = slope
    return "penalty of the deck"


def _take_pair(state: _Contact, keyword: Keyword) -> str:
    words = words_of(keyword.lines[0])
    slave, master = words[0], words[-1]
    adjust = keyword.given.get("adjust", "0")
    if any(each not in "0." for each in adjust):
        raise TurgorError(f"ADJUST={adjust} moves nodes onto the other surface, which has no form here; mesh them so.")
    interaction = keyword.given.get("interaction", "").lower()
    body = next((each for each in state.deck.rigid_bodies if _is_of(state.deck, master, each[1])), None)
    if body is not None:
        state.rigid.append((slave, body, interaction))
        return "contact with an obstacle"
    for name in (slave, master):
        if not len(nodes_of_surface(state.deck, name)):
            raise TurgorError(f"surface '{name}' is none of solid cells; rigid surfaces have no form here.")
        if state.deck.surface(name) is None and not state.deck.is_face(nodes_of_surface(state.deck, name)):
            raise TurgorError(f"'{name}' are single nodes; here walls meet, wherever they do, and no node alone.")
    if slave != master and not stays_apart(state.deck) and coinciding(state.deck, slave, master):
        raise TurgorError(
            f"nodes of '{slave}' lie at the place of nodes of '{master}', which a mesh file makes one; leave a gap."
        )
    known = {id(state.interactions.get(name)) for name in (*state.used, interaction)}
    state.used.append(interaction)
    if len(known) > 1 and len({str(state.interactions.get(name)) for name in state.used}) > 1:
        raise TurgorError("pairs with different friction or penalties have no form here.")
    return "contact of walls wherever they meet, with both sides alike"


def _is_of(deck: Deck, surface: str, cells: Ints) -> bool:
    """Whether all sides of a surface are those of some cells."""
    sides = deck.surface(surface)
    return bool(sides) and bool(np.isin([cell for cell, _ in sides or ()], cells).all())


_TAKERS = {
    "surface interaction": _take_interaction,
    "friction": _take_friction,
    "surface behavior": _take_behavior,
    "contact pair": _take_pair,
}
