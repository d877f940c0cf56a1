"""States of bodies as Abaqus and CalculiX write them: a thermal expansion, and a temperature from 0 to 1.

The temperature of these programs belongs to the nodes, and bodies that touch share nodes. All bodies therefore have the
same one, the share of their states, and each has its own strain as its expansion.
"""

from math import prod

from turgor.core.model.model import Model
from turgor.foundation.errors import TurgorError


def expansion_lines(model: Model, body: str) -> list[str]:
    """Return the expansion of the material of a body; empty where nothing makes it grow."""
    states = [load for load in model.states_of(body) if load.growth is not None]
    if not states:
        return []
    return ["*EXPANSION, ZERO=0.", f"{prod(1 + (load.growth or 0.0) for load in states) - 1:.12g}"]


def initial_lines(model: Model) -> list[str]:
    """Return the temperature at which all bodies have the shape of the mesh; empty where nothing grows.

    Raises
    ------
    TurgorError
        If states have different histories, or one is that of a sheet or a winding.
    """
    windings = {fibers.name for fibers in model.reinforcements}
    for load in (load for load in model.loads if load.of_bodies):
        what = "sheet" if load.place in model.membranes else "winding" if load.place in windings else ""
        if what:
            raise TurgorError(f"{load.label} is the state of a {what}, which has no form in .inp files; leave it out.")
    histories = {load.history for load in model.loads if load.growth is not None}
    if len(histories) > 1:
        labels = " and ".join(load.label for load in model.loads if load.growth is not None)
        raise TurgorError(
            f"{labels} have different histories; .inp files have one temperature for all bodies, so give them the same "
            "one."
        )
    if not histories:
        return []
    note = "** temperature: share of the shrinkage, swelling and expansion of bodies, from 0 to 1"
    return [note, "*INITIAL CONDITIONS, TYPE=TEMPERATURE", "Nall, 0."]
