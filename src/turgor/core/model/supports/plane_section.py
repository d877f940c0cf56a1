"""PlaneSection: a cut through a longer body that stays plane."""

from dataclasses import dataclass

from turgor.core.model.supports.support import Support


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

    def text(self) -> str:
        """Return the sentence of a report."""
        return f"{self.face} stays plane and is free to move along its normal."
