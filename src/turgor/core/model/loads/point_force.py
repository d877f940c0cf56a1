"""PointForce: a dead load at a point of the surface."""

from collections.abc import Container
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from turgor.core.meshing.mesh import Mesh
from turgor.core.model.history import RAMP, History, checked
from turgor.core.model.loads.images import refuse_in_sectors
from turgor.core.model.loads.load import Array, Load, NodalForces
from turgor.foundation.given import Quantities, vector
from turgor.units import mm


@dataclass(frozen=True, slots=True)
class PointForce(Load):
    """Dead load at a point of the surface: fixed in direction, carried by the side of a cell on which the point lies.

    The deformation at the point itself depends on the mesh, as that of any body under a point load does.

    Parameters
    ----------
    at : (3,) floats [m]
        Where it acts at rest, up to 1 % of the size of the part away from the surface.
    vector : (3,) floats [N]
        The force at this point. On a mirror plane the modeled part carries its share; elsewhere the mirror image of the
        point carries the mirror image of the force.
    history : sequence of (float, float), or str, optional
        As that of a `Pressure`.

    Raises
    ------
    TurgorError
        If the history is none, or a number is not finite.

    Examples
    --------
    >>> PointForce((0.1, 0, 0.02), (0, 0, -0.3)).vector
    (0.0, 0.0, -0.3)
    """

    at: tuple[float, float, float] = field(metadata={"dimension": "length"})
    vector: tuple[float, float, float] = field(metadata={"dimension": "force", "key": "force"})
    history: History = RAMP

    job_key = "point_forces"

    if TYPE_CHECKING:

        def __init__(self, at: Quantities, vector: Quantities, history: History = RAMP) -> None: ...

    def __post_init__(self) -> None:
        object.__setattr__(self, "at", vector(self.at, "point force: at", "length"))
        object.__setattr__(self, "vector", vector(self.vector, "point force", "force"))
        object.__setattr__(self, "history", checked(self.history, "point force", starting=True))

    @property
    def place(self) -> str:
        """The point."""
        return str(self.at)

    @property
    def spot(self) -> tuple[float, float, float]:
        """The point."""
        return self.at

    @property
    def label(self) -> str:
        """Its class; the point would be long."""
        return "PointForce"

    @property
    def words(self) -> str:
        """The vector and the point."""
        at = ", ".join(f"{part / mm:g}" for part in self.at)
        return f"Force ({', '.join(f'{part:g}' for part in self.vector)}) N at ({at}) mm on the surface"

    def turned(self, axis: int) -> bool:
        """A point off the axis is elsewhere after a turn."""
        return False

    def check(self, mesh: Mesh, points: Container[str]) -> None:
        """Refuse sectors of a wedge; whether the point is on the surface is checked by the equations."""
        refuse_in_sectors(mesh, "a point force")

    def dead_forces(self, nodal: NodalForces) -> Array:
        """Return the forces on the nodes around the point."""
        return nodal.at_point(self.at, self.vector)
