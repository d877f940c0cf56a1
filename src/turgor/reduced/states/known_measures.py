"""Known measures: the errors of measures at some answers, of the mesh of the full model and of the reduction."""

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def _no_rows() -> Array:
    return np.zeros((0, 0))


@dataclass(frozen=True, kw_only=True, eq=False)
class KnownMeasures:
    """Measures of a reduced model, with their errors at some inputs.

    Parameters
    ----------
    names : tuple of str
    inputs : (k, n) array [SI]
    values, mesh, reduction : (k, m) arrays [SI]
        Values of the answers, angles continued along the range; estimated error of the mesh of the full model;
        difference of the answer from the full model on the same mesh. Errors are nan where they are unknown.

    Examples
    --------
    >>> known = KnownMeasures(
    ...     names=("bending_angle",), inputs=np.array([[1e3], [2e3]]), values=np.array([[0.5], [1.0]]),
    ...     mesh=np.array([[0.01], [0.02]]), reduction=np.array([[2e-4], [1e-4]]),
    ... )
    >>> known.nearest(np.array([1.8e3]), np.array([1e3])), known.largest.tolist()
    (1, [0.0002])
    """

    names: tuple[str, ...] = ()
    inputs: Array = field(default_factory=_no_rows)
    values: Array = field(default_factory=_no_rows)
    mesh: Array = field(default_factory=_no_rows)
    reduction: Array = field(default_factory=_no_rows)

    def nearest(self, inputs: Array, widths: Array) -> int:
        """Row of the known inputs that are nearest to inputs (n,) with ranges of some widths (n,)."""
        return int(np.argmin(np.linalg.norm((self.inputs - inputs) / widths, axis=1)))

    @property
    def largest(self) -> Array:
        """Largest known errors (m,) of the reduction."""
        largest = np.where(np.isnan(self.reduction), -1.0, self.reduction).max(axis=0, initial=-1.0)
        return np.where(largest < 0, np.nan, largest)
