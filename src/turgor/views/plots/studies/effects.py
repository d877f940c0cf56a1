"""Effects of a factor: a measure against its levels, with mesh errors, and where these hide the effect."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from numpy.typing import NDArray

from turgor.views.plots.settings import PLOT
from turgor.views.plots.styling import INK, QUIET, style_axes

Array = NDArray[np.float64]

#: Colors of ordered levels.
SCALE = "viridis"

#: Words for the segments that mesh errors hide.
HIDDEN = "difference within the mesh error"


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Effect:
    """A measure at the levels of a factor, everything else being equal.

    Parameters
    ----------
    label : str
        Name in the legend.
    values : (n,) array
        In the unit of the axis; NaN where a run failed.
    errors : (n,) array
        Mesh errors; NaN where none is known.
    """

    label: str
    values: Array
    errors: Array

    @property
    def hidden(self) -> NDArray[np.bool_]:
        """Whether each difference between neighbors is smaller than their mesh errors together, (n − 1,)."""
        return np.abs(np.diff(self.values)) < self.errors[:-1] + self.errors[1:]


def shades(count: int) -> list[Any]:
    """Return colors of levels in their order, from dark to light."""
    return [colormaps[SCALE](share) for share in np.linspace(0.0, PLOT.lightest_level, max(count, 2))][:count]


def plot_effects(axes: Axes, levels: Sequence[float | str], effects: Sequence[Effect], x: str, y: str) -> Axes:
    """Plot effects as lines with bars for mesh errors; a difference that these hide is dotted.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    levels : sequence of float or str
        In the unit of the axis; names stand at equal distances.
    effects : sequence of Effect
    x, y : str
        Labels of the axes.

    Returns
    -------
    matplotlib.axes.Axes

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> effect = Effect(label="", values=np.array([9.0, 3.0]), errors=np.array([0.1, 0.1]))
    >>> plot_effects(Figure().add_subplot(), [1.0, 2.0], [effect], "wall [mm]", "angle [°]").get_xlabel()
    'wall [mm]'
    """
    named = any(isinstance(each, str) for each in levels)
    at = np.arange(len(levels)) if named else np.array(levels, dtype=float)
    if named:
        axes.set_xticks(at, labels=[_wrapped(str(each)) for each in levels])
        axes.set_xlim(-0.4, len(levels) - 0.6)
    elif len(at) <= PLOT.levels:
        axes.set_xticks(at, labels=[f"{each:.4g}" for each in at])
    labeled = False
    for color, each in zip(shades(len(effects)), effects, strict=True):
        known = np.where(np.isfinite(each.errors), each.errors, 0.0)
        bars = known if known.any() else None
        axes.errorbar(at, each.values, yerr=bars, fmt="o", ms=4.5, capsize=3, lw=1.2, color=color, label=each.label)
        for k, hidden in enumerate(each.hidden):
            style = {"ls": ":", "color": QUIET, "lw": 1.8} if hidden else {"ls": "-", "color": color, "lw": 1.6}
            label = HIDDEN if hidden and not labeled else None
            labeled = labeled or bool(hidden)
            axes.plot(at[k : k + 2], each.values[k : k + 2], label=label, zorder=1.5, **style)
    axes.set_xlabel(x, color=INK)
    axes.set_ylabel(y, color=INK)
    style_axes(axes)
    return axes


def _wrapped(text: str) -> str:
    """Break a record in two lines, at its slash."""
    return text.replace("/", "/\n", 1)
