"""Panels of materials: small plots of several rubbers, the record to take in color, other sets and tests behind."""

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from turgor.core.materials.library.doubts import find_doubts
from turgor.core.materials.library.record_files import records
from turgor.core.materials.library.records import recommended
from turgor.foundation.finding import Severity
from turgor.views.plots.figures import PlotFigure
from turgor.views.plots.materials import curve
from turgor.views.plots.settings import PLOT
from turgor.views.plots.styling import INK, style_axes


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
