"""Source: where a number came from."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class Source:
    """Where a value came from, precise enough to look it up.

    Parameters
    ----------
    text : str
        What a reader would cite, e.g. ``"Mosadegh et al. 2014, Adv. Funct. Mater. 24, 2163"``.
    detail : str
        Table, row, equation or file within it.
    doubts : tuple of str
        What is known to be questionable about it; empty when nothing is.

    Examples
    --------
    >>> str(Source(text="Xavier et al. 2021", detail="Table 2"))
    'Xavier et al. 2021, Table 2'
    """

    text: str
    detail: str = ""
    doubts: tuple[str, ...] = ()

    def __str__(self) -> str:
        return f"{self.text}, {self.detail}" if self.detail else self.text
