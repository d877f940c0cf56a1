"""Force: a dead load of a known total on a face, an edge, a node or a box, or a force on a reference point."""

from collections.abc import Container
from dataclasses import dataclass
from typing import TYPE_CHECKING

from turgor.core.meshing.mesh import Mesh
from turgor.core.model.history import RAMP, History, checked
from turgor.core.model.loads.images import check_symmetric
from turgor.core.model.loads.load import Array, Deck, DeckRows, Load, NodalForces, Turning
from turgor.core.model.places import NodesAt, checked_face, described
from turgor.foundation.errors import TurgorError
from turgor.foundation.given import Quantities, vector


@dataclass(frozen=True, slots=True)
class Force(Load):
    """Dead load of a known total on a face or a place: spread over it at rest and fixed in direction.

    A weight that hangs from a face, a pull by a long thread, a push by a soft spring. The inertia of what hangs there
    is not included; that of a `Hanging` weight is. On a `ReferencePoint` the force acts at the point. `NodesAt` says
    how it is spread over an edge, a node or a box.

    Parameters
    ----------
    face : str or NodesAt
        Name of the face, or of a reference point. Or an edge, a node or the nodes in a box.
    vector : (3,) floats [N]
        The whole force, on the whole actuator: where a half is modeled, its mirror image carries the other half.
    history : sequence of (float, float), or str, optional
        As that of a `Pressure`.
    follower : bool
        Whether the force turns with the reference point on which it acts, and is stated as it is at rest.

    Raises
    ------
    TurgorError
        If the history is none, or the force is not finite.

    Examples
    --------
    >>> Force("tip", (0, 0, -0.05 * 9.80665)).share(0.5)
    0.5
    """

    face: str | NodesAt
    vector: tuple[float, float, float]
    history: History = RAMP
    follower: bool = False

    at_places = True

    if TYPE_CHECKING:

        def __init__(
            self, face: str | NodesAt, vector: Quantities, history: History = RAMP, follower: bool = False
        ) -> None: ...

    def __post_init__(self) -> None:
        subject = f"force on '{checked_face(self.face, 'face of a force', 'tip')}'"
        object.__setattr__(self, "vector", vector(self.vector, subject, "force"))
        object.__setattr__(self, "history", checked(self.history, subject, starting=True))

    @property
    def words(self) -> str:
        """The vector and the face or point."""
        parts = ", ".join(f"{part:.6g}" for part in self.vector)
        way = "turning with the point" if self.follower else "fixed in direction"
        return f"Force ({parts}) N on {described(self.face)}, {way}"

    @property
    def outside(self) -> bool:
        """Whether it is a dead force; one that turns with its point has no share in the work on outside loads."""
        return not self.follower

    def mirrored(self, axis: int) -> bool:
        """Whether it does not point across the plane."""
        return not self.vector[axis]

    def check(self, mesh: Mesh, points: Container[str]) -> None:
        """Refuse an unknown face or point, a follower force on a face, and a force without a mirror image."""
        if self.face not in points:
            if self.follower:
                raise TurgorError(
                    f"force on '{self.place}': only a force on a reference point can follow its rotation; tie the face "
                    "to a ReferencePoint, or take a Pressure."
                )
            if isinstance(self.face, NodesAt):
                self.face.nodes(mesh)
            else:
                mesh.face(self.face)
        check_symmetric(mesh, f"force on '{self.place}': {{:g}} N", self.vector)

    def dead_forces(self, nodal: NodalForces) -> Array | None:
        """Return the nodal forces of the whole force; None if it turns with its point."""
        return None if self.follower else nodal.of_total(self.face, self.vector)

    @property
    def turning(self) -> Turning | None:
        """The force, if it turns with its point."""
        return Turning(self.place, self.vector, False, True) if self.follower else None

    def deck_rows(self, deck: Deck) -> tuple[DeckRows, ...]:
        """Return the rows of a force on a reference point, or on the nodes of a face or place."""
        if self.follower:
            raise TurgorError(f"the force on '{self.place}' follows it; that has no form in .inp files; leave it out.")
        at_point = isinstance(self.face, str) and self.face in deck.masses
        rows = deck.force(self.place, self.vector) if at_point else deck.spread(self.face, self.vector)
        return (DeckRows("*CLOAD", self.history, rows),)
