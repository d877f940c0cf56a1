"""Gravity: the weight of every region, of every sheet that has a density, and of every reference point."""

from collections.abc import Container
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from turgor.core.meshing.mesh import Mesh
from turgor.core.model.history import RAMP, History, checked
from turgor.core.model.loads.images import check_symmetric
from turgor.core.model.loads.load import Array, Deck, DeckRows, Load, NodalForces, Vector
from turgor.foundation.errors import TurgorError
from turgor.foundation.given import Quantities, Quantity, number, vector
from turgor.units import mm

STANDARD_GRAVITY = 9.80665


@dataclass(frozen=True, slots=True)
class Gravity(Load):
    """Weight of every region, of every sheet that has a density, and of the mass of every reference point.

    Parameters
    ----------
    direction : (3,) floats
        Direction of the fall; normalized.
    acceleration : float [m/s²]
        Its magnitude.
    history : sequence of (float, float), or str, optional
        As that of a `Pressure`: ``[(0, 0), (0.2, 1), (1, 1)]`` lets the weight act first, and then stay.

    Raises
    ------
    TurgorError
        If the history is none.

    Examples
    --------
    >>> Gravity((0, 0, -1), history=[(0, 0), (0.2, 1), (1, 1)]).share(0.5)
    1.0
    """

    direction: tuple[float, float, float] = (0.0, 0.0, -1.0)
    acceleration: float = STANDARD_GRAVITY
    history: History = RAMP

    needs_density = True

    if TYPE_CHECKING:

        def __init__(
            self, direction: Quantities = (0, 0, -1), acceleration: Quantity = STANDARD_GRAVITY, history: History = RAMP
        ) -> None: ...

    def __post_init__(self) -> None:
        object.__setattr__(self, "direction", fall_direction(self.direction, "gravity"))
        object.__setattr__(self, "acceleration", number(self.acceleration, "gravity: acceleration", "acceleration"))
        object.__setattr__(self, "history", checked(self.history, "gravity", starting=True))

    @property
    def falling(self) -> Vector:
        """Acceleration as a vector [m/s²]."""
        x, y, z = (0.0 + self.acceleration * part / float(np.linalg.norm(self.direction)) for part in self.direction)
        return x, y, z

    @property
    def place(self) -> str:
        """No place: it acts on everything."""
        return ""

    @property
    def words(self) -> str:
        """Acceleration and direction."""
        return f"Gravity {self.acceleration:g} m/s² along ({', '.join(f'{part:.4g}' for part in self.direction)})"

    @property
    def outside(self) -> bool:
        """Not an outside load: the weight is that of the actuator itself."""
        return False

    def mirrored(self, axis: int) -> bool:
        """Whether it does not pull across the plane."""
        return not self.direction[axis]

    def check(self, mesh: Mesh, points: Container[str]) -> None:
        """Refuse a weight that is not the same on all images of a modeled part."""
        check_symmetric(mesh, "gravity: a weight of {:.3g}", self.direction)

    def dead_forces(self, nodal: NodalForces) -> Array:
        """Return the nodal forces of the whole weight."""
        return nodal.of_weight(self.falling)

    def deck_rows(self, deck: Deck) -> tuple[DeckRows, ...]:
        """Return the rows of the weight of all cells, and of that of the reference points."""
        direction = np.array(self.direction) / np.linalg.norm(self.direction)
        values = ", ".join(f"{value:.12g}" for value in (self.acceleration / mm, *direction))
        points = [deck.force(name, mass * np.array(self.falling)) for name, mass in deck.masses.items()]
        cells = DeckRows("*DLOAD", self.history, (f"Eall, GRAV, {values}",))
        return (cells, DeckRows("*CLOAD", self.history, sum(points, ())))


def fall_direction(value: object, what: str) -> Vector:
    """Return the direction of a fall, of any length but zero.

    Parameters
    ----------
    value : object
        Three numbers.
    what : str
        Whose direction it is, for the message.
    """
    direction = vector(value, f"{what}: direction")
    if not np.linalg.norm(direction) > 0:
        raise TurgorError(f"{what}: direction is a zero vector; give for example (0, 0, -1).")
    return direction
