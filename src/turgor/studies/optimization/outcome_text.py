"""How an optimization ended, in words: what was met, how near it came, and what to do."""

from turgor.studies.optimization.goals import MET, Limit, Minimize
from turgor.studies.optimization.problem import Candidate, Problem
from turgor.studies.optimization.search import Ending, Search


def ending_text(problem: Problem, ending: Ending, best: Candidate | None, search: Search) -> tuple[str, str]:
    """Return a sentence on how the search ended, and advice."""
    runs = f"{len(problem.candidates)} runs"
    failed = [each for each in problem.candidates if not each.known]
    lost = f" {len(failed)} of them gave no value." if failed else ""
    if best is None:
        why = failed[0].row.problem or "its path does not reach the value at which the goals are read" if failed else ""
        return (
            f"No run gave all values that the goals read, after {runs}; the first: {why.rstrip('.')}.",
            "Begin at a design that can be computed, or read the goals at a lower load.",
        )
    missed = missed_goals(problem, best)
    if ending is Ending.CONVERGED:
        met = "All targets are met" if not problem.objectives else _objectives_text(problem)
        return f"{met}, after {runs}.{lost}", ""
    near = f" Nearest: {'; '.join(missed)}." if missed else ""
    if ending is Ending.INFEASIBLE:
        return (
            f"No design within the ranges meets all goals, as far as the search sees, after {runs}.{lost}{near}",
            f"{_bounds_text(problem, best)}Widen the ranges, relax a goal, or take more starts: the search is local.",
        )
    keeps = "" if missed else " The best design so far meets all targets and limits."
    return (
        f"The budget of {search.most_solves} runs ended before the search.{lost}{near}{keeps}",
        "Call again with more runs; with runs saved in a folder, nothing is computed twice.",
    )


def missed_goals(problem: Problem, candidate: Candidate) -> list[str]:
    """Return in words which targets and limits a candidate misses."""
    missed = []
    for goal, part in zip(problem.goals, problem.parts(candidate.readings), strict=True):
        if isinstance(goal, Minimize):
            continue
        divisor, target = goal.linear()
        scaled = (part - target) / divisor
        size = float(scaled.max()) if isinstance(goal, Limit) else float((scaled @ scaled) ** 0.5)
        if size > 1.0:
            missed.append(str(goal.reading(candidate.row)))
    return missed


def _objectives_text(problem: Problem) -> str:
    if len(problem.objectives) > 1:
        return "The front no longer moves"
    conditions = any(isinstance(each, (*MET, Limit)) for each in problem.goals)
    return "No better design is near" + (" that meets all targets and limits" if conditions else "")


def _bounds_text(problem: Problem, best: Candidate) -> str:
    """Say which factors are at an end of their range."""
    at_end = [
        f"{each.name} at its {'lowest' if share <= 1e-6 else 'highest'}"
        for each, share in zip(problem.factors, best.at, strict=True)
        if share <= 1e-6 or share >= 1 - 1e-6
    ]
    return f"The nearest design has {', '.join(at_end)}. " if at_end else ""
