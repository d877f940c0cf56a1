"""Finding: what a check noticed."""

import sys
import warnings
from collections.abc import Iterable
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
        One sentence: what the check noticed, with the numbers.
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


class FindingWarning(UserWarning):
    """A finding of severity warning or error, as Python shows it to a script.

    Examples
    --------
    >>> import warnings
    >>> warnings.filterwarnings("ignore", message="P02", category=FindingWarning)  # the load is meant
    """


def show_warning(finding: Finding) -> None:
    """Show a finding as a warning of Python, once for each line of a script that leads to it."""
    level, frame = 2, sys._getframe(1)
    while frame.f_back is not None and frame.f_globals.get("__name__", "").startswith("turgor."):
        frame, level = frame.f_back, level + 1
    warnings.warn(str(finding), FindingWarning, stacklevel=level)


#: Severities by weight.
HEAVIEST_FIRST = (Severity.ERROR, Severity.WARNING, Severity.NOTE)


def by_weight(findings: Iterable[Finding]) -> tuple[Finding, ...]:
    """Return each finding once: errors first, then warnings, then notes; equal ones in the order in which they came.

    Examples
    --------
    >>> note = Finding(code="B03", severity=Severity.NOTE, message="Open.", advice="")
    >>> thin = Finding(code="G01", severity=Severity.WARNING, message="Thin.", advice="Refine.")
    >>> [found.code for found in by_weight([note, thin, note])]
    ['G01', 'B03']
    """
    return tuple(sorted(dict.fromkeys(findings), key=lambda finding: HEAVIEST_FIRST.index(finding.severity)))


def not_reported(findings: Iterable[Finding], reported: Iterable[Finding]) -> tuple[Finding, ...]:
    """Return the findings of codes that were not reported before.

    A check before a solve and the solve itself look at the same model, of which the second may have a finer mesh and
    other digits; what the first said is said once.

    Examples
    --------
    >>> note = Finding(code="B03", severity=Severity.NOTE, message="Open.", advice="")
    >>> not_reported([note], reported=[note]), len(not_reported([note], reported=[]))
    ((), 1)
    """
    codes = {finding.code for finding in reported}
    return tuple(finding for finding in findings if finding.code not in codes)
