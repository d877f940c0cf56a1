"""Contact: self-contact of the actuator, and contact with rigid obstacles."""

from collections.abc import Iterable, Sequence
from copy import copy
from dataclasses import dataclass, replace

from turgor.core.meshing.mesh import Mesh
from turgor.core.meshing.quality.self_contact import may_meet
from turgor.core.model.obstacles import Obstacle, SelfContact
from turgor.foundation.errors import TurgorError
from turgor.foundation.given import number, one, several

#: Name of the results of the contact of the actuator with itself.
SELF = "self"


@dataclass(frozen=True, slots=True, init=False)
class Contact:
    """Contact of an actuator with itself and with rigid obstacles.

    Parameters
    ----------
    self_contact : SelfContact or bool, optional
        Whether walls of the actuator have contact with each other. By default they do if outer walls, or a wall and its
        image in a mirror plane, face each other across a gap at rest, as chambers and folds do; if the mesh has several
        bodies or consists of films; and in cavities that are pressed together.
    obstacles : sequence of Obstacle
        Rigid bodies around.
    tolerance : float [-]
        Deepest penetration as a share of the height of the cell behind the surface, which is the thickness of a wall
        that is one cell thick; 1e-4 to 0.1. The penalty is raised until the tolerance is met.

    Raises
    ------
    TurgorError
        If two obstacles share a name, or the tolerance is out of its range.

    Examples
    --------
    >>> Contact().tolerance
    0.01
    """

    self_contact: SelfContact | None
    automatic: bool
    obstacles: tuple[Obstacle, ...]
    tolerance: float

    def __init__(
        self,
        self_contact: SelfContact | bool | None = None,
        obstacles: Obstacle | Iterable[Obstacle] = (),
        tolerance: float = 0.01,
    ) -> None:
        one(self_contact, SelfContact | bool | None, "self_contact", "a SelfContact, True or False is needed")
        given = SelfContact() if self_contact is None or self_contact is True else (self_contact or None)
        object.__setattr__(self, "self_contact", given)
        object.__setattr__(self, "automatic", self_contact is None)
        bodies = several(obstacles, Obstacle, "obstacles", "an Obstacle is needed")
        object.__setattr__(self, "obstacles", bodies)
        object.__setattr__(self, "tolerance", number(tolerance, "contact: tolerance"))
        names = [SELF, *(obstacle.name for obstacle in self.obstacles)]
        for name in names:
            if names.count(name) > 1:
                raise TurgorError(f"obstacle '{name}': the name is taken; every obstacle needs one of its own.")
        if not 1e-4 <= self.tolerance <= 0.1:
            raise TurgorError(f"contact: tolerance is {self.tolerance:g}; allowed is 0.0001 to 0.1 of the wall.")

    def with_obstacles(self, obstacles: Sequence[Obstacle]) -> "Contact":
        """Return a contact with other obstacles and the rest as it was."""
        own = self.self_contact
        changed = Contact(None if self.automatic else own or False, obstacles, self.tolerance)
        return changed if own is None or own.cavities is None else changed.with_cavities(own.cavities)

    def with_cavities(self, cavities: tuple[str, ...]) -> "Contact":
        """Return a contact in which the walls of stated cavities may touch within, and the rest as it was."""
        changed = copy(self)
        own = None if self.self_contact is None else replace(self.self_contact, cavities=cavities)
        object.__setattr__(changed, "self_contact", own)
        return changed

    def for_mesh(self, mesh: Mesh) -> SelfContact | None:
        """Return the self-contact of a mesh; None where there is none."""
        if not self.automatic or self.self_contact is None:
            return self.self_contact
        return self.self_contact if may_meet(mesh) else None
