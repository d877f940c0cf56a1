"""Channel flow: which cavities a procedure closes because channels lead to them, and the conditions for these."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from turgor.core.model.loads.channel import closed_cavities
from turgor.core.model.model import Model
from turgor.foundation.errors import TurgorError

Array = NDArray[np.float64]


def refuse_channels(model: Model, name: str) -> None:
    """Refuse channels in a procedure that has no time, or seeks other unknowns.

    Parameters
    ----------
    model : Model
    name : str
        Class of the procedure.
    """
    for load in model.loads:
        if load.channel is not None:
            raise TurgorError(
                f"the channel between {load.place} needs time, and {name} has none for it; take static or "
                "volume_control with procedure.duration, or dynamic."
            )


def closed_by_channels(model: Model, duration: float | None, name: str = "static") -> tuple[str, ...]:
    """Name the cavities whose pressure is unknown, because liquid flows into them through channels.

    Parameters
    ----------
    model : Model
    duration : float or None [s]
        That of the procedure.
    name : str
        Type of the procedure.

    Raises
    ------
    TurgorError
        If there is no duration, or a channel connects two stated pressures.
    """
    if duration is None:
        refuse_channels(model, f"{name} without procedure.duration")
    closed = closed_cavities(model.loads)
    for load in model.loads:
        if load.channel is not None and not set(load.channel.between) & set(closed):
            raise TurgorError(
                f"the channel between {load.place} moves nothing, because both have a pressure load; leave that of "
                "the cavity out into which the liquid flows."
            )
    return closed


def channel_target(chambers: Any, volumes: Array, duration: float, injected: Array | None = None) -> Any:
    """Return the conditions for the pressures of closed cavities from their scaled volumes at the start.

    Parameters
    ----------
    chambers : Chambers
    volumes : (k,) array
    duration : float [s]
    injected : (k,) array, optional
        Scaled volumes that are injected in this time.
    """
    from turgor.core.solvers.constraints.channels import ChannelTarget  # here: it needs the engine
    from turgor.core.solvers.continuation.scalar_control.settings import CAVITY_CONTROL

    least = CAVITY_CONTROL.no_volume * float(np.ptp(chambers.system.points, axis=0).prod())
    given = np.zeros_like(volumes) if injected is None else injected
    return ChannelTarget(chambers, duration, max(float(volumes.max()), least), given, ((0.0, volumes),))
