"""Symmetry: a mirror plane."""

from dataclasses import dataclass

from turgor.core.meshing.mesh import Mesh
from turgor.core.model.loads.load import Deck
from turgor.core.model.supports.support import Support, coordinate_plane


@dataclass(frozen=True, slots=True)
class Symmetry(Support):
    """Mirror plane: no displacement along the normal of a plane face aligned with the axes.

    Faces named ``symmetry_*`` get this support by themselves.
    """

    face: str

    jumps = False
    mirror = True
    in_sections = True

    def text(self) -> str:
        """Return the sentence of a report."""
        return f"{self.face} is a mirror plane."

    def components(self, mesh: Mesh) -> list[int]:
        """Return the axis along its normal."""
        return [coordinate_plane(mesh, self.face, "a mirror plane")]

    def boundary_rows(self, deck: Deck) -> tuple[str, ...]:
        """Return a row for the face, or for those of its nodes that follow no point."""
        return deck.mirror_plane(self.face)
