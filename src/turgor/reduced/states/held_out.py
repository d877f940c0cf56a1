"""Held-out states: full solves that training never saw, and the errors of a reduced model there."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class HeldOutErrors:
    """Full solves that training never saw, and how far the reduced model is from them.

    Parameters
    ----------
    inputs : (h, n) array [SI]
    displacement : (h,) array [-]
        Largest error of the displacement of a node, over the largest displacement of all training states; inf where
        the reduced model refused.
    tip : (h,) array [-]
        Error of the mean displacement of the face ``tip`` over its travel; zeros without such a face.
    volume : (h,) array [-]
        Largest error of the volume of a cavity, over that volume.
    force : (h,) array [-]
        Largest error of the force on an obstacle, over the largest force in training; zeros without obstacles.
    """

    inputs: Array
    displacement: Array
    tip: Array
    volume: Array
    force: Array

    @property
    def worst(self) -> float:
        """Largest error of the displacement; nan where nothing was solved in full."""
        return float(self.displacement.max()) if len(self.displacement) else float("nan")
