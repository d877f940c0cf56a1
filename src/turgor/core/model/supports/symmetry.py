"""Symmetry: a mirror plane."""

from dataclasses import dataclass

from turgor.core.model.supports.support import Support


@dataclass(frozen=True, slots=True)
class Symmetry(Support):
    """Mirror plane: no displacement along the normal of a plane face aligned with the axes.

    Faces named ``symmetry_*`` get this support by themselves.
    """

    face: str

    jumps = False

    def text(self) -> str:
        """Return the sentence of a report."""
        return f"{self.face} is a mirror plane."
