"""Plots of rubbers over time: loops of cyclic tests, relaxation, and the difference from the hyperelastic law alone."""

from collections.abc import Sequence

import numpy as np
from matplotlib.figure import Figure

from turgor.core.materials.experiments.material_test import MaterialTest
from turgor.core.materials.fitting.histories.history_points import HistoryPart
from turgor.core.materials.fitting.result import FitResidual
from turgor.core.materials.history.stress_history import stress_history
from turgor.core.materials.laws.laws import Law
from turgor.core.materials.material import Material
from turgor.foundation.errors import TurgorError
from turgor.units import kPa
from turgor.views.plots.figures import PlotFigure
from turgor.views.plots.fits import COLORS, TITLES
from turgor.views.plots.settings import PLOT
from turgor.views.plots.styling import INK, QUIET, style_axes


def history_figure(material: Material, tests: Sequence[MaterialTest], *, title: str = "") -> Figure:
    """Draw a rubber against tests over time: stress against stretch and time, and the difference from the law alone.

    Parameters
    ----------
    material : Material
        A rubber with viscoelasticity, stress softening or both.
    tests : sequence of MaterialTest
        Tests with time, one row each; points at rest are left out.
    title : str
        Line above the panels.
    """
    if not tests:
        raise TurgorError("no test was given; there is nothing to plot.")
    figure = PlotFigure(figsize=(13.0, 3.3 * len(tests) + 0.4))
    axes = figure.subplots(len(tests), 3, squeeze=False)
    for row, test in zip(axes, tests, strict=True):
        _row(row, material, test)
    axes[0][0].legend(frameon=False, fontsize=8, labelcolor=INK)
    if title:
        figure.suptitle(title, x=0.01, ha="left", color=INK, fontsize=12)
    return figure


def _row(row: Sequence, material: Material, test: MaterialTest) -> None:
    law = material.law
    assert isinstance(law, Law)
    part = HistoryPart(law, test, PLOT.test_points)  # refuses tests without time
    stretch = part.F[:, 0, 0]
    computed = stress_history(material, test.mode, part.time, stretch)  # type: ignore[arg-type]
    alone = stress_history(Material(name="law", law=law), test.mode, part.time, stretch)  # type: ignore[arg-type]
    shown = part.loaded
    measured, time = part.loaded_test.nominal_stress, part.time[shown]
    model, bare = computed.nominal_stress[shown], alone.nominal_stress[shown]
    along = np.where(shown, stretch, np.nan)  # lines break where the specimen rests
    line = np.where(shown, computed.nominal_stress, np.nan)
    for axes, x, x_all in ((row[0], stretch[shown], along), (row[1], time, part.time)):
        axes.plot(x, measured / kPa, ".", color=QUIET, ms=3, mew=0, label="measured")
        axes.plot(x_all, line / kPa, "-", color=COLORS[0], lw=0.9, label="fitted rubber")
        axes.set_ylabel("nominal stress [kPa]", color=INK)
    row[2].plot(stretch[shown], (measured - bare) / kPa, ".", color=QUIET, ms=3, mew=0)
    row[2].plot(along, (line - alone.nominal_stress) / kPa, "-", color=COLORS[0], lw=0.9)
    row[2].set_ylabel("difference from the law alone [kPa]", color=INK)
    labels = ("stretch [-]", "time [s]", "stretch [-]")
    for axes, label in zip(row, labels, strict=True):
        axes.set_xlabel(label, color=INK)
        style_axes(axes).tick_params(labelsize=8)
    r2 = FitResidual.of(part.loaded_test, model).r2
    row[0].set_title(f"{test.name}: {TITLES[test.mode].lower()}, R² = {r2:.4f}", loc="left", fontsize=9, color=INK)
