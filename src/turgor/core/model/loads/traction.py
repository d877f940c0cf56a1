"""Traction: a dead load per reference area."""

from collections.abc import Container
from dataclasses import dataclass
from typing import TYPE_CHECKING

from turgor.core.meshing.mesh import Mesh
from turgor.core.model.history import RAMP, History, checked
from turgor.core.model.loads.images import check_sectors
from turgor.core.model.loads.load import Array, Deck, DeckRows, Load, NodalForces
from turgor.foundation.given import Quantities, vector
from turgor.foundation.given import name as name_of
from turgor.units import kPa


@dataclass(frozen=True, slots=True)
class Traction(Load):
    """Dead load on a face: force per reference area, fixed in direction.

    Parameters
    ----------
    face : str
        Name of the face.
    vector : (3,) floats [Pa]
        Force per reference area, all of it.
    history : sequence of (float, float), or str, optional
        As that of a `Pressure`.
    """

    face: str
    vector: tuple[float, float, float]
    history: History = RAMP

    if TYPE_CHECKING:

        def __init__(self, face: str, vector: Quantities, history: History = RAMP) -> None: ...

    def __post_init__(self) -> None:
        subject = f"traction on '{name_of(self.face, 'face of a traction', 'tip')}'"
        object.__setattr__(self, "vector", vector(self.vector, subject, "pressure"))
        object.__setattr__(self, "history", checked(self.history, subject, starting=True))

    @property
    def words(self) -> str:
        """The vector and the face."""
        parts = ", ".join(f"{part / kPa:g}" for part in self.vector)
        return f"Traction ({parts}) kPa on {self.face}, fixed in direction"

    def turned(self, axis: int) -> bool:
        """Whether it acts along the axis."""
        return not any(self.vector[across] for across in range(3) if across != axis)

    def check(self, mesh: Mesh, points: Container[str]) -> None:
        """Refuse an unknown face, and a traction across the axis of a wedge."""
        check_sectors(mesh, f"traction on '{self.face}': {{:g}} Pa", self.vector)
        Load.check(self, mesh, points)

    def dead_forces(self, nodal: NodalForces) -> Array:
        """Return the nodal forces of the whole traction."""
        return nodal.on_face(self.face, self.vector)

    def deck_rows(self, deck: Deck) -> tuple[DeckRows, ...]:
        """Return the rows of its forces on the nodes of the face."""
        return (DeckRows("*CLOAD", self.history, deck.spread(self.face, self.vector, per_area=True)),)
