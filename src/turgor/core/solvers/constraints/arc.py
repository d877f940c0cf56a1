"""Arc: the tangent of a path in displacements and load factor, along which an arc length is measured."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.core.solvers.constraints.elimination import Conditions

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class Arc:
    """A unit tangent of a path.

    Parameters
    ----------
    row : (size,) array
        Derivatives of the length by the unknowns: the tangent times the weights of the unknowns.
    rise : float
        Derivative by the load factor.
    """

    row: Array
    rise: float

    @staticmethod
    def along(change: Array, rise: float, weights: Array) -> "Arc":
        """The tangent with the direction of changes of unknowns and load factor.

        Examples
        --------
        >>> Arc.along(np.array([3.0, 0.0]), 2.0, np.array([0.25, 0.25]))  # lengths are 1.5 and 2
        Arc(row=array([0.3, 0. ]), rise=0.8)
        """
        norm = float(np.sqrt(weights @ change**2 + rise**2))
        return Arc(weights * change / norm, rise / norm)

    def length(self, change: Array, rise: float) -> float:
        """Length of a change along the tangent."""
        return float(self.row @ change + self.rise * rise)

    def conditions(self, change: Array, rise: float, length: float) -> Conditions:
        """Error of the length of a change, and its derivatives."""
        return Conditions(np.array([self.length(change, rise) - length]), self.row[None, :], np.array([[self.rise]]))
