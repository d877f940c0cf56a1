"""Threads of a deck: trusses that ``*EMBEDDED ELEMENT`` puts into the body."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from math import pi, sqrt

import numpy as np

from turgor.core.materials.laws.laws import Hooke
from turgor.core.materials.material import Material
from turgor.core.meshing.exchange.formats.abaqus import Keyword
from turgor.core.meshing.exchange.formats.abaqus_sets import NumberSets
from turgor.core.meshing.exchange.formats.raw import numbers
from turgor.core.model.embedded import EmbeddedThreads
from turgor.core.model.fibers import DISCRETE, Fibers
from turgor.foundation.errors import TurgorError
from turgor.job.decks.account import Account
from turgor.job.decks.deck import Deck, words_of
from turgor.job.decks.names import MeshNames
from turgor.job.decks.parts import no_compression
from turgor.job.decks.units import DeckUnits

#: Types of trusses, with the order of their nodes along them.
_TRUSSES = {"T3D2": (0, 1), "T3D3": (0, 2, 1)}


def threads_of(
    names: MeshNames, materials: Mapping[str, Material], units: DeckUnits, account: Account
) -> dict[str, Fibers]:
    """Return the embedded trusses of a deck as threads, those of each section as one entry.

    Parameters
    ----------
    names : MeshNames
    materials : mapping of str to Material
        Those of the deck.
    units : DeckUnits
    account : Account
        Takes what became of trusses, their sections and embeddings.
    """
    deck = names.deck
    embeddings = [each for each in deck.model if each.name == "embedded element"]
    if not embeddings:
        return {}
    trusses = {row[0]: row[1:] for keyword in deck.model for row in _rows(keyword)}
    sets, inside = _sets(deck, trusses), list[int]()
    for keyword in embeddings:
        try:
            inside += _embedded(keyword, sets)
            account.taken(keyword, "threads that follow the cells around them")
        except TurgorError as error:
            account.missing(keyword, str(error))
    threads, done = dict[str, Fibers](), list[int]()
    for keyword in deck.model:
        own = _numbers(keyword.given.get("elset", ""), sets) if keyword.name == "solid section" else []
        if not own or not set(own) <= set(inside):
            continue
        try:
            name = names.free(keyword.given["elset"], "threads")
            threads[name] = _threads(keyword, _lines(deck, [trusses[each] for each in own]), materials, units)
            slack = no_compression(deck, keyword.given["material"])
            if slack is not None:
                threads[name] = replace(threads[name], compression=0.0)
                account.taken(slack, "threads that bear tension only")
            account.taken(keyword, f"threads '{name}' of {len(own)} trusses")
            done += own
        except TurgorError as error:
            account.missing(keyword, str(error))
    for keyword in deck.model:
        rows = _rows(keyword)
        if rows and {row[0] for row in rows} <= set(done):
            account.taken(keyword, "embedded trusses, cut where they pass from cell to cell")
    return threads


def _rows(keyword: Keyword) -> list[list[int]]:
    """Number and nodes of each truss, in their order along it."""
    order = _TRUSSES.get(keyword.given.get("type", "").upper()[:4]) if keyword.name == "element" else None
    if order is None:
        return []
    rows = [[int(x) for x in numbers(line, keyword.path, "a truss")] for line in keyword.lines]
    return [[row[0], *(row[1 + k] for k in order)] for row in rows if len(row) > len(order)]


def _sets(deck: Deck, trusses: Mapping[int, list[int]]) -> NumberSets:
    sets = {name: list(members) for name, members in deck.content.cell_sets.items()}
    for keyword in deck.model:
        if "elset" in keyword.given and (rows := _rows(keyword)):
            sets.setdefault(keyword.given["elset"], []).extend(row[0] for row in rows)
    return NumberSets(sets, np.array(sorted(trusses), dtype=np.int64), "", [])


def _numbers(word: str, sets: NumberSets) -> list[int]:
    """Numbers of the trusses that a word names."""
    if word.isdigit():
        return [int(word)] if int(word) in sets.known else []
    known = sets.numbers(word)
    return [] if known is None else [int(each) for each in known]


def _embedded(keyword: Keyword, sets: NumberSets) -> list[int]:
    """Numbers of the trusses that a keyword embeds."""
    out = list[int]()
    for word in (word for line in keyword.lines for word in words_of(line)):
        own = _numbers(word, sets)
        if not own:
            raise TurgorError(f"'{word}' has no trusses T3D2 or T3D3; only they may be embedded.")
        out += own
    return out


def _lines(deck: Deck, trusses: list[list[int]]) -> list[list[Sequence[float]]]:
    """Points along threads: a truss that begins where the last one ended goes on with it."""
    lines = list[list[int]]()
    for nodes in trusses:
        lost = [node for node in nodes if node not in deck.place]
        if lost:
            raise TurgorError(f"a truss has node {lost[0]}, which the deck does not define.")
        if lines and lines[-1][-1] == nodes[0]:
            lines[-1] += nodes[1:]
        else:
            lines.append(list(nodes))
    return [[deck.place[node] for node in line] for line in lines]


def _threads(
    keyword: Keyword, lines: Sequence[Sequence[Sequence[float]]], materials: Mapping[str, Material], units: DeckUnits
) -> Fibers:
    """Threads of one section, which bear compression as trusses do."""
    material = materials.get(keyword.given.get("material", "").lower())
    if material is None or type(material.law) is not Hooke:
        raise TurgorError(f"the material '{keyword.given.get('material', '')}' of trusses must be *ELASTIC.")
    area = numbers(keyword.lines[0], keyword.path, "an area")[0] if keyword.lines else 1.0
    if not area > 0:
        raise TurgorError(f"the area of trusses is {area:g}; a positive one is needed.")
    through = [[[x * units.length for x in point] for point in line] for line in lines]
    return Fibers(
        material=material,
        diameter=sqrt(4 * area / pi) * units.length,
        winding=EmbeddedThreads(through=through),
        form=DISCRETE,
        compression=1.0,
    )
