"""Plot of a law: nominal stress over stretch in uniaxial, planar and equibiaxial tension."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from turgor.core.materials.laws.homogeneous import DEFORMATIONS, nominal_stress
from turgor.core.materials.laws.laws import FiberLaw, Hooke
from turgor.core.materials.material import Material
from turgor.foundation.errors import TurgorError
from turgor.units import MPa, kPa
from turgor.views.plots.figures import PlotFigure
from turgor.views.plots.materials import MODES
from turgor.views.plots.response_plots import COLORS
from turgor.views.plots.settings import PLOT
from turgor.views.plots.styling import INK, style_axes


def law_figure(material: Material) -> Figure:
    """Draw the nominal stress of a rubber in uniaxial, planar and equibiaxial tension.

    The curves go to the largest stretch of the tests that the law was fitted to, where it is known.

    Parameters
    ----------
    material : Material
        A rubber.

    Raises
    ------
    TurgorError
        If the material is linear elastic.

    Examples
    --------
    >>> from turgor.core.materials.laws.laws import Yeoh
    >>> law_figure(Material(name="rubber", law=Yeoh(C10=0.11e6, C20=0.02e6))).axes[0].get_xlabel()
    'stretch [-]'
    """
    figure = PlotFigure(figsize=(4.6, 3.1))
    _curves(figure.add_subplot(), material)
    return figure


def _curves(axes: Axes, material: Material) -> None:
    law = material.law
    if isinstance(law, Hooke):
        raise TurgorError(f"material '{material.name}' is linear elastic; its curve is a straight line.")
    if isinstance(law, FiberLaw):
        raise TurgorError(f"material '{material.name}' has directions; it has no curve that holds for all of them.")
    known = material.stretch_range is not None and material.stretch_range[1] > 1
    reach = material.stretch_range[1] if material.stretch_range is not None and known else PLOT.stretch
    across = np.linspace(1.0, reach, PLOT.curve_points)
    with np.errstate(all="ignore"):  # no stress beyond a limiting stretch
        curves = {mode: nominal_stress(law, DEFORMATIONS[mode](across))[..., 0, 0] for mode in MODES}
    most = max(float(np.nanmax(np.where(np.isfinite(each), each, 0.0))) for each in curves.values())
    unit, name = (MPa, "MPa") if most >= MPa else (kPa, "kPa")
    for (mode, stress), color in zip(curves.items(), COLORS, strict=False):
        axes.plot(across, np.where(np.isfinite(stress), stress, np.nan) / unit, color=color, lw=1.8, label=mode)
    axes.set_xlabel("stretch [-]", color=INK)
    axes.set_ylabel(f"nominal stress [{name}]", color=INK)
    axes.set_title("range of the tests" if known else "range of the tests unknown", loc="left", fontsize=9, color=INK)
    style_axes(axes)
    axes.legend(frameon=False, fontsize=8, labelcolor=INK)
