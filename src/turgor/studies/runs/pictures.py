"""Pictures of a study: the kind that suits the number of its factors, and each kind by itself."""

from itertools import product

import numpy as np

from turgor.core.results.drive import drive_of
from turgor.foundation.errors import TurgorError
from turgor.foundation.response import COLUMN_UNITS, Column, unit_text
from turgor.studies.runs.factor import Array, Factor
from turgor.studies.runs.grid import Grid
from turgor.studies.runs.study import Study
from turgor.units import unit_value
from turgor.views.plots.figures import PlotFigure
from turgor.views.plots.response_plots import plot_response
from turgor.views.plots.settings import PLOT
from turgor.views.plots.studies.effects import plot_effects, shades
from turgor.views.plots.studies.heat_map import plot_heat_map
from turgor.views.plots.studies.parallel import Coordinate, plot_parallel
from turgor.views.plots.styling import INK

At = tuple[str, float] | None


def study_picture(study: Study, measure: str, at: At = None) -> PlotFigure:
    """Draw a measure of a study in the way that suits the number of factors that vary.

    Parameters
    ----------
    study : Study
    measure : str
        Name of a column of the responses.
    at : (str, float), optional
        Column and value [SI] at which it is read, such as ``("pressure", 50e3)``; by default the last state.

    Returns
    -------
    matplotlib.figure.Figure
        One factor: the curve of each level, and the effect with mesh errors. Two on a grid: effects and a heat map.
        Three on a grid: small multiples. Otherwise parallel coordinates.

    Raises
    ------
    TurgorError
        If the measure is unknown, or no run has it.
    """
    grid = Grid.of(study)
    if grid is None:
        return parallel_picture(study, measure, at)
    if len(grid.factors) == 1:
        return curves_picture(study, measure, at)
    if len(grid.factors) == 2:
        return map_picture(study, measure, at)
    few = len(grid.factors) == 3 and max(len(grid.levels[2]), len(grid.levels[1])) <= PLOT.levels
    return multiples_picture(study, measure, at) if few else parallel_picture(study, measure, at)


def curves_picture(study: Study, measure: str, at: At = None) -> PlotFigure:
    """Draw the curve of each row against what drives it, and the effect of the one factor that varies.

    Parameters
    ----------
    study, measure, at
        As those of `study_picture`.

    Returns
    -------
    matplotlib.figure.Figure

    Raises
    ------
    TurgorError
        If more than one factor varies.
    """
    grid = _grid(study, 1)
    figure = PlotFigure(figsize=(2 * PLOT.panel_width, PLOT.panel_height))
    left, right = figure.subplots(1, 2)
    values, errors = _read(study, measure, at)
    for color, row, level in zip(shades(grid.rows.size), grid.rows, grid.levels[0], strict=True):
        response = study.rows[row].response
        if response is not None:
            drive = at[0] if at is not None else drive_of(response)
            plot_response(left, response, drive, measure, color=color, label=grid.factors[0].shown(level))
    if at is not None:
        left.axvline(at[1] / COLUMN_UNITS[study.unit(at[0])], color=INK, lw=0.8, ls="--")
    left.legend(frameon=False, labelcolor=INK, fontsize=8, title=_name(study, grid.factors[0]), title_fontsize=8)
    label = _label(study, measure, at)
    plot_effects(
        right, grid.ticks(0), [grid.effect(values, errors, 0, ())], _axis(study, grid.factors[0]), label
    )  # fmt: skip
    if right.get_legend_handles_labels()[1]:
        right.legend(frameon=False, labelcolor=INK, fontsize=8)
    return figure


def map_picture(study: Study, measure: str, at: At = None) -> PlotFigure:
    """Draw a measure over two factors: its effects with mesh errors, and a heat map.

    Parameters
    ----------
    study, measure, at
        As those of `study_picture`.

    Returns
    -------
    matplotlib.figure.Figure

    Raises
    ------
    TurgorError
        If the rows are no full grid of two factors.
    """
    grid = _grid(study, 2)
    figure = PlotFigure(figsize=(2.15 * PLOT.panel_width, PLOT.panel_height))
    left, right = figure.subplots(1, 2)
    values, errors = _read(study, measure, at)
    first, second = grid.factors
    effects = [
        grid.effect(values, errors, 0, (k,), second.shown(level)) for k, level in enumerate(grid.levels[1])
    ][:: max(1, -(-len(grid.levels[1]) // PLOT.levels))]  # fmt: skip
    label = _label(study, measure, at)
    plot_effects(left, grid.ticks(0), effects, _axis(study, first), label)
    left.legend(frameon=False, labelcolor=INK, fontsize=8, title=_name(study, second), title_fontsize=8)
    texts = [[each if isinstance(each, str) else f"{each:.4g}" for each in grid.ticks(k)] for k in (0, 1)]
    names = (_axis(study, first), _axis(study, second), label)
    plot_heat_map(right, (texts[0], texts[1]), values[grid.rows].T, errors[grid.rows].T, names)
    return figure


def multiples_picture(study: Study, measure: str, at: At = None) -> PlotFigure:
    """Draw small multiples: a panel for each level of the third factor, a line for each of the second.

    Parameters
    ----------
    study, measure, at
        As those of `study_picture`.

    Returns
    -------
    matplotlib.figure.Figure

    Raises
    ------
    TurgorError
        If the rows are no full grid of three factors.
    """
    grid = _grid(study, 3)
    panels = len(grid.levels[2])
    columns = min(panels, PLOT.columns)
    figure = PlotFigure(figsize=(0.82 * PLOT.panel_width * columns, 0.92 * PLOT.panel_height * -(-panels // columns)))
    every = figure.subplots(-(-panels // columns), columns, squeeze=False, sharex=True, sharey=True).ravel()
    values, errors = _read(study, measure, at)
    first, second, third = grid.factors
    for k, axes in enumerate(every):
        if k >= panels:
            axes.set_axis_off()
            continue
        effects = [
            grid.effect(values, errors, 0, (n, k), second.shown(level)) for n, level in enumerate(grid.levels[1])
        ]
        lowest, first_in_row = k + columns >= panels, k % columns == 0
        plot_effects(
            axes, grid.ticks(0), effects, _axis(study, first) if lowest else "",
            _label(study, measure, at) if first_in_row else "",
        )  # fmt: skip
        axes.tick_params(labelbottom=lowest)
        axes.set_title(f"{_name(study, third)} {third.shown(grid.levels[2][k])}", loc="left", color=INK, fontsize=10)
    every[0].legend(frameon=False, labelcolor=INK, fontsize=8, title=_name(study, second), title_fontsize=8)
    return figure


def parallel_picture(study: Study, measure: str, at: At = None) -> PlotFigure:
    """Draw all factors that vary and a measure as upright axes, with a line for each design.

    Parameters
    ----------
    study, measure, at
        As those of `study_picture`.

    Returns
    -------
    matplotlib.figure.Figure
    """
    values, _ = _read(study, measure, at)
    coordinates = []
    for each in study.factors:
        given = [row.values[each.name] for row in study.rows]
        if len(set(given)) > 1:
            scaled = [x if isinstance(x, str) else x / unit_value(each.unit) for x in given]
            coordinates.append(Coordinate(label=_axis(study, each), values=scaled))
    coordinates.append(Coordinate(label=_label(study, measure, at), values=values.tolist()))
    figure = PlotFigure(
        figsize=(max(1.7 * len(coordinates) + 1.0, 2 * PLOT.panel_width * 0.9), PLOT.panel_height * 1.15)
    )
    plot_parallel(figure.subplots(), coordinates)
    return figure


def hidden_by_mesh(study: Study, measure: str, at: At = None) -> tuple[str, ...]:
    """Return which effects mesh errors hide: differences between neighboring levels that are smaller than their errors.

    The mesh errors of two runs are added, because they are no random numbers. Only rows on a full grid are compared.

    Parameters
    ----------
    study, measure, at
        As those of `study_picture`.

    Returns
    -------
    tuple of str
        A sentence for each factor with such a difference.
    """
    grid = Grid.of(study)
    if grid is None:
        return ()
    values, errors = _read(study, measure, at)
    sentences = []
    for along, factor in enumerate(grid.factors):
        rest = [range(len(each)) for k, each in enumerate(grid.levels) if k != along]
        effects = [grid.effect(values, errors, along, others) for others in product(*rest)]
        hidden = np.array([each.hidden for each in effects])
        if not hidden.any():
            continue
        n, k = (int(each[0]) for each in np.nonzero(hidden))
        unit = unit_text(study.unit(measure))
        apart = abs(effects[n].values[k + 1] - effects[n].values[k])
        wide = effects[n].errors[k] + effects[n].errors[k + 1]
        low, high = (factor.shown(grid.levels[along][each]) for each in (k, k + 1))
        where = _label(study, measure, at).partition(" [")[0]
        sentence = (
            f"{where}: mesh errors hide {int(hidden.sum())} of {hidden.size} differences between neighboring levels of "
            f"{_name(study, factor)}, such as {apart:.3g} {unit} from {low} to {high} against mesh errors of "
            f"{wide:.3g} {unit}; take a finer mesh before you decide by them."
        )
        sentences.append(sentence.replace(" °", "°"))
    return tuple(sentences)


def _grid(study: Study, count: int) -> Grid:
    grid = Grid.of(study)
    if grid is None or len(grid.factors) != count:
        given = "no full grid" if grid is None else f"a grid of {len(grid.factors)}"
        raise TurgorError(f"this picture needs all combinations of {count} factors; the study has {given}.")
    return grid


def _read(study: Study, measure: str, at: At) -> tuple[Array, Array]:
    """Values and mesh errors of each row, in the unit of the measure."""
    unit = COLUMN_UNITS[study.unit(measure)]
    return study.column(measure, at) / unit, study.mesh_error(measure, at) / unit


def _label(study: Study, measure: str, at: At) -> str:
    """Label of a measure, with the point at which it is read."""
    column = Column(measure, study.unit(measure), np.zeros(0))
    if at is None:
        return column.label
    unit = study.unit(at[0])
    point = f"{at[1] / COLUMN_UNITS[unit]:.5g} {unit_text(unit)}".strip()
    return column.label.replace(column.words, f"{column.words} at {point}", 1)


def _name(study: Study, factor: Factor) -> str:
    """Short name of a factor: the last part of its key, or two where others have the same."""
    parts = factor.name.split(",")[0].split(".")
    same = [each for each in study.factors if each.name.split(",")[0].split(".")[-1] == parts[-1]]
    return " ".join(parts[-1 if len(same) == 1 else -2 :]).replace("_", " ")


def _axis(study: Study, factor: Factor) -> str:
    unit = unit_text(factor.unit)
    return f"{_name(study, factor)} [{unit}]" if unit else _name(study, factor)
