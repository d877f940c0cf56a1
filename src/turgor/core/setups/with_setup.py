"""with_setup: the model that a setup makes, whichever setup it is."""

from collections.abc import Callable

from turgor.core.model.model import Model
from turgor.core.setups.blocked_tip import blocked, directed, settled
from turgor.core.setups.grasped_object import grasped
from turgor.core.setups.setup_values import BlockedForce, Setup


def with_setup(model: Model, setup: Setup | None, notify: Callable[[str], None] | None = None) -> Model:
    """Return a model with what a setup adds to it, as it is where there is none.

    Parameters
    ----------
    model : Model
        The actuator on its own.
    setup : BlockedForce or Grasp, optional
    notify : callable, optional
        Where notices of the engine go.

    Returns
    -------
    Model
    """
    if setup is None:
        return model
    return blocked(model, setup, notify) if isinstance(setup, BlockedForce) else grasped(model, setup)


def with_choices(setup: Setup | None, model: Model) -> Setup | None:
    """Return a setup that states what was chosen when its model was made.

    Parameters
    ----------
    setup : BlockedForce or Grasp, optional
    model : Model
        Of `with_setup`.

    Returns
    -------
    BlockedForce, Grasp or None
    """
    return settled(setup, model) if isinstance(setup, BlockedForce) else setup


def with_direction(setup: Setup | None, model: Model) -> Setup | None:
    """Return a setup that states the direction found in its model, for others of nearly the same actuator.

    Parameters
    ----------
    setup : BlockedForce or Grasp, optional
    model : Model
        Of `with_setup`.

    Returns
    -------
    BlockedForce, Grasp or None
    """
    return directed(setup, model) if isinstance(setup, BlockedForce) else setup
