"""PlaneSection: a cut through a longer body that stays plane."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, ClassVar

from turgor.core.meshing.mesh import Mesh
from turgor.core.model.loads.load import Deck
from turgor.core.model.supports.support import Support, coordinate_plane
from turgor.foundation.errors import TurgorError


@dataclass(frozen=True, slots=True)
class PlaneSection(Support):
    """Keep a plane cross-section plane: all its points move along its normal by the same amount, which is free.

    The face is a cut through a longer body, such as a length of a tube far from its ends. It slides along its normal
    without tilting; within it the points are free. A pressure in a cavity that the face cuts through also pushes on
    the opening, as on the closed end of the body (generalized plane strain with an end cap).

    Parameters
    ----------
    face : str
        Name of a plane face with its normal along x, y or z.
    """

    face: str

    jumps = False
    job_texts: ClassVar[Mapping[str, Mapping[str, Any]]] = {"plane section": {}}

    def text(self) -> str:
        """Return the sentence of a report."""
        return f"{self.face} stays plane and is free to move along its normal."

    def section_axis(self, mesh: Mesh) -> int:
        """Return the axis along its normal."""
        return coordinate_plane(mesh, self.face, "a plane section")

    def boundary_rows(self, deck: Deck) -> tuple[str, ...]:
        """Refuse: a pressure pushes on the opening of the cavity, too."""
        raise TurgorError(
            f"'{self.face}' is a plane section, whose thrust .inp files cannot say; hold it or leave it free."
        )
