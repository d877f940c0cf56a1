"""Explanations: the finding that says why a solve failed comes before what the solver noticed."""

from dataclasses import replace

from turgor.core.solvers.solution import Solution, Status
from turgor.foundation.finding import Finding, Severity

#: Findings that explain a failure, the likeliest cause first: magnitudes, of the material, the dimensions and the load,
#: and the settings of Newton's method.
CAUSES = ("P01", "P03", "P02", "P06")

#: Findings that explain why not even the first step was done: what overlaps at rest.
CAUSES_AT_REST = ("B07", "B08")

#: Ways of ending that need an explanation.
FAILURES = (Status.STEP_TOO_SMALL, Status.LIMIT_POINT, Status.TURNED_BACK, Status.STEP_LIMIT)


def explained(solution: Solution) -> Solution:
    """Let the message of a failed solve begin with the finding that explains it.

    Parameters
    ----------
    solution : Solution
        With its findings.

    Returns
    -------
    Solution
    """
    cause = _cause(solution)
    if cause is None:
        return solution
    advice = cause.advice
    if solution.advice:
        advice = f"{advice} If it is meant: {solution.advice[0].lower()}{solution.advice[1:]}"
    return replace(solution, message=f"{cause.message.rstrip('.')} ({cause.code}). {solution.message}", advice=advice)


def _cause(solution: Solution) -> Finding | None:
    if solution.status not in FAILURES:
        return None
    codes = (*CAUSES, *CAUSES_AT_REST) if len(solution.states) < 2 else CAUSES
    findings = [each for each in solution.findings if each.code in codes and each.severity is not Severity.NOTE]
    return min(findings, key=lambda each: codes.index(each.code), default=None)
