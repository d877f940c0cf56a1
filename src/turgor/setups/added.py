"""with_setup: the model that a setup makes, whichever setup it is."""

from turgor.model.model import Model
from turgor.setups.blocked_tip import blocked
from turgor.setups.grasped_object import grasped
from turgor.setups.values import BlockedForce, Setup


def with_setup(model: Model, setup: Setup | None) -> Model:
    """Return a model with what a setup adds to it, as it is where there is none.

    Parameters
    ----------
    model : Model
        The actuator on its own.
    setup : BlockedForce or Grasp, optional

    Returns
    -------
    Model
    """
    if setup is None:
        return model
    return blocked(model, setup) if isinstance(setup, BlockedForce) else grasped(model, setup)
