"""Curves of the materials in a report."""

from turgor.core.materials.laws.laws import Law
from turgor.core.materials.material import Material
from turgor.views.plots.figures import svg_of
from turgor.views.plots.law_plot import law_figure


def law_plot(material: Material | None) -> str:
    """Draw nominal stress over stretch of a rubber.

    Parameters
    ----------
    material : Material or None

    Returns
    -------
    str
        SVG; empty for threads (None) for linear elastic materials, whose curve is a straight line, and for those with
        directions.
    """
    return "" if material is None or not isinstance(material.law, Law) else svg_of(law_figure(material))
