"""Fixed: a face, or a reference point, without displacement."""

from dataclasses import dataclass

from turgor.core.model.loads.load import Deck
from turgor.core.model.places import NodesAt, checked_face, described
from turgor.core.model.supports.displacement import Displacement, Shift
from turgor.core.model.supports.support import Support, check_directions


@dataclass(frozen=True, slots=True)
class Fixed(Support):
    """Hold a face: no displacement in the chosen directions.

    Parameters
    ----------
    face : str or NodesAt
        Name of the face, or of a `ReferencePoint`, which then stays where it is and may still turn. Or an edge, a
        node or the nodes in a box.
    directions : str
        Which components are fixed, any of ``"x"``, ``"y"``, ``"z"``.
    """

    face: str | NodesAt
    directions: str = "xyz"

    at_places = True

    def __post_init__(self) -> None:
        checked_face(self.face, "face of a support", "fixed")
        check_directions(self.directions, f"support of '{self.place}'")

    @property
    def prescribed(self) -> tuple[str, str]:
        """The face and the directions."""
        return self.place, self.directions

    def text(self) -> str:
        """Return the sentence of a report."""
        return f"{described(self.face)} does not move in {', '.join(self.directions)}."

    def boundary_rows(self, deck: Deck) -> tuple[str, ...]:
        """Return a row for each direction."""
        return deck.fixed(self.face, self.directions)

    def job_text(self) -> str | dict[str, object]:
        """Return the directions, with the place where that is no face."""
        if isinstance(self.face, NodesAt):
            return self.face.table() | {"directions": self.directions}
        return self.directions

    def as_moved(self) -> Displacement:
        """Return a displacement of zero."""
        return Displacement(self.face, Shift((0.0, 0.0, 0.0)), self.directions)
