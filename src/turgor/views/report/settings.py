"""Settings of reports and notebooks: every number that was chosen, with its reason."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class PageSettings:
    """Sizes of pictures and tables.

    Parameters
    ----------
    width : int
        Width of a page [pixels].
    rows, columns : int
        Most rows of a table on a page, the file has all, and most columns, so that it fits a printed page.
    longest_bar : int
        Letters of the longest bar of a histogram.
    """

    width: int = 984
    rows: int = 13
    columns: int = 8
    longest_bar: int = 40


PAGE = PageSettings()
