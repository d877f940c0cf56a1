"""Plots of material tests and fitted laws: measured, used and removed points, and the curves of the laws."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from turgor.core.materials.experiments.material_test import MaterialTest
from turgor.core.materials.fitting.fit_directions import DirectionsFit
from turgor.core.materials.fitting.fit_woven import WovenFit
from turgor.core.materials.fitting.result import Fit
from turgor.core.materials.laws.homogeneous import DEFORMATIONS, nominal_stress
from turgor.foundation.errors import TurgorError
from turgor.units import MPa
from turgor.views.plots.figures import PlotFigure, write_figure
from turgor.views.plots.settings import PLOT
from turgor.views.plots.styling import INK, QUIET, style_axes

#: Colors of laws, in turn, distinct for color-blind readers too (mostly Okabe and Ito 2008).
COLORS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#6d4c41", "#000000")

#: Headings of panels.
TITLES = {
    "uniaxial": "Uniaxial",
    "equibiaxial": "Equibiaxial",
    "planar": "Planar (pure shear)",
    "simple_shear": "Simple shear",
    "biaxial": "General biaxial",
}


def plot_test(axes: Axes, test: MaterialTest, *, color: str = INK) -> Axes:
    """Plot a test: raw points pale, removed ones crossed, used ones filled, the band of replicates behind them.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
        Where to draw.
    test : MaterialTest
        The test; its edits hold the removed points.
    color : str
        Color of the points that are used.
    """
    raw = test.raw or test
    removed = [edit for edit in test.edits if len(edit.stretch)]
    if test.raw is not None:
        axes.plot(raw.stretch, raw.nominal_stress / MPa, ".", color="#c3c9d1", ms=3, label="raw", zorder=1)
    if removed:
        stretch = np.concatenate([edit.stretch for edit in removed])
        stress = np.concatenate([edit.nominal_stress for edit in removed])
        every = -(-len(stretch) // PLOT.marks)
        stretch, stress = stretch[::every], stress[::every] / MPa
        axes.plot(stretch, stress, "x", color="#b3402a", ms=3.5, mew=0.7, alpha=0.7, label="removed", zorder=2)
    if test.spread is not None:
        low, high = test.nominal_stress - test.spread, test.nominal_stress + test.spread
        axes.fill_between(
            test.stretch, low / MPa, high / MPa, color=color, alpha=0.15, lw=0, label="± 1 standard deviation"
        )
    axes.plot(
        test.stretch, test.nominal_stress / MPa, "o", color=color, ms=3.5, alpha=0.55, mew=0, label="used", zorder=3
    )
    return _styled(axes, test.mode)


def plot_law(axes: Axes, fit: Fit, mode: str, upto: float, *, color: str) -> Axes:
    """Plot the nominal stress of a fitted law in a mode, solid where it was fitted in this mode, dashed elsewhere.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
        Where to draw.
    fit : Fit
        The fitted law.
    mode : str
        ``uniaxial``, ``equibiaxial``, ``planar`` or ``simple_shear``.
    upto : float [-]
        Largest stretch, or amount of shear, to draw to.
    color : str
        Color of the curve.
    """
    ranges = [test.range for test in fit.tests if test.mode == mode]
    rest = 0.0 if mode == "simple_shear" else 1.0
    low = min([rest, *(lowest for lowest, _ in ranges)])
    fitted = (low, max([rest, *(highest for _, highest in ranges)]))
    grid = np.linspace(low, max(upto, fitted[1]), PLOT.curve_points)
    component = (0, 1) if mode == "simple_shear" else (0, 0)
    stress = nominal_stress(fit.law, DEFORMATIONS[mode](grid))[:, component[0], component[1]] / MPa
    inside = (grid >= fitted[0]) & (grid <= fitted[1] * (1 + 1e-9))
    if inside.sum() > 1:
        axes.plot(grid[inside], stress[inside], "-", color=color, lw=1.5, label=fit.spec.name, zorder=4)
    last = int(inside.sum()) - 1
    beyond = grid >= grid[max(last, 0)]
    if beyond.sum() > 1:
        label = None if inside.sum() > 1 else f"{fit.spec.name}, predicted"
        axes.plot(grid[beyond], stress[beyond], "--", color=color, lw=1.2, label=label, zorder=4)
    return _styled(axes, mode)


def plot_biaxial(axes: Axes, fit: Fit, test: MaterialTest, *, color: str) -> Axes:
    """Plot predicted against measured stress of a biaxial test, because no single curve shows a field of points.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
        Where to draw.
    fit : Fit
        The fitted law.
    test : MaterialTest
        The biaxial test.
    color : str
        Color of the points.
    """
    measured = test.measured / MPa
    axes.plot(measured, test.predicted(fit.law) / MPa, ".", color=color, ms=4, label=fit.spec.name)
    _styled(axes, "biaxial")
    axes.set_xlabel("measured nominal stress [MPa]", color=INK)
    axes.set_ylabel("fitted nominal stress [MPa]", color=INK)
    return axes


def fit_figure(fits: Sequence[Fit], tests: Sequence[MaterialTest] = (), *, title: str = "") -> Figure:
    """Draw fits against their tests, one panel for each mode.

    Parameters
    ----------
    fits : sequence of Fit
        Fits to the same tests, one color each.
    tests : sequence of MaterialTest
        Tests to show besides the fitted ones, to see what the laws predict there.
    title : str
        Line above the panels.
    """
    if not fits:
        raise TurgorError("no fit was given; there is nothing to plot.")
    shown = (*fits[0].tests, *tests)
    modes = list(dict.fromkeys(test.mode for test in shown))
    columns = min(len(modes), 3)
    rows = -(-len(modes) // columns)
    figure = PlotFigure(figsize=(max(4.6 * columns, 6.0), 3.6 * rows + 0.5))
    for number, mode in enumerate(modes):
        axes = figure.add_subplot(rows, columns, number + 1)
        of_mode = [test for test in shown if test.mode == mode]
        _panel(axes, fits, of_mode, mode)
        if number == 0:
            handles, labels = axes.get_legend_handles_labels()
            once = dict(zip(labels, handles, strict=True))
            once |= {"dashed: no test there": Line2D([], [], color=QUIET, ls="--", lw=1.2)}
            axes.legend(once.values(), once.keys(), frameon=False, fontsize=8, labelcolor=INK)
    if title:
        figure.suptitle(title, x=0.01, ha="left", color=INK, fontsize=12)
    return figure


def directions_figure(result: DirectionsFit | WovenFit, *, title: str = "") -> Figure:
    """Draw the measured points of each specimen, and the curve of the law in its direction.

    Parameters
    ----------
    result : DirectionsFit or WovenFit
    title : str
        Line above the plot.
    """
    figure = PlotFigure(figsize=(6.4, 4.2))
    axes = figure.add_subplot()
    cuts = list(dict.fromkeys(cut for cut, _ in result.tests))
    for cut, color in zip(cuts, COLORS, strict=False):
        tests = [test for each, test in result.tests if each == cut]
        for number, test in enumerate(tests):
            label = f"{cut}, measured" if number == 0 else None
            axes.plot(test.stretch, test.nominal_stress / MPa, "o", color=color, ms=3.5, alpha=0.5, mew=0, label=label)
        grid = np.linspace(1.0, max(test.range[1] for test in tests), PLOT.curve_points)
        axes.plot(grid, result.stress(cut, grid) / MPa, "-", color=color, lw=1.5, label=cut)
    axes.set_xlabel("stretch [-]", color=INK)
    axes.set_ylabel("nominal stress [MPa]", color=INK)
    axes.legend(frameon=False, fontsize=8, labelcolor=INK)
    if title:
        figure.suptitle(title, x=0.01, ha="left", color=INK, fontsize=12)
    style_axes(axes)
    return figure


def write_fit_plot(path: str | Path, figure: Figure) -> None:
    """Write a figure as PNG or SVG, by the ending of the path.

    Parameters
    ----------
    path : str or Path
        Ends in ``.png`` or ``.svg``.
    figure : matplotlib.figure.Figure
        The figure, such as one from `fit_figure`.
    """
    write_figure(path, figure, dpi=150)


def _panel(axes: Axes, fits: Sequence[Fit], tests: Sequence[MaterialTest], mode: str) -> None:
    if mode == "biaxial":
        for test in tests:
            for fit, color in zip(fits, _colors(fits), strict=True):
                plot_biaxial(axes, fit, test, color=color)
        edges = [float(edge) for test in tests for edge in (test.measured.min() / MPa, test.measured.max() / MPa)]
        axes.plot([min(edges), max(edges)], [min(edges), max(edges)], color=QUIET, lw=0.8, zorder=0)
        return
    for test in tests:
        plot_test(axes, test)
    used = max(test.range[1] for test in tests)
    upto = max((test.raw or test).range[1] for test in tests)
    if mode != "simple_shear":
        upto = max(upto, fits[0].stretch[1])
    left, _, bottom, top = *axes.get_xlim(), *axes.get_ylim()
    end = min(upto, 1 + PLOT.beyond_fit * (used - 1)) if mode != "simple_shear" else upto
    if end < upto:  # removed points must not squeeze the used ones into a corner
        further = f"tests go on to {upto:.3g} →"
        axes.text(1.0, 1.0, further, transform=axes.transAxes, ha="right", va="bottom", fontsize=8, color=INK)
        raws = [test.raw or test for test in tests]
        top = 1.05 / MPa * max(float(raw.nominal_stress[raw.stretch <= end].max()) for raw in raws)
        bottom = 1.05 / MPa * min(0.0, *(float(raw.nominal_stress.min()) for raw in raws))
    for fit, color in zip(fits, _colors(fits), strict=True):
        plot_law(axes, fit, mode, upto, color=color)
    # a law that grows fast outside its range must not squeeze the measurements
    axes.set_xlim(left, end + 0.02 * (end - left))
    axes.set_ylim(min(bottom, -0.03 * top), max(min(axes.get_ylim()[1], 1.4 * top), top))


def _colors(fits: Sequence[Fit]) -> list[str]:
    return [COLORS[i % len(COLORS)] for i in range(len(fits))]


def _styled(axes: Axes, mode: str) -> Axes:
    axes.set_title(TITLES[mode], loc="left", fontsize=10, color=INK)
    axes.set_xlabel("amount of shear [-]" if mode == "simple_shear" else "stretch [-]", color=INK)
    axes.set_ylabel("nominal stress [MPa]", color=INK)
    return style_axes(axes)
