"""LineForce: a dead load along the edge between two faces."""

from collections.abc import Container
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from turgor.core.meshing.mesh import Mesh
from turgor.core.model.history import RAMP, History, checked
from turgor.core.model.loads.images import refuse_in_sectors
from turgor.core.model.loads.load import Array, Load, NodalForces
from turgor.core.model.places import NodesAt
from turgor.foundation.errors import TurgorError
from turgor.foundation.given import Quantities, vector


@dataclass(frozen=True, slots=True)
class LineForce(Load):
    """Dead load along the edge between two faces: force per reference length, fixed in direction.

    Parameters
    ----------
    faces : (str, str)
        Two faces that meet along the line.
    vector : (3,) floats [N/m]
        Force per length at rest, on the whole actuator.
    history : sequence of (float, float), or str, optional
        As that of a `Pressure`.

    Raises
    ------
    TurgorError
        If the history is none, the faces are not two, or a number is not finite.

    Examples
    --------
    >>> LineForce(("tip", "outside"), (0, 0, -2.0)).faces
    ('tip', 'outside')
    """

    faces: tuple[str, str]
    vector: tuple[float, float, float] = field(metadata={"dimension": "force per length", "key": "force_per_length"})
    history: History = RAMP

    job_key = "line_forces"
    spread = False

    if TYPE_CHECKING:

        def __init__(self, faces: tuple[str, str], vector: Quantities, history: History = RAMP) -> None: ...

    def __post_init__(self) -> None:
        object.__setattr__(self, "faces", tuple(self.faces))
        if len(set(self.faces)) != 2:
            raise TurgorError(f"line force: faces is {self.faces!r}; two faces are needed that meet along the line.")
        object.__setattr__(
            self, "vector", vector(self.vector, f"line force on {' and '.join(self.faces)}", "force per length")
        )
        object.__setattr__(self, "history", checked(self.history, "line force", starting=True))

    @property
    def place(self) -> str:
        """Both faces."""
        return " and ".join(self.faces)

    @property
    def spot(self) -> NodesAt:
        """The nodes that both faces have."""
        return NodesAt("line", edge=self.faces)

    @property
    def label(self) -> str:
        """Its class; two faces would be long."""
        return "LineForce"

    @property
    def named_faces(self) -> tuple[str, ...]:
        """Both faces."""
        return self.faces

    @property
    def words(self) -> str:
        """The vector and the faces."""
        return f"Force ({', '.join(f'{part:g}' for part in self.vector)}) N/m along the edge between {self.place}"

    def turned(self, axis: int) -> bool:
        """An edge may end anywhere."""
        return False

    def check(self, mesh: Mesh, points: Container[str]) -> None:
        """Refuse sectors of a wedge and unknown faces; whether these meet is checked by the equations."""
        refuse_in_sectors(mesh, "a line force")
        for name in self.faces:
            mesh.face(name)

    def dead_forces(self, nodal: NodalForces) -> Array:
        """Return the forces on the nodes of the edge."""
        return nodal.along_edge(self.faces, self.vector)
