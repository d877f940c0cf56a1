"""Figure of an optimization: how the misfit of each goal falls from run to run, or the front of several objectives."""

from collections.abc import Sequence
from textwrap import fill
from typing import Any

import numpy as np

from turgor.core.results.fields.state_fields import StateFields
from turgor.core.solvers.pressures import pressure_text
from turgor.core.solvers.solution import State
from turgor.foundation.response import COLUMN_UNITS, unit_text
from turgor.studies.optimization.goals import MET, Goal, Limit, Minimize, TipPath
from turgor.studies.optimization.result import Optimization
from turgor.studies.optimization.row_values import Read
from turgor.views.pictures.settings import FRAMING
from turgor.views.pictures.state_picture import shared_view, state_figure
from turgor.views.plots.figures import PlotFigure, png_of
from turgor.views.plots.response_plots import BLUE, COLORS
from turgor.views.plots.study_figure import pictures_in_row
from turgor.views.plots.styling import INK, style_axes

#: Gray of candidates that are not the best, and of those that miss a target or pass a limit.
FAINT = "#9aa3ad"


def optimization_figure(optimization: Optimization) -> PlotFigure:
    """Draw what the goals read from run to run; of two objectives or more, the front.

    Parameters
    ----------
    optimization : Optimization

    Returns
    -------
    matplotlib.figure.Figure
        A notebook shows it; ``figure.savefig("optimization.png")`` writes it.
    """
    objectives = [each for each in optimization.goals if isinstance(each, Minimize)]
    if len(objectives) > 1:
        return _front_figure(optimization, objectives[:2])
    figure = PlotFigure(figsize=(6.4, 1.9 * len(optimization.goals) + 0.6))
    panels = np.atleast_1d(figure.subplots(len(optimization.goals), 1, sharex=True))
    for axes, goal in zip(panels, optimization.goals, strict=True):
        _history(axes, optimization, goal)
    panels[0].legend(frameon=False, labelcolor=INK, fontsize=7)
    panels[-1].set_xlabel("run", color=INK)
    panels[-1].xaxis.get_major_locator().set_params(integer=True)
    panels[0].set_title(optimization.message, loc="left", color=INK, fontsize=9, wrap=True)
    return figure


def ends_of(optimization: Optimization) -> tuple[int, int]:
    """Return the numbers of the runs of the start and of the best design."""
    return optimization.start, optimization.best if optimization.best is not None else optimization.start


def before_and_after(optimization: Optimization, states: Sequence[State] = ()) -> PlotFigure | None:
    """Draw the start and the best design side by side, with their values.

    Parameters
    ----------
    optimization : Optimization
        Whose runs have pictures, as those of jobs.
    states : sequence of State
        Last states of the two, which are drawn at one scale with one range of colors; by default the pictures of the
        runs, each with its own.

    Returns
    -------
    matplotlib.figure.Figure or None
        None where there are no two pictures.
    """
    pairs = zip(("before", "after"), ends_of(optimization), strict=True)
    rows = [(name, number, optimization.study.rows[number]) for name, number in pairs]
    pictures = [row.ended.result.picture if row.ended.result is not None else b"" for _, _, row in rows]
    if states:
        shown = [StateFields(state) for state in states]
        view = shared_view(shown, FRAMING.design_width)
        pictures = [png_of(state_figure(each, view, title=pressure_text(each.state))) for each in shown]
    if not all(pictures):
        return None
    titles = []
    for name, number, row in rows:
        reached = "; ".join(f"{each.name} {each.short}" for each in optimization.reads(number))
        text = f"{name}: {optimization.study.values_text(row.values)}\n{reached}"
        titles.append("\n".join(fill(line, width=90) for line in text.splitlines()))
    return pictures_in_row(list(zip(titles, pictures, strict=True)), (11.0, 4.4))


def _history(axes: Any, optimization: Optimization, goal: Goal) -> None:
    """Draw what one goal reads from each run, with its target or limit and the best design."""
    reads = [goal.reading(row) for row in optimization.study.rows]
    shown = reads[optimization.best or 0]
    values, numbers = _in_unit(reads, shown.unit), np.arange(1, len(reads) + 1)
    within = np.array([each.feasible for each in optimization.scores])
    axes.plot(numbers, values, color=FAINT, lw=0.8, zorder=1)
    axes.scatter(numbers[within], values[within], color=BLUE, s=18, zorder=2, label="within the limits")
    axes.scatter(
        numbers[~within],
        values[~within],
        facecolor="white",
        edgecolor=FAINT,
        s=18,
        zorder=2,
        label="not within the limits",
    )
    if optimization.best is not None:
        errors = _in_unit([shown], shown.unit, error=True)
        axes.errorbar(
            numbers[optimization.best], values[optimization.best], yerr=np.nan_to_num(errors), color=COLORS[1],
            marker="o", ms=7, capsize=3, zorder=3, label="best",
        )  # fmt: skip
    for level in _levels(goal):
        axes.axhline(level / COLUMN_UNITS.get(shown.unit, 1.0), color=INK, lw=0.9, ls="--", zorder=0)
    unit = f" [{unit_text(shown.unit)}]" if shown.unit else ""
    axes.set_ylabel(f"{shown.name}{unit}".replace(" at ", "\nat "), color=INK, fontsize=8)
    style_axes(axes)


def _front_figure(optimization: Optimization, objectives: list[Minimize]) -> PlotFigure:
    figure = PlotFigure(figsize=(6.4, 4.6))
    axes = figure.subplots()
    reads = [[goal.reading(row) for row in optimization.study.rows] for goal in objectives]
    units = [each[optimization.best or 0].unit for each in reads]
    x, y = (_in_unit(each, unit) for each, unit in zip(reads, units, strict=True))
    front = list(optimization.pareto)
    others = [number for number in range(len(x)) if number not in front]
    axes.scatter(x[others], y[others], facecolor="white", edgecolor=FAINT, s=22, label="other designs")
    axes.plot(x[front], y[front], color=BLUE, lw=1.2, marker="o", ms=5, label="no other design beats these")
    axes.scatter(x[optimization.start], y[optimization.start], color=INK, marker="x", s=40, label="start", zorder=3)
    if optimization.best is not None:
        axes.scatter(
            x[optimization.best], y[optimization.best], color=COLORS[1], s=60, label="between the ends", zorder=3
        )
    labels = [_label(each[optimization.best or 0], unit) for each, unit in zip(reads, units, strict=True)]
    axes.set_xlabel(labels[0], color=INK)
    axes.set_ylabel(labels[1], color=INK)
    axes.set_title(optimization.message, loc="left", color=INK, fontsize=9, wrap=True)
    axes.legend(frameon=False, labelcolor=INK, fontsize=8)
    style_axes(axes)
    return figure


def _label(shown: Read, unit: str) -> str:
    return f"{shown.name}{f' [{unit_text(unit)}]' if unit else ''}: {shown.request}"


def _levels(goal: Goal) -> list[float]:
    """Return the target or the limits of a goal [SI]."""
    if isinstance(goal, TipPath):
        return [goal.tolerance]
    if isinstance(goal, Limit):
        return [each for each in (goal.least, goal.most) if each is not None]
    return [goal.value] if isinstance(goal, MET) else []


def _in_unit(reads: list[Read], unit: str, *, error: bool = False) -> np.ndarray:
    values = np.array([each.mesh_error if error else each.value for each in reads])
    return values / COLUMN_UNITS.get(unit, 1.0)
