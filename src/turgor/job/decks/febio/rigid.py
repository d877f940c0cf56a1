"""Rigid bodies of a .feb file: nodes of deformable cells that follow one, where it does not turn."""

from collections.abc import Iterator, Sequence

from turgor.core.meshing.exchange.formats.abaqus import Keyword
from turgor.foundation.errors import TurgorError
from turgor.job.decks.febio.elements import Element
from turgor.job.decks.febio.prescribed import DIRECTIONS, Prescribed

#: Rotations of a rigid body.
TURNS = ("Ru", "Rv", "Rw")


def rigid_rows(state: Prescribed, body: Element, nodes: Sequence[int], rules: Sequence[Element]) -> Iterator[Keyword]:
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
    """
    if not nodes:
        yield body.unneeded("no node of a deformable cell follows this rigid body")
        yield from (rule.unneeded("no node of a deformable cell follows this rigid body") for rule in rules)
        return
    try:
        stays = {word for rule in rules for word in _fixed(rule)}
        moves = {rule.word("dof"): rule for rule in rules if _is_move(rule)}
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
    yield body.unneeded("a rigid body; the nodes that follow it have supports")
    yield from _prescribe(state, nodes, rules)


def _prescribe(state: Prescribed, nodes: Sequence[int], rules: Sequence[Element]) -> Iterator[Keyword]:
    for rule in rules:
        freedoms = [DIRECTIONS[word[1].lower()] for word in _fixed(rule) if word not in TURNS]
        if freedoms:
            yield rule.keyword("boundary", [f"{node}, {freedom}" for freedom in freedoms for node in nodes])
        elif _is_move(rule) and rule.word("dof") not in TURNS:
            value = rule.first("value", "scale")
            if value is None:
                rule.fail("it has no <value>.")
            factor, name, rows = state.amplitude(value, starts=False)
            freedom = DIRECTIONS[rule.word("dof")[1].lower()]
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


def _is_move(rule: Element) -> bool:
    return rule.given.get("type") in ("rigid_displacement", "rigid_rotation", "prescribe")


def _still(rule: Element) -> bool:
    value = rule.first("value", "scale")
    return value is not None and not any(value.numbers())
