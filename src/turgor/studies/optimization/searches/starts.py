"""Several starts: local searches from designs that are spread over the ranges; they share their runs."""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.stats import qmc

from turgor.studies.optimization.problem import Candidate, Problem
from turgor.studies.optimization.search import Ending, Search
from turgor.studies.optimization.searches.step import merit
from turgor.studies.optimization.settings import TRUST_REGION

Array = NDArray[np.float64]
Descend = Callable[[Problem, Array, Search], Ending]


@dataclass(frozen=True, slots=True, kw_only=True)
class Descent:
    """Where the search from one start ended.

    Parameters
    ----------
    start : int
        Row of the start.
    best : int or None
        Row of its best design; None where no run gave a response.
    ending : Ending
        How it ended.
    """

    start: int
    best: int | None
    ending: Ending


def descents_of(problem: Problem, start: Array, search: Search, descend: Descend) -> tuple[Descent, ...]:
    """Search from the start, and from further ones of a Latin hypercube; all candidates are gathered in the problem.

    Each start may take an equal part of the runs that are left. It begins without the candidates of the others, whose
    surfaces would lead it to their designs; a run that several request is computed once. Where all targets are met, no
    further start is needed.

    Parameters
    ----------
    problem : Problem
        Its candidates grow.
    start : (n,) array
        Shares of the ranges.
    search : Search
    descend : callable
        The local search.

    Returns
    -------
    tuple of Descent
        One for each start that was taken.
    """
    begins = [start, *spread(problem, search.starts - 1, search.seed)]
    descents: list[Descent] = []
    for number, begin in enumerate(begins):
        most = problem.remaining // (len(begins) - number)
        if most < 1:
            break
        part = replace(problem, candidates=[], most=most)
        ending = descend(part, begin, search)
        places = [_place(problem, each) for each in part.candidates]
        best = best_of(part)
        place = None if best is None else places[[each is best for each in part.candidates].index(True)]
        descents.append(Descent(start=places[0], best=place, ending=ending))
        if ending is Ending.CONVERGED and not problem.objectives:
            break
    return tuple(descents)


def best_of(problem: Problem) -> Candidate | None:
    """Return the candidate of least merit; those that satisfy the limits come first.

    Parameters
    ----------
    problem : Problem

    Returns
    -------
    Candidate or None
        None where no run gave a response.
    """
    return min(problem.known, key=lambda each: (not each.score.feasible, merit(problem, each.score)), default=None)


def spread(problem: Problem, count: int, seed: int) -> list[Array]:
    """Return designs of a Latin hypercube that satisfy the rules.

    Parameters
    ----------
    problem : Problem
    count : int
    seed : int

    Returns
    -------
    list of (n,) array
        Shares of the ranges; fewer than requested where the rules leave little room.
    """
    designs: list[Array] = []
    for more in range(TRUST_REGION.tries if count > 0 else 0):
        draws = qmc.LatinHypercube(d=len(problem.factors), seed=seed + more).random(count)
        designs.extend(problem.snapped(point) for point in draws if not problem.broken(point))
        if len(designs) >= count:
            break
    return designs[: max(count, 0)]


def _place(problem: Problem, candidate: Candidate) -> int:
    """Return the row of a candidate, which is added where no start has computed it before."""
    keys = [each.row.ended.run.key for each in problem.candidates]
    key = candidate.row.ended.run.key
    if key not in keys:
        problem.candidates.append(candidate)
        return len(keys)
    return keys.index(key)
