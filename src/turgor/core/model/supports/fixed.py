"""Fixed: a face, or a reference point, without displacement."""

from dataclasses import dataclass

from turgor.core.model.loads.load import Deck
from turgor.core.model.supports.displacement import Displacement, Shift
from turgor.core.model.supports.support import Support, check_directions
from turgor.foundation.given import name


@dataclass(frozen=True, slots=True)
class Fixed(Support):
    """Hold a face: no displacement in the chosen directions.

    Parameters
    ----------
    face : str
        Name of the face, or of a `ReferencePoint`, which then stays where it is and may still turn.
    directions : str
        Which components are fixed, any of ``"x"``, ``"y"``, ``"z"``.
    """

    face: str
    directions: str = "xyz"

    def __post_init__(self) -> None:
        name(self.face, "face of a support", "fixed")
        check_directions(self.directions, f"support of '{self.face}'")

    @property
    def prescribed(self) -> tuple[str, str]:
        """The face and the directions."""
        return self.face, self.directions

    def text(self) -> str:
        """Return the sentence of a report."""
        return f"{self.face} does not move in {', '.join(self.directions)}."

    def boundary_rows(self, deck: Deck) -> tuple[str, ...]:
        """Return a row for each direction."""
        return deck.fixed(self.face, self.directions)

    def job_text(self) -> str:
        """Return the directions."""
        return self.directions

    def as_moved(self) -> Displacement:
        """Return a displacement of zero."""
        return Displacement(self.face, Shift((0.0, 0.0, 0.0)), self.directions)
