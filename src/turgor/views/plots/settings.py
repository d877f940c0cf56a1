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
        Most marks of one kind in a panel, such as crosses, dots or error bars: more would merge into a bar.
    levels : int
        Most levels of a factor with a line, a tick or a panel each.
    cells : int
        Most cells of a heat map whose values are written into them.
    pictures : int
        Most pictures in one row.
    stage_letters, title_letters : int
        Names of stages with more letters in total are turned, so that they do not overlap; letters in a line of a title
        above one of these pictures.
    stretch, unknown_stretch, stiff_stretch : float
        Largest stretch that is drawn of several rubbers, of one whose tests are unknown, and of stiff materials, which
        are linear elastic.
    beyond_fit : float
        Largest strain that a panel shows, as a multiple of the largest one that a law was fitted to.
    rod_mark, first_state : float
        Half the length of the marks of sections, over the length of a rod that has no contact radius; opacity of its
        first state.
    lightest_level : float
        Where the colors of levels end: lighter ones vanish on white.
    png_level : int
        How hard PNG files are compressed, 1 to 9: a tenth larger than at 6, and written twice as fast.
    """

    panel_width: float = 4.2
    panel_height: float = 3.2
    columns: int = 3
    curve_points: int = 200
    test_points: int = 3000
    marks: int = 150
    levels: int = 9
    cells: int = 100
    pictures: int = 5
    stage_letters: int = 36
    title_letters: int = 18
    stretch: float = 4.0
    unknown_stretch: float = 2.5
    stiff_stretch: float = 1.01
    beyond_fit: float = 2.0
    rod_mark: float = 0.02
    first_state: float = 0.25
    lightest_level: float = 0.88
    png_level: int = 4


PLOT = PlotSettings()
