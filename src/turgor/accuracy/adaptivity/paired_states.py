"""States of a path and the same states on a second mesh: the mesh error follows from both."""

from collections.abc import Mapping
from dataclasses import dataclass

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
    factor : float
        Estimated error over difference.
    seconds : float [s]
    """

    pairs: Mapping[int, State]
    moved: Mapping[int, float]
    unknowns: int
    factor: float
    seconds: float
