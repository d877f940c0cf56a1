"""Parallel coordinates: many factors and a measure, a line for each design."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.path import Path
from numpy.typing import NDArray

from turgor.views.plots.studies.effects import SCALE
from turgor.views.plots.styling import INK, QUIET

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Coordinate:
    """An upright axis.

    Parameters
    ----------
    label : str
    values : sequence of float or str
        Of each design; names stand at equal distances.
    """

    label: str
    values: Sequence[float | str]

    @property
    def names(self) -> list[str]:
        """Names in their order; none for numbers."""
        return list(dict.fromkeys(each for each in self.values if isinstance(each, str)))

    @property
    def bounds(self) -> tuple[float, float]:
        """Lowest and highest value."""
        if self.names:
            return -0.5, len(self.names) - 0.5
        numbers = np.array(self.values, dtype=float)
        low, high = float(np.nanmin(numbers)), float(np.nanmax(numbers))
        return (low, high) if high > low else (low - 0.5, high + 0.5)

    @property
    def heights(self) -> Array:
        """Height of each design, 0 to 1; NaN where there is no value."""
        low, high = self.bounds
        numbers = [self.names.index(each) if isinstance(each, str) else each for each in self.values]
        return (np.array(numbers, dtype=float) - low) / (high - low)


def plot_parallel(axes: Axes, coordinates: Sequence[Coordinate]) -> Axes:
    """Plot designs as lines across upright axes, colored by the last one, which is the measure.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    coordinates : sequence of Coordinate
        At least two; designs without a value of the last one are gray.

    Returns
    -------
    matplotlib.axes.Axes

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> given = [Coordinate(label="wall [mm]", values=[1.0, 2.0]), Coordinate(label="angle [°]", values=[9.0, 3.0])]
    >>> len(plot_parallel(Figure().add_subplot(), given).patches)
    2
    """
    heights = np.array([each.heights for each in coordinates])
    last = heights[-1]
    for k in np.argsort(np.nan_to_num(last, nan=-1.0)):
        axes.add_patch(_line(axes, heights[:, k], float(last[k])))
    for k, each in enumerate(coordinates):
        _upright(axes, k, each, is_last=k == len(coordinates) - 1)
    axes.set_xlim(-0.25, len(coordinates) - 0.55)
    axes.set_ylim(-0.06, 1.06)
    axes.set_axis_off()
    return axes


def _line(axes: Axes, heights: Array, share: float) -> Any:
    """Make the line of a design: a smooth curve that is level at each axis, so that lines can be followed."""
    from matplotlib.patches import PathPatch

    known = np.isfinite(share)
    ends = heights if known else heights[:-1]
    points, codes = [(0.0, float(ends[0]))], [Path.MOVETO]
    for k in range(len(ends) - 1):
        points += [(k + 0.4, ends[k]), (k + 0.6, ends[k + 1]), (k + 1.0, ends[k + 1])]
        codes += [Path.CURVE4] * 3
    color = colormaps[SCALE](share) if known else QUIET
    return PathPatch(Path(points, codes), fill=False, lw=1.4, ls="-" if known else ":", edgecolor=color, alpha=0.85)


def _upright(axes: Axes, place: int, each: Coordinate, *, is_last: bool) -> None:
    axes.plot([place, place], [0, 1], color=INK, lw=1.1)
    axes.text(place, 1.05, each.label, ha="center", va="bottom", color=INK, fontsize=9, weight="bold")
    low, high = each.bounds
    if each.names:
        marks = [((k - low) / (high - low), name) for k, name in enumerate(each.names)]
    else:
        marks = [(share, f"{low + share * (high - low):.3g}") for share in (0.0, 0.5, 1.0)]
    offset, align = (0.03, "left") if is_last else (-0.03, "right")
    for height, text in marks:
        box = {"facecolor": "white", "edgecolor": "none", "alpha": 0.75, "pad": 1.0}
        axes.text(place + offset, height, text, ha=align, va="center", color=INK, fontsize=8, bbox=box)
