"""Plots of a law: its stress in the tests of a rubber, solid where it was fitted and dashed where it is not known."""

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

from turgor.errors import TurgorError, unknown
from turgor.materials.laws.curves import Curve, curve
from turgor.materials.laws.laws import Law
from turgor.results.plots.response_plots import INK, QUIET
from turgor.units import MPa, kPa

Array = NDArray[np.float64]

#: A color for each test; two stresses of one test share it.
COLORS = {"uniaxial": "#1f5fa8", "equibiaxial": "#b3421f", "planar": "#2f7d4f", "simple_shear": "#7a4fa3"}
STRESSES = {"nominal": "nominal_stress", "cauchy": "cauchy_stress"}

_POINTS = 400


def plot_curves(
    axes: Axes,
    law: Law,
    modes: Sequence[str] = ("uniaxial", "equibiaxial", "planar"),
    fitted_range: tuple[float, float] | None = None,
    *,
    stretch: tuple[float, float] = (0.5, 4.0),
    stress: str = "nominal",
) -> Axes:
    """Plot the stress of a law over stretch, a line for each test, with the loss of stability marked by a cross.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
        Where to draw; several laws may share it.
    law : Law
        The law.
    modes : sequence of str
        Tests to draw: ``"uniaxial"``, ``"equibiaxial"``, ``"planar"``, ``"simple_shear"``, which goes over the amount
        of shear with the range of stretch less 1.
    fitted_range : (float, float) or None [-]
        Stretches that the law was fitted to, as in ``Material.stretch_range``: solid inside, dashed outside. None
        where it is not known: all solid.
    stretch : (float, float) [-]
        Range to draw.
    stress : str
        ``"nominal"`` or ``"cauchy"``.

    Returns
    -------
    matplotlib.axes.Axes
        The axes that were given.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> from turgor.materials.laws.laws import Yeoh
    >>> axes = plot_curves(Figure().add_subplot(), Yeoh(C10=0.11e6, C20=0.02e6), ["uniaxial"], (1.0, 3.0))
    >>> [line.get_linestyle() for line in axes.lines], axes.get_ylabel()
    (['--', '-'], 'nominal stress [MPa]')
    """
    if stress not in STRESSES:
        raise unknown("stress", stress, STRESSES)
    low, high = stretch
    if not 0 < low < high < np.inf:
        raise TurgorError(f"the range of stretch is {low:g} to {high:g}; it must rise and lie above 0.")
    curves = []
    for mode in modes:
        if mode not in COLORS:
            raise unknown("mode", mode, COLORS)
        shift = 1.0 if mode == "simple_shear" else 0.0
        curves.append(curve(law, mode, np.linspace(low - shift, high - shift, _POINTS)))  # type: ignore[arg-type]
    size = max((float(np.nanmax(np.abs(getattr(c, STRESSES[stress])), initial=0.0)) for c in curves), default=0.0)
    unit, name = (MPa, "MPa") if size >= 0.1 * MPa else (kPa, "kPa")
    for each in curves:
        _draw(axes, each, getattr(each, STRESSES[stress]) / unit, fitted_range)
    axes.set_xlabel("stretch [-]" if "simple_shear" not in modes else "stretch, amount of shear [-]", color=INK)
    axes.set_ylabel(f"{'nominal' if stress == 'nominal' else 'Cauchy'} stress [{name}]", color=INK)
    axes.spines[["top", "right"]].set_visible(False)
    axes.spines[["left", "bottom"]].set_color(QUIET)
    axes.tick_params(colors=INK, color=QUIET)
    axes.grid(True, color=QUIET, alpha=0.25, lw=0.6)
    axes.set_axisbelow(True)
    return axes


def _draw(axes: Axes, drawn: Curve, values: Array, fitted_range: tuple[float, float] | None) -> None:
    color, label = COLORS[drawn.mode], drawn.mode.replace("_", " ")
    inside = drawn.inside(fitted_range)
    if not inside.all():
        axes.plot(drawn.stretch, values, "--", color=color, lw=1.2, label=None if inside.any() else label)
    if inside.any():
        axes.plot(drawn.stretch, np.where(inside, values, np.nan), "-", color=color, lw=1.8, label=label)
    if drawn.instability is not None:
        height = np.interp(drawn.instability, drawn.stretch, values)
        axes.plot([drawn.instability], [height], "x", color=color, ms=7, mew=1.8)
