"""Settings of reports and notebooks: every number that was chosen, with its reason."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class PageSettings:
    """Sizes of pictures and tables.

    Parameters
    ----------
    width, picture_height : int
        Width of a page, and largest height of a picture on it [pixels].
    small, wide : int
        Width of a picture in a notebook, and of that of a geometry, which has two views [pixels].
    dpi : int
        Resolution of plots in a notebook [dots per inch].
    rows, columns : int
        Most rows of a table on a page, the file has all, and most columns, so that it fits a printed page.
    bars, longest_bar : int
        Bars of a histogram from 0 to 1, and letters of the longest of them.
    """

    width: int = 984
    picture_height: int = 760
    small: int = 560
    wide: int = 860
    dpi: int = 80
    rows: int = 13
    columns: int = 8
    bars: int = 10
    longest_bar: int = 40


PAGE = PageSettings()
