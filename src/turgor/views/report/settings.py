"""Settings of reports and notebooks: every number that was chosen, with its reason."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class PageSettings:
    """Sizes of pages.

    Parameters
    ----------
    width : int
        Width of a page [pixels].
    longest_bar : int
        Letters of the longest bar of a histogram.
    """

    width: int = 984
    longest_bar: int = 40


PAGE = PageSettings()
