"""Hanging: a weight that hangs from a reference point."""

from collections.abc import Container
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from turgor.core.meshing.mesh import Mesh
from turgor.core.model.history import RAMP, History, checked
from turgor.core.model.loads.gravity import STANDARD_GRAVITY, fall_direction
from turgor.core.model.loads.images import check_symmetric
from turgor.core.model.loads.load import Array, Deck, DeckRows, Load, NodalForces
from turgor.foundation.errors import TurgorError
from turgor.foundation.given import Quantities, Quantity, number


@dataclass(frozen=True, slots=True)
class Hanging(Load):
    """A weight that hangs from a reference point: its weight is a dead load, and its mass moves with the point.

    Parameters
    ----------
    point : str
        Name of the `ReferencePoint`.
    mass : float [kg]
        Of the whole actuator; 0 or more. `Gravity` gives it no second weight.
    direction : (3,) floats
        Direction of the fall; any length but zero.
    acceleration : float [m/s²]
        That of gravity.
    history : sequence of (float, float), or str, optional
        As that of a `Pressure`: the share of the weight. The inertia is always there.

    Raises
    ------
    TurgorError
        If the mass is negative, the direction is none, or the history is none.

    Examples
    --------
    >>> Hanging("plate", 0.1).force
    (0.0, 0.0, -0.980665)
    """

    point: str
    mass: float
    direction: tuple[float, float, float] = (0.0, 0.0, -1.0)
    acceleration: float = STANDARD_GRAVITY
    history: History = RAMP

    if TYPE_CHECKING:

        def __init__(
            self,
            point: str,
            mass: Quantity,
            direction: Quantities = (0, 0, -1),
            acceleration: Quantity = STANDARD_GRAVITY,
            history: History = RAMP,
        ) -> None: ...

    def __post_init__(self) -> None:
        what = f"weight on '{self.point}'"
        object.__setattr__(self, "mass", number(self.mass, f"{what}: mass", "mass"))
        object.__setattr__(self, "acceleration", number(self.acceleration, f"{what}: acceleration", "acceleration"))
        if self.mass < 0:
            raise TurgorError(f"{what}: mass is {self.mass} kg; allowed is 0 or more.")
        object.__setattr__(self, "direction", fall_direction(self.direction, what))
        object.__setattr__(self, "history", checked(self.history, what, starting=True))

    @property
    def force(self) -> tuple[float, float, float]:
        """The whole weight [N]."""
        weight = self.mass * self.acceleration / float(np.linalg.norm(self.direction))
        x, y, z = (0.0 + weight * part for part in self.direction)
        return x, y, z

    @property
    def arrow(self) -> tuple[float, float, float]:
        """The weight."""
        return self.force

    @property
    def words(self) -> str:
        """Mass, point and direction."""
        along = ", ".join(f"{part:g}" for part in self.direction)
        return f"Weight of {self.mass:g} kg hanging from {self.point}, along ({along})"

    @property
    def attached_mass(self) -> float:
        """The mass, which moves with the point [kg]."""
        return self.mass

    def mirrored(self, axis: int) -> bool:
        """Whether it does not pull across the plane."""
        return not self.force[axis]

    def check(self, mesh: Mesh, points: Container[str]) -> None:
        """Refuse an unknown point, and a weight that is not the same on all images of a modeled part."""
        check_symmetric(mesh, f"weight on '{self.point}': {{:g}} N", self.force)
        Load.check(self, mesh, points)

    def dead_forces(self, nodal: NodalForces) -> Array:
        """Return the nodal forces of the whole weight."""
        return nodal.of_total(self.point, self.force)

    def deck_rows(self, deck: Deck) -> tuple[DeckRows, ...]:
        """Return the rows of a force on the point."""
        return (DeckRows("*CLOAD", self.history, deck.force(self.point, self.force)),)
