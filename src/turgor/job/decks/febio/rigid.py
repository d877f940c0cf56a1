"""Rigid bodies of a .feb file: nodes of deformable cells that follow one, where it does not turn."""

from collections.abc import Iterator, Sequence

import numpy as np

from turgor.core.meshing.exchange.formats.abaqus import Keyword
from turgor.foundation.errors import TurgorError
from turgor.job.decks.febio.elements import Element
from turgor.job.decks.febio.meshes import FebMesh
from turgor.job.decks.febio.prescribed import DIRECTIONS, Prescribed

#: Rotations of a rigid body.
TURNS = ("Ru", "Rv", "Rw")


def name_obstacles(mesh: FebMesh, rigid: Sequence[str]) -> None:
    """Give each rigid part of solid cells that a contact names, and that shares no node, two nodes for its motion."""
    soft = mesh.nodes_in(part for part in mesh.parts if part not in rigid)
    touched = {n for pair in mesh.pairs.values() for name in pair for facet in mesh.facets.get(name, ()) for n in facet}
    for part in rigid:
        own = mesh.nodes_in([part])
        others = mesh.nodes_in(each for each in rigid if each != part)
        if mesh.solids[part] and own & touched and not own & (soft | others):
            last = max(mesh.points)
            center = tuple(np.mean([mesh.points[node] for node in sorted(own)], axis=0).tolist())
            mesh.points |= {last + 1: center, last + 2: center}
            mesh.obstacles[part] = last + 1, last + 2


def rigid_rows(
    state: Prescribed, body: Element, nodes: Sequence[int], rules: Sequence[Element], obstacles: Sequence[str] = ()
) -> Iterator[Keyword]:
    """Keywords of one rigid body: its nodes stay, or go the way of the body.

    Parameters
    ----------
    state : Prescribed
    body : Element
        Its material.
    nodes : sequence of int
        Nodes that it shares with deformable cells, or that are tied to it.
    rules : sequence of Element
        What is prescribed for it.
    obstacles : sequence of str
        Its parts that others touch.
    """
    references = [state.mesh.obstacles[part] for part in obstacles]
    nodes = [*nodes, *(first for first, _ in references)]
    if not nodes:
        yield body.unneeded("no node of a deformable cell follows this rigid body")
        yield from (rule.unneeded("no node of a deformable cell follows this rigid body") for rule in rules)
        return
    try:
        stays = {word for rule in rules for word in _fixed(rule)}
        moves = {_moved(rule): rule for rule in rules if _is_move(rule)}
        others = [rule for rule in rules if not _is_move(rule) and not _fixed(rule)]
        if others:
            raise TurgorError(f"{others[0].label} in line {others[0].line} has no form here.")
        free = [word for word in ("Rx", "Ry", "Rz", *TURNS) if word not in stays and word not in moves]
        turning = [word for word in moves if word in TURNS and not _still(moves[word])]
        if free or turning:
            raise TurgorError(
                f"a rigid body that turns or is free ({', '.join(free or turning)}) has no form here; "
                "one that stays or is shifted has."
            )
    except TurgorError as error:
        yield body.missing(str(error))
        return
    if not obstacles:
        yield body.unneeded("a rigid body; the nodes that follow it have supports")
    for part, (first, second) in zip(obstacles, references, strict=True):
        yield body.keyword("rigid body", [], {"elset": part, "ref node": str(first), "rot node": str(second)})
        yield body.keyword("boundary", [f"{second}, 1, 3"])
    yield from _prescribe(state, nodes, rules)


def _prescribe(state: Prescribed, nodes: Sequence[int], rules: Sequence[Element]) -> Iterator[Keyword]:
    for rule in rules:
        freedoms = [DIRECTIONS[word[1].lower()] for word in _fixed(rule) if word not in TURNS]
        if freedoms:
            yield rule.keyword("boundary", [f"{node}, {freedom}" for freedom in freedoms for node in nodes])
        elif _is_move(rule) and _moved(rule) not in TURNS:
            value = rule.first("value", "scale")
            if value is None:
                rule.fail("it has no <value>.")
            factor, name, rows = state.amplitude(value, starts=False)
            freedom = DIRECTIONS[_moved(rule)[1].lower()]
            yield from rows
            yield rule.keyword(
                "boundary", [f"{node}, {freedom}, {freedom}, {factor!r}" for node in nodes], {"amplitude": name}
            )
        else:
            yield rule.unneeded("it stops the body from turning")


def _fixed(rule: Element) -> list[str]:
    """Degrees of freedom that a rule fixes: ``<Rx_dof>1</Rx_dof>`` of FEBio 4, ``<dofs>`` of FEBio 3."""
    if rule.given.get("type") not in ("rigid_fixed", "fix"):
        return []
    words = [word for word in rule.word("dofs").replace(" ", "").split(",") if word]
    return words + [each.tag[:2] for each in rule.children if each.tag.endswith("_dof") and each.text.strip() == "1"]


def _moved(rule: Element) -> str:
    """Degree of freedom that a rule moves; some files write ``z`` for ``Rz``."""
    word = rule.word("dof")
    return f"R{word}" if len(word) == 1 else word


def _is_move(rule: Element) -> bool:
    return rule.given.get("type") in ("rigid_displacement", "rigid_rotation", "prescribe")


def _still(rule: Element) -> bool:
    value = rule.first("value", "scale")
    return value is not None and not any(value.numbers())
