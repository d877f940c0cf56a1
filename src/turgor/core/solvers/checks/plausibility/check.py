"""Check of plausibility: find the magnitudes that lie outside the range of the field."""

from turgor.core.solvers.checks.plausibility.question import Magnitude, Question, shown
from turgor.core.solvers.checks.plausibility.table import ROWS, Row
from turgor.foundation.finding import Finding, Severity


def implausible(question: Question) -> tuple[Finding, ...]:
    """Compare every magnitude of a question with the range of the field (P01 to P06, L08).

    Parameters
    ----------
    question : Question

    Returns
    -------
    tuple of Finding
        Warnings, because a user may know better; errors where it is impossible.
    """
    return tuple(_finding(row, each) for row in ROWS for each in row.read(question) if not row.holds(each.value))


def _finding(row: Row, each: Magnitude) -> Finding:
    rule = "possible is" if row.severity is Severity.ERROR else "usual is"
    return Finding(
        code=row.code,
        severity=row.severity,
        message=f"{each.where}: the {row.quantity} is {shown(each.value, row.unit)}; {rule} {row.range_text} "
        f"({row.source}).",
        advice=row.advice,
    )
