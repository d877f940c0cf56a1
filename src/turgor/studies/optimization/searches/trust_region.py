"""Search in a trust region: surfaces through all candidates predict the best step within it.

The method is that of Wild, Regis and Shoemaker (ORBIT, SIAM J. Sci. Comput. 30, 2008), with a surface for each reading
instead of one for the objective, as it is usual for least squares: what a goal makes of a reading is known.
"""

import numpy as np
from numpy.typing import NDArray

from turgor.studies.optimization.goals import MET
from turgor.studies.optimization.problem import Candidate, Problem
from turgor.studies.optimization.search import Ending, Search
from turgor.studies.optimization.searches.step import Box, best_step, merit
from turgor.studies.optimization.searches.surfaces import Surfaces, surfaces_through
from turgor.studies.optimization.settings import TRUST_REGION

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]


def trust_region(problem: Problem, start: Array, search: Search) -> Ending:
    """Minimize one objective, or meet the targets, under limits and rules.

    Parameters
    ----------
    problem : Problem
    start : (n,) array
        Shares of the ranges.
    search : Search

    Returns
    -------
    Ending
    """
    begun = _begun(problem, start, search)
    if begun is None:
        return Ending.FAILED if problem.remaining <= 0 or not problem.known else Ending.BUDGET
    problem.compute(_around(problem, begun))
    center, radius = _lowest(problem), TRUST_REGION.first_radius
    while problem.remaining > 0:
        if _all_met(problem, center):
            return Ending.CONVERGED
        surfaces = _surfaces(problem, TRUST_REGION.spanned / 2 * radius)
        box = Box(center=center.at, radius=radius)
        to = best_step(problem, surfaces, box, search.seed + len(problem.candidates))
        step = float(np.abs(to - center.at).max())
        missing = _missing_direction(problem, center, radius)
        if _is_idle(problem, surfaces, center, to, search.precision):
            if missing is None and radius <= TRUST_REGION.last_region * search.precision:
                return _ended(problem, center)
            center, radius = _narrowed(problem, center, radius, missing, search)
            continue
        promised = merit(problem, center.score) - merit(problem, problem.score(surfaces(to)))
        (there,) = problem.compute([to]) or [center]
        gained = merit(problem, center.score) - merit(problem, there.score)
        share = gained / promised if np.isfinite(gained) else -1.0
        if share < TRUST_REGION.poor and missing is not None and problem.remaining > 0:
            problem.compute([missing])
        elif share < TRUST_REGION.poor:
            radius = max(radius / 4, min(radius, step) / 2)
        elif share > TRUST_REGION.good and step > 0.9 * radius:
            radius = min(2 * radius, TRUST_REGION.widest)
        center = _lowest(problem)
        if radius < search.precision:
            return _ended(problem, center)
    return Ending.CONVERGED if _all_met(problem, center) else Ending.BUDGET


def _begun(problem: Problem, start: Array, search: Search) -> Candidate | None:
    """Compute the start, or other points until one gives a response."""
    draws = np.random.default_rng(search.seed).uniform(0, 1, size=(TRUST_REGION.tries, len(start)))
    near = [start + (other - start) / 2 for other in draws]
    for point in (start, *near):
        if not problem.broken(point):
            for each in problem.compute([point]):
                if each.known:
                    return each
        if problem.remaining <= 0:
            return None
    return None


def _around(problem: Problem, begun: Candidate) -> list[Array]:
    """Return a point near the start along each factor without slopes, on the side with more room within the rules."""
    around, center = [], begun.at
    for direction in np.eye(len(center))[~begun.sloped]:
        reach = max(TRUST_REGION.first_radius, float(problem.levels @ direction))
        sides = (1.0, -1.0) if direction @ center <= 0.5 else (-1.0, 1.0)
        points = [problem.snapped(center + share * side * reach * direction) for share in (1.0, 0.5) for side in sides]
        allowed = [point for point in points if np.any(point != center) and not problem.broken(point)]
        around.extend(allowed[:1])
    return around


def _surfaces(problem: Problem, step: float) -> Surfaces:
    """Return surfaces through the candidates, and, where slopes are known, through points next to them."""
    points, values = [], []
    for each in problem.known:
        points.append(each.at)
        values.append(each.readings)
        points.extend(each.at + step * np.eye(len(each.at))[each.sloped])
        values.extend(each.readings + step * each.slopes.T[each.sloped])
    return surfaces_through(np.array(points), np.array(values))


def _lowest(problem: Problem) -> Candidate:
    return min(problem.known, key=lambda each: merit(problem, each.score))


def _all_met(problem: Problem, center: Candidate) -> bool:
    """Whether there are only targets and limits, and all are met."""
    return not problem.objectives and center.score.feasible and _worst_misfit(problem, center) <= 1.0


def _worst_misfit(problem: Problem, candidate: Candidate) -> float:
    lengths = [0.0]
    for goal, part in zip(problem.goals, problem.parts(candidate.readings), strict=True):
        if isinstance(goal, MET):
            divisor, target = goal.linear()
            lengths.append(float(np.linalg.norm((part - target) / divisor)))
    return max(lengths)


def _is_idle(problem: Problem, surfaces: Surfaces, center: Candidate, to: Array, precision: float) -> bool:
    """Whether a step is too small, or its predicted gain is."""
    here = merit(problem, center.score)
    gain = here - merit(problem, problem.score(surfaces(to)))
    small = bool(np.abs(to - center.at).max() < precision)
    worth = TRUST_REGION.worth if problem.objectives else TRUST_REGION.worth_of_misfits
    return (small and gain < worth) or gain < TRUST_REGION.least_gain * max(abs(here), TRUST_REGION.least_gain)


def _narrowed(
    problem: Problem, center: Candidate, radius: float, missing: Array | None, search: Search
) -> tuple[Candidate, float]:
    """Compute a point in a missing direction, or take a smaller region, where no step has a predicted gain."""
    if missing is not None:
        before = len(problem.candidates)
        problem.compute([missing])
        if len(problem.candidates) > before:
            return _lowest(problem), radius
    last = TRUST_REGION.last_region * search.precision
    return center, max(radius / 4, last) if radius > last else radius / 2


def _missing_direction(problem: Problem, candidate: Candidate, radius: float) -> Array | None:
    """Return a point in the direction that no candidate in the region lies in; None where they or slopes span it."""
    center, moving = candidate.at, (problem.levels <= TRUST_REGION.near * radius) & ~candidate.sloped
    if not moving.any():
        return None
    away = np.array([each.at - center for each in problem.known]) / radius
    near = away[np.abs(away).max(axis=1) <= TRUST_REGION.near][:, moving]
    _, sizes, directions = np.linalg.svd(near, full_matrices=True)
    if len(sizes) == moving.sum() and sizes[-1] >= TRUST_REGION.spanned:
        return None
    return _toward(problem, center, radius, moving, directions[-1])


def _toward(problem: Problem, center: Array, radius: float, moving: Flags, direction: Array) -> Array | None:
    step = np.zeros(len(center))
    step[moving] = direction / direction[np.argmax(np.abs(direction))]  # the sign of a singular vector is round-off
    points = [problem.snapped(center + side * radius * step) for side in (1.0, -1.0)]
    tried, apart = [each.at for each in problem.candidates], TRUST_REGION.spanned * radius
    new = [
        point
        for point in points
        if not problem.broken(point) and min(np.abs(point - each).max() for each in tried) > apart
    ]
    return max(new, key=lambda point: float(np.abs(point - center).max()), default=None)


def _ended(problem: Problem, center: Candidate) -> Ending:
    """Return the ending where no step has a predicted gain."""
    met = center.score.feasible and (bool(problem.objectives) or _worst_misfit(problem, center) <= 1.0)
    return Ending.CONVERGED if met else Ending.INFEASIBLE
