"""Settings of plots: every number that was chosen, with its reason."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class PlotSettings:
    """Settings of plots: what a reader can distinguish on a page.

    Parameters
    ----------
    panel_width, panel_height : float
        Size of a panel of curves [inch].
    columns : int
        Most panels in one row.
    curve_points, test_points : int
        Points of a curve that is computed, and about as many of a test over time that are drawn.
    marks : int
        Most marks of one kind in a panel, such as crosses, dots or error bars, since more would merge into a bar, and
        most cells of a heat map whose values are written into them.
    levels : int
        Most levels of a factor with a line, a tick or a panel each.
    pictures : int
        Most pictures in one row, of a figure and of a sheet.
    letters : int
        Letters across a panel. Names of stages with more in total are turned, so that they do not overlap. A picture is
        about half as wide.
    stretch, stiff_stretch : float
        Largest stretch that is drawn of rubbers whose tests do not state another, and of stiff materials, which are
        linear elastic.
    beyond_fit : float
        Largest strain that a panel shows, as a multiple of the largest one that a law was fitted to.
    rod_mark : float
        Half the length of the marks of sections, over the length of a rod that has no contact radius.
    pale : float
        Opacity of the first state of a rod, and of a transparent actuator in front of its cavities.
    lightest_level : float
        Where the colors of levels end: lighter ones vanish on white.
    """

    panel_width: float = 4.2
    panel_height: float = 3.2
    columns: int = 3
    curve_points: int = 200
    test_points: int = 3000
    marks: int = 100
    levels: int = 9
    pictures: int = 4
    letters: int = 36
    stretch: float = 3.0
    stiff_stretch: float = 1.01
    beyond_fit: float = 2.0
    rod_mark: float = 0.02
    pale: float = 0.3
    lightest_level: float = 0.88


PLOT = PlotSettings()
