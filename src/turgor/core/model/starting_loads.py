"""Loads that are there from the start: the model of what acts at load factor 0, before anything else does."""

from dataclasses import replace

from turgor.core.model.continued_model import continued
from turgor.core.model.history import starts, with_history
from turgor.core.model.loads import Load
from turgor.core.model.model import Model


def starting_loads(model: Model) -> tuple[Load, ...]:
    """Return the loads whose share at load factor 0 is not zero."""
    return tuple(load for load in model.loads if starts(load.history))


def at_start(model: Model) -> Model | None:
    """Return the model whose equilibrium at load factor 1 is that of another model at load factor 0.

    Faces, points and obstacles that move stay where they are at first.

    Parameters
    ----------
    model : Model

    Returns
    -------
    Model or None
        None where no load is there from the start: the body then begins at rest.
    """
    present = starting_loads(model)
    if not present:
        return None
    bare = replace(model, loads=tuple(load for load in model.loads if load not in present))
    return continued(bare, (0.0, {}), [with_history(load, ((0.0, 0.0), (1.0, load.share(0.0)))) for load in present])
