"""Plots of library materials: the curves of all records of one rubber on one pair of axes, with a measured test."""

from collections.abc import Sequence
from pathlib import Path

import matplotlib
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from turgor.core.materials.experiments.material_test import MaterialTest
from turgor.core.materials.laws.homogeneous import DEFORMATIONS, nominal_stress
from turgor.core.materials.laws.laws import Hooke
from turgor.core.materials.library.doubts import find_doubts
from turgor.core.materials.library.record import Record
from turgor.core.materials.library.record_files import records
from turgor.core.materials.library.records import find_record, recommended
from turgor.core.materials.library.settings import DOUBTS
from turgor.foundation.errors import TurgorError, unknown
from turgor.foundation.finding import Severity
from turgor.views.plots.figures import PlotFigure, check_ending, write_figure
from turgor.views.plots.settings import PLOT
from turgor.views.plots.styling import INK, style_axes

Array = NDArray[np.float64]

#: Modes that have a panel, in this order.
MODES = ("uniaxial", "planar", "equibiaxial")


def plot_records(axes: Axes, chosen: Sequence[Record], stretch: Array, mode: str = "uniaxial") -> Axes:
    """Plot nominal stress over stretch for each record that has a law: solid where it was fitted, dashed beyond.

    Where the fitted range is unknown, or covers all stretches, the whole line is solid and thinner.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
        Where to draw.
    chosen : sequence of Record
        What to draw; records without a law appear in the legend only.
    stretch : (n,) array [-]
        Stretches of the curves.
    mode : str
        ``"uniaxial"``, ``"planar"`` or ``"equibiaxial"``.

    Returns
    -------
    matplotlib.axes.Axes
        The axes that were given.

    Examples
    --------
    >>> axes = plot_records(Figure().add_subplot(), records("smooth-sil-950"), np.linspace(1, 2, 5))
    >>> len(axes.lines)
    4
    """
    if mode not in MODES:
        raise unknown("mode of a curve", mode, MODES)
    colors = matplotlib.colormaps["tab10"].colors  # type: ignore[attr-defined]
    for number, record in enumerate(chosen):
        color, label = colors[number % len(colors)], _label(record)
        stress = curve(record, stretch, mode)
        if stress is None:
            axes.plot([], [], " ", label=f"{label}: no law")
            continue
        fitted = _fitted(record, stretch)
        if fitted.all():
            axes.plot(stretch, stress, "-", color=color, lw=1.4, label=label)
            continue
        axes.plot(stretch, stress, "--", color=color, lw=1.2)
        axes.plot(stretch[fitted], stress[fitted], "-", color=color, lw=2.4, label=label)
    axes.set_xlabel(f"stretch, {mode} [-]", color=INK)
    return style_axes(axes)


def curve(record: Record, stretch: Array, mode: str = "uniaxial") -> Array | None:
    """Return the nominal stress of a record, (n,) [MPa]; None where no law can have its constants.

    Parameters
    ----------
    record : Record
        A rubber, or a stiff part at small strains, whose stress is E (stretch − 1).
    stretch : (n,) array [-]
        Positive stretches.
    mode : str
        ``"uniaxial"``, ``"planar"`` or ``"equibiaxial"``; a linear elastic record has a curve in the first only.

    Examples
    --------
    >>> curve(find_record("smooth-sil-950", "neo-hooke-connolly-2017"), np.array([1.0, 2.0]))
    array([0.  , 1.19])
    """
    try:
        law = record.build_law()
    except TurgorError:
        return None
    if isinstance(law, Hooke):
        return law.E * (stretch - 1) / 1e6 if mode == "uniaxial" else np.full_like(stretch, np.nan)
    return np.asarray(nominal_stress(law, DEFORMATIONS[mode](stretch))[..., 0, 0] / 1e6)


def material_figure(
    name: str,
    *,
    record: str | None = None,
    tests: Sequence[MaterialTest] = (),
    stretch: tuple[float, float] | None = None,
) -> Figure:
    """Draw the curves of every record of a library material, or of one record, with measured tests of one mode.

    Parameters
    ----------
    name : str
        Material of the library, or path of a file of your own.
    record : str, optional
        One record; by default all.
    tests : sequence of MaterialTest
        Measured tests to compare with; they set the mode. By default those of the library that records were fitted to.
    stretch : (float, float), optional
        Smallest and largest stretch to show; by default the range of the tests, up to 4.
    """
    chosen = records(name) if record is None else (find_record(name, record),)
    own = [test for each in chosen if each.fitted is not None for test in each.fitted.read()]
    tests = tests or [test for test in own if test.mode == "uniaxial"]
    modes = {test.mode for test in tests} or {"uniaxial"}
    if len(modes) > 1:
        raise TurgorError(f"the tests are {' and '.join(sorted(modes))}; plot tests of one mode at a time.")
    (mode,) = modes
    across = _stretches(chosen, tests) if stretch is None else _between(*stretch)
    figure = PlotFigure(figsize=(8.4, 5.0))
    axes = plot_records(figure.add_subplot(), chosen, across, mode)
    for test in tests:
        inside = (test.stretch >= across[0]) & (test.stretch <= across[-1])
        every = max(1, int(inside.sum()) // 60)
        points = test.stretch[inside][::every], test.nominal_stress[inside][::every] / 1e6
        axes.plot(*points, "o", color=INK, ms=3.5, mfc="none", label=f"measured: {test.name}")
    axes.set_ylabel("nominal stress [MPa]", color=INK)
    axes.set_xlim(across[0], across[-1])
    axes.set_ylim(*_limits(chosen, across, mode, tests))
    axes.set_title(f"{chosen[0].material_name}: constants of its records", loc="left", color=INK, fontsize=12)
    axes.legend(frameon=False, fontsize=8, loc="upper left", bbox_to_anchor=(1.0, 1.0))
    return figure


def material_panels(names: Sequence[str], columns: int = 3) -> Figure:
    """Draw one panel for each rubber: nominal stress over stretch in uniaxial tension.

    Parameters
    ----------
    names : sequence of str
        Materials of the library.
    columns : int
        Panels next to each other.

    Returns
    -------
    matplotlib.figure.Figure

    Examples
    --------
    >>> len(material_panels(["ecoflex-00-30", "mold-star-16"]).axes)
    2
    """
    rows = -(-len(names) // columns)
    figure = PlotFigure(figsize=(2.9 * columns, 2.1 * rows))
    for place, name in enumerate(names, start=1):
        plot_material(figure.add_subplot(rows, columns, place), name)
    return figure


def plot_material(axes: Axes, name: str) -> Axes:
    """Draw the record to take of one rubber, and in gray others without a computed doubt, up to the end of their tests.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    name : str

    Returns
    -------
    matplotlib.axes.Axes
    """
    best, known = recommended(name), records(name)
    top = min(best.stretch_range[1], PLOT.stretch) if best and best.stretch_range else PLOT.stretch
    stretch = np.linspace(1.0, top, 120)
    for record in known:
        doubted = any(each.severity is Severity.WARNING and each.kind != "stated" for each in find_doubts(record))
        own = stretch[stretch <= (record.stretch_range[1] if record.stretch_range else top)]
        stress = None if doubted and record is not best else curve(record, own)
        if stress is not None:
            color, width = ("tab:blue", 2.2) if record is best else ("0.65", 1.0)
            axes.plot(own, stress, "-", color=color, lw=width, zorder=3 if record is best else 2)
    for record in known:
        for test in record.fitted.read() if record.fitted else ():
            inside = (test.stretch >= 1) & (test.stretch <= top)
            if test.mode == "uniaxial":
                each = slice(None, None, max(1, int(inside.sum()) // 15))
                points = test.stretch[inside][each], test.nominal_stress[inside][each] / 1e6
                axes.plot(*points, "o", color=INK, ms=3, mfc="none", zorder=4)
    maker = known[0].supplier.stress_at_stretch_2 if known[0].supplier else None
    if maker is not None and top >= 2:
        axes.plot([2.0], [maker / 1e6], "*", color="tab:red", ms=9, zorder=5)
    axes.set_title(known[0].material_name, loc="left", color=INK, fontsize=9)
    axes.set_xlim(1.0, top)
    axes.set_ylim(bottom=0.0)
    axes.tick_params(labelsize=7)
    return style_axes(axes)


def write_material_plot(
    path: str | Path,
    name: str,
    *,
    record: str | None = None,
    tests: Sequence[MaterialTest] = (),
    stretch: tuple[float, float] | None = None,
) -> None:
    """Write `material_figure` as PNG or SVG, by the ending of the path."""
    check_ending(path, "plot")
    write_figure(path, material_figure(name, record=record, tests=tests, stretch=stretch), dpi=160)


def _stretches(chosen: Sequence[Record], tests: Sequence[MaterialTest]) -> Array:
    if tests:
        low = min(1.0, *(float(test.stretch.min()) for test in tests))
        return _between(low, min(PLOT.stretch, max(float(test.stretch.max()) for test in tests)))
    return _between(1.0, PLOT.stiff_stretch if all(_stiff(record) for record in chosen) else PLOT.stretch)


def _between(low: float, high: float) -> Array:
    if not 0 < low < high:
        raise TurgorError(f"stretches from {low:g} to {high:g}; two rising numbers above 0 are needed.")
    return np.linspace(low, high, 300)


def _stiff(record: Record) -> bool:
    return record.law in ("hooke", "woven") and record.constants["E"] > DOUBTS.stiffest_rubber


def _limits(chosen: Sequence[Record], stretch: Array, mode: str, tests: Sequence[MaterialTest]) -> tuple[float, float]:
    """Lower and upper stress [MPa] such that the tests and most curves are visible; curves far above are cut off."""
    curves = [stress for record in chosen if (stress := curve(record, stretch, mode)) is not None]
    tops = [float(np.nanmax(stress)) for stress in curves if np.isfinite(stress).any()]
    if tests:
        inside = [test.nominal_stress[(test.stretch >= stretch[0]) & (test.stretch <= stretch[-1])] for test in tests]
        measured = np.concatenate([*inside, np.zeros(1)]) / 1e6
        top, bottom = 2.5 * float(measured.max()), float(measured.min())
    else:
        top, bottom = min(2.5 * float(np.median(tops or [1.0])), 1.05 * max(tops or [1.0])), 0.0
    top = top if top > 0 else 1.0
    lowest = min((float(np.nanmin(stress)) for stress in curves if np.isfinite(stress).any()), default=0.0)
    return min(bottom, max(lowest, -0.1 * top)), top


def _fitted(record: Record, stretch: Array) -> NDArray[np.bool_]:
    if record.stretch_range is None:
        return np.ones(stretch.shape, dtype=bool)
    low, high = record.stretch_range
    return np.asarray((stretch >= low) & (stretch <= high))


def _label(record: Record) -> str:
    codes = sorted({doubt.code for doubt in find_doubts(record) if doubt.severity is Severity.WARNING})
    return f"{record.name} ({', '.join(codes)})" if codes else record.name
