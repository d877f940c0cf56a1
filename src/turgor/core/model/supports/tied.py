"""Tied: a face whose nodes follow another one, whatever the cells of both are."""

from dataclasses import dataclass

from turgor.core.meshing.mesh import Mesh
from turgor.core.model.loads.load import Deck
from turgor.core.model.supports.support import Support
from turgor.foundation.errors import TurgorError
from turgor.foundation.given import name


@dataclass(frozen=True, slots=True)
class Tied(Support):
    """Tie a face to another one that it lies on: its nodes follow the sides of the other, whose cells may be others.

    The nodes of the face have the displacement of the other face at their place, by its shape functions; nodes that lie
    on no side of it stay free. Tie the finer face to the coarser one: where its sides are parts of those of the other,
    both are one body; where they are not, stress is uneven by the size of a side at the tie. Sides that are tied touch
    nothing; what is left of both faces may.

    Parameters
    ----------
    face : str
        Face whose nodes follow.
    to : str
        Face that they follow.

    Raises
    ------
    TurgorError
        If both are the same, or the part is one of a body of revolution or a sector.

    Examples
    --------
    >>> Tied("lid_below", "block_top").text()
    'lid_below is tied to block_top.'
    """

    face: str
    to: str

    def __post_init__(self) -> None:
        name(self.face, "face of a tie", "lid_below")
        name(self.to, f"tie of '{self.face}': to", "block_top")
        if self.face == self.to:
            raise TurgorError(f"tie of '{self.face}': it cannot follow itself; to is another face.")

    @property
    def named_faces(self) -> tuple[str, ...]:
        """Both faces."""
        return self.face, self.to

    @property
    def tied(self) -> tuple[str, str]:
        """Face that follows, and the one that it follows."""
        return self.face, self.to

    def text(self) -> str:
        """Return the sentence of a report."""
        return f"{self.face} is tied to {self.to}."

    def check(self, mesh: Mesh) -> None:
        """Refuse parts of a body of revolution and sectors."""
        if mesh.revolved or mesh.wedge is not None:
            raise TurgorError(
                f"tie of '{self.face}': a part of a body of revolution or a sector cannot have one; model the whole "
                'part (symmetry = "none"), or mesh both faces alike.'
            )

    def boundary_rows(self, deck: Deck) -> tuple[str, ...]:
        """Refuse: the file has sides of other cells."""
        raise TurgorError(f"the tie of '{self.face}' has no form in .inp files yet; mesh both faces alike.")

    def job_text(self) -> dict[str, object]:
        """Return the table with the face that it follows."""
        return {"tied_to": self.to}
