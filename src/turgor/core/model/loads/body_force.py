"""BodyForce: a force per reference volume as a function of position."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.core.model.history import RAMP, History, checked
from turgor.core.model.loads.load import Array, Load, NodalForces


@dataclass(frozen=True, slots=True)
class BodyForce(Load):
    """Force per reference volume given as a function of the reference position, for manufactured solutions.

    Parameters
    ----------
    value : callable
        ``value(points) -> (n, 3) force per volume [N/m³]`` at the (n, 3) reference points [m].
    history : sequence of (float, float), or str, optional
        As that of a `Pressure`.
    """

    value: Callable[[NDArray[np.float64]], NDArray[np.float64]]
    history: History = RAMP

    def __post_init__(self) -> None:
        object.__setattr__(self, "history", checked(self.history, "body force", starting=True))

    @property
    def words(self) -> str:
        """What it is; the function has no words."""
        return "Force per volume, given as a function of position"

    @property
    def outside(self) -> bool:
        """Not an outside load: it is for manufactured solutions."""
        return False

    def dead_forces(self, nodal: NodalForces) -> Array:
        """Return the nodal forces of the whole force."""
        return nodal.per_volume(self.value)
