"""Convergence: one measure on finer and finer meshes, extrapolated to a mesh size of zero."""

from dataclasses import dataclass
from math import floor, log10

import numpy as np
from numpy.typing import NDArray

from turgor.core.results.convergence.extrapolation import Extrapolation, extrapolate
from turgor.core.results.measures.measures import Measure
from turgor.foundation.display import brief
from turgor.foundation.errors import TurgorError
from turgor.foundation.response import COLUMN_UNITS, Column, Response
from turgor.foundation.source import Source

Array = NDArray[np.float64]

#: What a sequence means, by the word that `extrapolate` gives it.
_WORDS = {
    "converging": "",
    "equal": " The values are equal on all meshes.",
    "fast": " The values come closer faster than these cells can (order 4): the last two agree better than they "
    "should, so the extrapolation uses order 4.",
    "slow": " The order is so low that nothing can be extrapolated: the error is the spread of the last three values. "
    "Use finer meshes.",
    "diverging": " The values do not come closer to each other: they have no limit yet, or none at all (stress at a "
    "sharp corner has none). The error is their spread; use finer meshes.",
    "not monotone": " The values go up and down, so nothing can be extrapolated: the error is the spread of the last "
    "three. Use sizes further apart, or finer ones.",
}


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Convergence:
    """One measure on finer and finer meshes.

    The meshes are unstructured, so their edges are only about as long as the size. The order is therefore observed
    against the effective size, the size of the first mesh times the cube root of the ratio of the numbers of cells.

    Parameters
    ----------
    measure : Measure
        What was measured, at the whole load.
    sizes : (n,) array [m]
        Mesh sizes, from coarse to fine, three or more.
    cells, unknowns : (n,) int arrays
        Counts of each mesh.
    values : (n,) array [SI]
        The measure on each mesh.

    Raises
    ------
    TurgorError
        If there are fewer than three meshes or they do not get finer.

    Examples
    --------
    >>> from turgor.core.results.measures.standard_measures import bending_angle
    >>> cells = np.array([1000, 8000, 64000])
    >>> angles = np.array([0.9, 0.98, 0.996])
    >>> study = Convergence(
    ...     measure=bending_angle, sizes=np.array([4e-3, 2e-3, 1e-3]), cells=cells, unknowns=20 * cells, values=angles
    ... )
    >>> print(study.summary)
    Extrapolated bending angle 57.30 deg; the finest mesh gives 57.07 deg, with an estimated error of 0.29 deg \
(0.5 %); observed order 2.32.
    """

    measure: Measure
    sizes: Array
    cells: NDArray[np.int64]
    unknowns: NDArray[np.int64]
    values: Array

    __repr__ = brief

    def __post_init__(self) -> None:
        if len(self.sizes) < 3:
            raise TurgorError(f"{len(self.sizes)} mesh sizes are given; at least three are needed to observe an order.")
        if not (np.diff(self.cells) > 0).all():
            shown = ", ".join(map(str, self.cells))
            raise TurgorError(
                f"the meshes have {shown} cells; each needs more than the one before. Use sizes that get smaller and "
                "differ by a factor of 1.3 or more: small details can fix the cells whatever the size."
            )

    @property
    def effective_sizes(self) -> Array:
        """Sizes by the number of cells, (n,) [m]."""
        return np.asarray(self.sizes[0] * np.cbrt(self.cells[0] / self.cells))

    @property
    def extrapolation(self) -> Extrapolation:
        """Order, extrapolated value and error of the finest mesh."""
        return extrapolate(self.effective_sizes, self.values)

    @property
    def response(self) -> Response:
        """The study as a table: sizes, counts and the measure, a row for each mesh."""
        return Response(
            columns=(
                Column("mesh_size", "mm", self.sizes),
                Column("effective_size", "mm", self.effective_sizes),
                Column("cells", "", self.cells.astype(np.float64)),
                Column("unknowns", "", self.unknowns.astype(np.float64)),
                Column(self.measure.name, self.measure.unit, self.values),
            ),
            source=Source(text="finite elements", detail=f"{len(self.sizes)} meshes"),
            message=self.summary,
        )

    @property
    def summary(self) -> str:
        """The result in a sentence or two."""
        limit, name, finest = self.extrapolation, self.measure.name.replace("_", " "), float(self.values[-1])
        error, shown = self._error_text(limit.error, finest), self._text(finest, limit.error)
        order = f"observed order {limit.order:.3g}" if limit.order is not None else ""
        if not limit.reliable:
            text = f"The finest mesh gives {name} {shown}, with an error of about {error}"
            return f"{text}, {order}.{_WORDS[limit.trust]}" if order else f"{text}.{_WORDS[limit.trust]}"
        text = f"Extrapolated {name} {self._text(limit.value, limit.error)}; the finest mesh gives {shown}"
        return f"{text}, with an estimated error of {error}{f'; {order}' if order else ''}.{_WORDS[limit.trust]}"

    def _text(self, value: float, error: float) -> str:
        """A value with as many digits as its error allows to tell apart, six where there is no error."""
        unit = COLUMN_UNITS[self.measure.unit]
        if not error:
            return f"{value / unit:.6g} {self.measure.unit}".rstrip()
        decimals = min(max(1 - floor(log10(error / unit)), 0), 12)
        return f"{value / unit:.{decimals}f} {self.measure.unit}".rstrip()

    def _error_text(self, error: float, value: float) -> str:
        shown = f"{error / COLUMN_UNITS[self.measure.unit]:.2g} {self.measure.unit}".rstrip()
        return f"{shown} ({100 * error / abs(value):.2g} %)" if value else shown
