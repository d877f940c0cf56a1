"""Refusals: models whose states cannot be carried to other cells."""

from turgor.core.model.model import Model
from turgor.foundation.errors import TurgorError


def refuse_remeshing(model: Model) -> None:
    """Refuse a model whose cells cannot be cut on the way.

    Parameters
    ----------
    model : Model

    Raises
    ------
    TurgorError
        Naming what cannot be carried over.
    """
    contact, mesh = model.contact, model.mesh
    frictions = [each.friction for each in contact.obstacles]
    frictions += [] if contact.self_contact is None else [contact.self_contact.friction]
    reasons = {
        "a film without a solid has no cells that could degrade": not len(mesh.cells),
        "cells of 20 nodes cannot be cut": mesh.cells.shape[1] == 20,
        "where contact sticks depends on the sides of the cells, so friction cannot be carried over": any(frictions),
        "liquid that flows through a channel cannot be carried over": any(load.channel for load in model.loads),
        "the damage of a bond cannot be carried over": bool(model.bonds),
    }
    for reason, holds in reasons.items():
        if holds:
            raise TurgorError(
                f"procedure.remesh: {reason}; leave remesh out, and mesh the body finer where it degrades."
            )
