"""States of a path and the same states on a second mesh: the mesh error follows from both."""

from collections.abc import Mapping
from dataclasses import dataclass
from math import sqrt

from turgor.accuracy.adaptivity.settings import MESH_ERROR
from turgor.core.solvers.solution import State


@dataclass(frozen=True, slots=True, eq=False)
class PairedStates:
    """States of a path on a second, finer mesh.

    Parameters
    ----------
    pairs : mapping of int to State
        By their number in the path.
    moved : mapping of int to float
        Relative difference of the displacements of each.
    unknowns : int
        Of the second mesh.
    remaining : float
        Squared error in energy on the second mesh over that on the first one, by the indicator.
    seconds : float [s]
    """

    pairs: Mapping[int, State]
    moved: Mapping[int, float]
    unknowns: int
    remaining: float
    seconds: float

    def factor(self, local: bool) -> float:
        """Estimated error over difference.

        Errors of displacements and volumes fall with the squared error in energy, those of stresses and stretches at
        points (``local``) with its root.
        """
        remaining = min(self.remaining, MESH_ERROR.most_remaining)
        return 1 / (1 - (sqrt(remaining) if local else remaining))
