"""Finding: what a check noticed."""

from dataclasses import dataclass
from enum import StrEnum


class Severity(StrEnum):
    """How much a finding matters: a note informs, a warning says that results may be wrong, an error that they are."""

    NOTE = "note"
    WARNING = "warning"
    ERROR = "error"


@dataclass(frozen=True, slots=True, kw_only=True)
class Finding:
    """One thing that a check noticed.

    Parameters
    ----------
    code : str
        Stable code such as ``"G01"``; ``docs/findings.md`` has a section for each.
    severity : Severity
        How much it matters.
    message : str
        One sentence: what was found, with the numbers.
    advice : str
        One sentence: what to do.

    Examples
    --------
    >>> print(Finding(code="G01", severity=Severity.WARNING, message="Thin.", advice="Refine."))
    G01 warning: Thin. Refine.
    """

    code: str
    severity: Severity
    message: str
    advice: str

    def __str__(self) -> str:
        return f"{self.code} {self.severity}: {self.message} {self.advice}"
