"""Bodies and sheets of a deck: cells with a section, and what joins them."""

from collections.abc import Mapping
from dataclasses import replace
from typing import TypeAlias

import numpy as np

from turgor.core.materials.material import Material
from turgor.core.meshing.exchange.formats.abaqus import Keyword
from turgor.core.meshing.exchange.formats.raw import numbers
from turgor.core.model.layers import as_solid
from turgor.core.model.sheets import Membrane, Sheet, Shell
from turgor.core.model.supports import Tied
from turgor.foundation.errors import TurgorError, near_match
from turgor.job.decks.account import Account, listed
from turgor.job.decks.deck import ROUND, STRAIN, STRESS, Deck, words_of
from turgor.job.decks.names import MeshNames
from turgor.job.decks.units import DeckUnits
from turgor.units import format_quantity

Entries: TypeAlias = dict[str, Material | Sheet]

#: Sections of flat cells, with the sheets that they are.
_SHEETS: Mapping[str, type[Membrane] | type[Shell]] = {"membrane section": Membrane, "shell section": Shell}


def entries_of(
    deck: Deck, materials: Mapping[str, Material], names: MeshNames, units: DeckUnits, account: Account
) -> Entries:
    """Return the materials of a job by the names of its bodies and sheets, from the sections of a deck.

    Parameters
    ----------
    deck : Deck
    materials : mapping of str to Material
        Those of the deck.
    names : MeshNames
        Takes the names of bodies and sheets.
    units : DeckUnits
    account : Account
        Takes what became of the sections and cells.
    """
    entries: Entries = {}
    covered = np.zeros(0, dtype=np.int64)
    for keyword in deck.model:
        if not keyword.name.endswith("section") or _of_threads(deck, keyword, account):
            continue
        try:
            cells, material = _section(deck, keyword, materials)
            if any(np.isin(cells, rigid).all() for _, rigid in deck.rigid_bodies):
                account.taken(keyword, "of a rigid body, on which its material has no effect")
            elif keyword.name == "solid section":
                covered = np.concatenate([covered, _only(cells, deck.solid_numbers, keyword, deck)])
                name = names.free(keyword.given["elset"], "body")
                names.bodies[name] = cells
                entries[name] = as_solid(material)
                account.taken(keyword, f"body '{name}' of {len(cells)} cells")
            else:
                name = _sheet(keyword, cells, material, names, entries, units)
                slack, sheet = no_compression(deck, keyword.given["material"]), entries[name]
                if slack is not None and isinstance(sheet, Sheet):
                    entries[name] = replace(sheet, compression=0.0)
                    account.taken(slack, "sheets that bear tension only")
                account.taken(keyword, f"{type(entries[name]).__name__.lower()} '{name}' of {len(cells)} cells")
        except TurgorError as error:
            account.missing(keyword, str(error))
    _check_cells(deck, covered, account)
    return entries


def _of_threads(deck: Deck, keyword: Keyword, account: Account) -> bool:
    """Whether a section is one of embedded trusses, which has a row already."""
    cells = deck.cells(keyword.given.get("elset", ""))
    return account.has(keyword) and (cells is None or not len(cells))


def _section(deck: Deck, keyword: Keyword, materials: Mapping[str, Material]) -> tuple[np.ndarray, Material]:
    if keyword.name not in ("solid section", *_SHEETS):
        raise TurgorError("such a section has no form here; bodies are solids, with sheets on their faces.")
    cells = deck.cells(keyword.given.get("elset", ""))
    if cells is None or not len(cells):
        raise TurgorError(f"the set '{keyword.given.get('elset', '')}' has no cells that are read.")
    name = keyword.given.get("material", "").lower()
    if name not in materials:
        raise TurgorError(f"its material '{name}' was not understood{near_match(name, materials)}.".replace("?.", "?"))
    if "orientation" in keyword.given and not isinstance(materials[name], Material):
        raise TurgorError("an orientation has no form here.")
    return cells, materials[name]


def _only(cells: np.ndarray, solids: np.ndarray, keyword: Keyword, deck: Deck) -> np.ndarray:
    """The cells of a solid section, which must all be solid ones."""
    if not np.isin(cells, solids).all():
        raise TurgorError("plane cells next to solid ones have no form here.")
    return cells


def _sheet(
    keyword: Keyword, cells: np.ndarray, material: Material, names: MeshNames, entries: Entries, units: DeckUnits
) -> str:
    """Add a membrane or a shell on sides of solid cells; return its name."""
    deck = names.deck
    thickness = numbers(keyword.lines[0], keyword.path, "a thickness")[0] * units.length if keyword.lines else 0.0
    corners = [deck.cell_table.corners[int(cell)][1] for cell in cells]
    outer = {tuple(sorted(side)) for sides in deck.outer_sides for side in sides.tolist()}
    if any(tuple(sorted(each.tolist())) not in outer for each in corners):
        raise TurgorError("sheets that do not lie on sides of solid cells have no form here.")
    name = names.free(keyword.given["elset"], "sheet")
    entries[name] = _SHEETS[keyword.name](material, thickness)
    names.sheets[name] = cells
    return name


def no_compression(deck: Deck, material: str) -> Keyword | None:
    """Return the ``*NO COMPRESSION`` of a material; None where it bears compression."""
    name = ""
    for keyword in deck.model:
        name = keyword.given.get("name", "").lower() if keyword.name == "material" else name
        if keyword.name == "no compression" and name == material.lower():
            return keyword
    return None


def _check_cells(deck: Deck, covered: np.ndarray, account: Account) -> None:
    """Say what became of each ``*ELEMENT``."""
    if len(np.unique(covered)) != len(covered):
        keyword = next(each for each in deck.model if each.name == "solid section")
        account.missing(keyword, "sections overlap: a cell has two materials.")
    for keyword in deck.model:
        kind = keyword.given.get("type", "").upper()
        if keyword.name != "element" or (kind.startswith("T3D") and account.has(keyword)):
            continue
        if deck.plane:
            _check_plane(deck, keyword, kind, account)
        elif not kind.startswith(("C3D", "M3D", "S")) or kind.startswith(("SPRING", "SFM")):
            account.missing(keyword, f"cells of the type {kind} have no form here.")
        elif kind.startswith("C3D"):
            account.taken(keyword, "solid cells, of second order in turgor, with mean stresses of their own")
        else:
            account.taken(keyword, "sheet on sides of solid cells")
    bare = np.setdiff1d(deck.solid_numbers, covered)
    if len(bare):
        keyword = next(each for each in deck.model if each.name == "element")
        account.missing(keyword, f"{len(bare)} solid cells have no section that was understood: {listed(bare)}.")


def _check_plane(deck: Deck, keyword: Keyword, kind: str, account: Account) -> None:
    """Say what became of cells of a plane model, which are all of one state."""
    if kind.startswith(STRESS) or not kind.startswith(deck.plane):
        account.missing(keyword, f"cells of the type {kind} have no form here; those of a plane model are CPE or CAX.")
    else:
        what = "plane strain" if deck.plane == STRAIN else "a body of revolution about y"
        account.taken(keyword, f"{what}, of second order in turgor, with mean stresses of their own")


def plane_table(deck: Deck, units: DeckUnits, account: Account) -> dict[str, str]:
    """Return the key of the mesh of a plane model: its thickness or its axis."""
    if deck.plane == ROUND:
        return {"axisymmetric": "y"}
    if not deck.plane:
        return {}
    for each in deck.model:
        if each.name == "solid section":
            own = numbers(each.lines[0], each.path, "a thickness")[0] if each.lines else 1.0
            if own != deck.thickness:
                account.missing(
                    each, f"its thickness is {own:g}, and that of others {deck.thickness:g}; one is needed."
                )
    return {"plane_strain": format_quantity(deck.thickness * units.length, "mm")}


def ties_of(deck: Deck, names: MeshNames, account: Account) -> tuple[Tied, ...]:
    """Return the ties of surfaces; where all nodes of all ties coincide, a mesh file makes them one instead."""
    ties: list[Tied] = []
    merged = not stays_apart(deck)
    if merged and len(loose := np.setdiff1d(deck.twins, _tied_nodes(deck))):
        keyword = next(each for each in deck.model if each.name == "element")
        account.missing(keyword, f"{len(loose)} nodes lie at the place of others, and become one with them here.")
    for keyword, surfaces in _tied_pairs(deck):
        if merged and len(surfaces) > 1 and _meet(deck, surfaces[0], surfaces[1]):
            account.taken(keyword, "nodes at the same place become one")
            continue
        try:
            face, to = (_tied_face(deck, name) for name in surfaces[:2])
            ties.append(Tied(names.loaded_surface("tied", face), names.named_surface("tied_to", to)))
            account.taken(keyword, f"'{ties[-1].face}' tied to '{ties[-1].to}'")
        except (TurgorError, ValueError) as error:
            account.missing(keyword, str(error))
    return tuple(ties)


def is_tied(deck: Deck, pair: Keyword) -> bool:
    """Return whether the interaction of a contact pair ties its surfaces."""
    name, last = pair.given.get("interaction", "").lower(), ""
    for keyword in deck.model:
        if keyword.name == "surface interaction":
            last = keyword.given.get("name", "").lower()
        elif keyword.name == "surface behavior" and last == name:
            return keyword.given.get("pressure-overclosure", "").lower() == "tied"
    return False


def _tied_pairs(deck: Deck) -> list[tuple[Keyword, list[str]]]:
    """Surfaces of ties, and of contact that ties."""
    tying = (k for k in deck.model if k.name == "tie" or (k.name == "contact pair" and is_tied(deck, k)))
    return [(keyword, words_of(line)) for keyword in tying for line in keyword.lines]


def stays_apart(deck: Deck) -> bool:
    """Return whether nodes at the same place stay two in a mesh file, because ties do not make all of them one."""
    all_meet = all(len(pair) > 1 and _meet(deck, pair[0], pair[1]) for _, pair in _tied_pairs(deck))
    untied = np.setdiff1d(deck.twins, _tied_nodes(deck))
    return bool(len(deck.twins)) and not deck.plane and (bool(len(untied)) or not all_meet)


def _tied_nodes(deck: Deck) -> np.ndarray:
    surfaces = [name for _, pair in _tied_pairs(deck) for name in pair]
    return np.concatenate([np.zeros(0, dtype=np.int64), *(nodes_of_surface(deck, name) for name in surfaces)])


def _tied_face(deck: Deck, name: str) -> tuple[tuple[int, str], ...]:
    """Sides of a surface that may be tied."""
    sides = deck.surface(name)
    solid = set(deck.solid_numbers.tolist())
    if not sides or deck.plane or any(side[0] not in solid for side in sides):
        raise TurgorError(f"'{name}' is no surface of sides of solid cells, which a tie of other nodes needs here.")
    return sides


def nodes_of_surface(deck: Deck, name: str) -> np.ndarray:
    """Return the numbers of the corners of a surface, or of the nodes of one of nodes."""
    sides = deck.surface(name)
    if sides is None:
        nodes = deck.node_sets.numbers(name)
        return np.zeros(0, dtype=np.int64) if nodes is None else np.intersect1d(nodes, deck.corner_nodes)
    corners = [deck.cell_table.side(*side)[0] for side in sides]
    known = [each for each in corners if each is not None]
    return np.unique(np.concatenate([np.zeros(0, dtype=np.int64), *known]))


def coinciding(deck: Deck, one: str, other: str) -> int:
    """Return how many nodes of one surface lie at the place of a node of another."""
    points = {tuple(np.round(deck.place[int(node)], 9)) for node in nodes_of_surface(deck, other)}
    return sum(tuple(np.round(deck.place[int(node)], 9)) in points for node in nodes_of_surface(deck, one))


def _meet(deck: Deck, one: str, other: str) -> bool:
    count = len(nodes_of_surface(deck, one))
    return count > 0 and coinciding(deck, one, other) == count
