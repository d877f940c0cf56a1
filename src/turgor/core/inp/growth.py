"""States of bodies as Abaqus and CalculiX write them: a thermal expansion, and a temperature from 0 to 1.

The temperature of these programs belongs to the nodes, and bodies that touch share nodes. All bodies therefore have the
same one, the share of their states, and each has its own strain as its expansion.
"""

from collections.abc import Sequence
from math import prod

from turgor.core.model.model import Model
from turgor.foundation.errors import TurgorError


def expansion_lines(model: Model, body: str) -> list[str]:
    """Return the expansion of the material of a body; empty where nothing makes it grow."""
    states = [load for load in model.states_of(body) if load.growth is not None]
    if not states:
        return []
    return ["*EXPANSION, ZERO=0.", f"{prod(1 + (load.growth or 0.0) for load in states) - 1:.12g}"]


def initial_lines(models: Sequence[Model]) -> tuple[list[str], Model]:
    """Return the temperature at which all bodies have the shape of the mesh, and a stage with the states of bodies.

    Parameters
    ----------
    models : sequence of Model
        Those of the stages.

    Raises
    ------
    TurgorError
        If states have different histories, others come in a later stage, or one is that of a sheet or a winding.
    """
    windings = {fibers.name for fibers in models[0].reinforcements}
    for load in (load for model in models for load in model.loads if load.of_bodies):
        what = "sheet" if load.place in models[0].membranes else "winding" if load.place in windings else ""
        if what:
            raise TurgorError(f"{load.label} is the state of a {what}, which has no form in .inp files; leave it out.")
    growing = [[load for load in model.loads if load.growth is not None] for model in models]
    first = next((k for k, loads in enumerate(growing) if loads), None)
    if first is None:
        return [], models[0]
    labels = " and ".join(load.label for load in growing[first])
    for loads in growing[first:]:
        if [(load.label, load.growth) for load in loads] != [(load.label, load.growth) for load in growing[first]]:
            raise TurgorError(
                f"{labels} change in a later stage; .inp files have one temperature for all bodies, which would change "
                "them all alike. Write a file for each."
            )
        if len({load.history for load in loads}) > 1:
            raise TurgorError(
                f"{labels} have different histories; .inp files have one temperature for all bodies, so give them the "
                "same one."
            )
    note = "** temperature: share of the shrinkage, swelling and expansion of bodies, from 0 to 1"
    return [note, "*INITIAL CONDITIONS, TYPE=TEMPERATURE", "Nall, 0."], models[first]
