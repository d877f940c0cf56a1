"""Contact and ties of a .feb file as keywords of a deck."""

from collections.abc import Iterator

from turgor.core.meshing.exchange.formats.abaqus import Keyword
from turgor.foundation.errors import TurgorError, near_match
from turgor.job.decks.febio.elements import Element
from turgor.job.decks.febio.prescribed import Prescribed, surface_named

#: Contact of FEBio that slides, and contact that ties.
SLIDING = ("sliding-elastic", "sliding-node-on-facet", "sliding-facet-on-facet")
TIED = ("tied-elastic", "tied-node-on-facet", "tied-facet-on-facet")


def contact_rows(state: Prescribed, contact: Element) -> Iterator[Keyword]:
    """Keywords of one contact."""
    kind = contact.given.get("type", "")
    pair = contact.given.get("surface_pair", "")
    if kind not in (*SLIDING, *TIED):
        yield contact.missing(
            f"contact of the type '{kind}' has no form here; these have one: {', '.join((*SLIDING, *TIED))}."
        )
        return
    if pair not in state.mesh.pairs:
        contact.fail(f"there is no surface pair '{pair}'{near_match(pair, state.mesh.pairs) or '.'}")
    try:
        names = []
        for each in state.mesh.pairs[pair]:
            name, rows = surface_named(state, contact, each)
            names.append(name)
            yield from rows
    except TurgorError as error:
        yield contact.missing(str(error))
        return
    if kind in TIED:
        yield contact.keyword("tie", [", ".join(names)], {"name": pair})
        return
    if contact.number("tension", 0.0):
        yield contact.missing("contact that may pull has no form here.")
        return
    hard = state.mesh.nodes_in(state.mesh.obstacles)
    first = state.mesh.facet_rows(contact, state.mesh.pairs[pair][0])
    if all(node in hard for facet in first for node in facet):
        names.reverse()  # a deck names the rigid one last
    yield contact.keyword("surface interaction", [], {"name": pair})
    yield contact.keyword("friction", [repr(contact.number("fric_coeff", 0.0))])
    yield contact.keyword("contact pair", [", ".join(names)], {"interaction": pair})
