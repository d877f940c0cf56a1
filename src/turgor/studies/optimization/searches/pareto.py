"""Several objectives: the front of designs that no other one beats, searched with NSGA-II and computed."""

from collections.abc import Callable, Sequence
from importlib import import_module
from typing import Any

import numpy as np
from numpy.typing import NDArray

from turgor.foundation.round_off import ROUND_OFF
from turgor.studies.optimization.problem import Candidate, Problem
from turgor.studies.optimization.search import Ending, Search
from turgor.studies.optimization.searches.starts import spread
from turgor.studies.optimization.searches.surfaces import surfaces_through
from turgor.studies.optimization.settings import PARETO
from turgor.studies.runs.optional_parts import needed
from turgor.studies.runs.settings import RUNS

Array = NDArray[np.float64]


def pareto_search(problem: Problem, start: Array, search: Search) -> Ending:
    """Search for the front on surfaces, and compute the predicted designs.

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
    first = max(2 * len(start) + 2, round(PARETO.first_share * problem.most))
    problem.compute([start, *spread(problem, first - 1, search.seed)])
    quiet = 0
    while problem.remaining > 0 and quiet < RUNS.idle:
        known = problem.known
        if len(known) < len(start) + 1:
            return Ending.FAILED if not known else Ending.BUDGET
        surfaces = surfaces_through(np.array([each.at for each in known]), np.array([each.readings for each in known]))
        points = _nondominated(problem, surfaces, (PARETO.population, PARETO.generations), search.seed)
        chosen, gap = _apart(problem, points, surfaces, min(PARETO.batch, problem.remaining))
        if not chosen:
            quiet += 1
            break
        before = len(problem.candidates)
        computed = [each for each in problem.compute(chosen) if each.known]
        if len(problem.candidates) == before:
            break
        quiet = quiet + 1 if gap < PARETO.gap and _as_promised(problem, computed, surfaces) else 0
    return _ended(problem, quiet > 0)


def evolution(problem: Problem, start: Array, search: Search) -> Ending:
    """Search for the front with NSGA-II, each design of a generation computed.

    Parameters
    ----------
    problem : Problem
    start : (n,) array
    search : Search

    Returns
    -------
    Ending
    """
    problem.compute([start])
    size = min(PARETO.computed_population, max(problem.remaining, 2))

    def readings(points: Array) -> Array:
        if problem.remaining > 0:
            problem.compute(list(points))
        known = {each.row.ended.run.key: each.readings for each in problem.candidates}
        keys = [problem.computation.run(problem.values(point)).key for point in points]
        missing = np.full(len(problem.candidates[0].readings), np.nan)
        return np.array([known.get(key, missing) for key in keys])

    _nondominated(problem, readings, (size, max(problem.remaining // size, 1)), search.seed)
    return Ending.BUDGET if _front(problem) else _ended(problem, False)


def front_of(problem: Problem) -> list[Candidate]:
    """Return the candidates within the limits that no other one beats, in the order of the first objective."""
    return sorted(_front(problem), key=lambda each: each.score.objectives)


def best_of_front(problem: Problem, front: Sequence[Candidate]) -> Candidate:
    """Return the design whose worst objective is best, within the ranges of the front."""
    values = np.array([each.score.objectives for each in front])
    ranges = np.ptp(values, axis=0)
    shares = (values - values.min(axis=0)) / np.where(ranges > 0, ranges, 1.0)
    return front[int(np.argmin(shares.max(axis=1)))]


def _front(problem: Problem) -> list[Candidate]:
    allowed = [each for each in problem.known if each.score.feasible]
    values = np.array([each.score.objectives for each in allowed]).reshape(len(allowed), -1)
    return [each for each, here in zip(allowed, values, strict=True) if not _beaten(here, values)]


def _beaten(here: Array, others: Array) -> bool:
    return bool(np.any((others <= here).all(axis=1) & (others < here).any(axis=1)))


def _nondominated(
    problem: Problem, readings: Callable[[Array], Array], effort: tuple[int, int], seed: int
) -> list[Array]:
    """Run NSGA-II on a function that gives readings of designs, and return the front."""
    nsga2 = needed("pymoo.algorithms.moo.nsga2", "a search for several objectives").NSGA2
    minimize = needed("pymoo.optimize", "a search for several objectives").minimize
    size, generations = effort
    ended = minimize(
        _pymoo_problem(problem, readings), nsga2(pop_size=size, eliminate_duplicates=True), ("n_gen", generations),
        seed=seed + 1, verbose=False,
    )  # fmt: skip
    return [] if ended.X is None else [problem.snapped(point) for point in np.atleast_2d(ended.X)]


def _pymoo_problem(problem: Problem, readings: Callable[[Array], Array]) -> Any:
    """Return the problem as pymoo takes it: objectives, and violations that must not be above 0."""
    base = import_module("pymoo.core.problem").Problem
    count, size = len(problem.objectives), len(problem.factors)

    def _evaluate(self: Any, x: Array, out: dict[str, Array], *_: Any, **__: Any) -> None:
        scores = [problem.score(each) for each in readings(np.array([problem.snapped(point) for point in x]))]
        broken = np.array([problem.margins(point).min(initial=0.0) < -ROUND_OFF.same for point in x])
        values = np.array([each.objectives if each.known else (1e9,) * count for each in scores])
        violated = np.array([each.violation - 1.0 if each.known else 1e9 for each in scores])
        out["F"], out["G"] = values, np.column_stack([violated, broken.astype(float)])

    kind = type("Designs", (base,), {"_evaluate": _evaluate})
    return kind(n_var=size, n_obj=count, n_ieq_constr=2, xl=np.zeros(size), xu=np.ones(size))


def _apart(problem: Problem, points: Sequence[Array], surfaces: Any, count: int) -> tuple[list[Array], float]:
    """Choose designs of a promised front that are far from what was computed, and say how far the farthest is."""
    promised = np.array([problem.score(surfaces(point)).objectives for point in points]).reshape(len(points), -1)
    if not len(points):
        return [], 0.0
    ranges = np.ptp(promised, axis=0)
    ranges = np.where(ranges > 0, ranges, 1.0)
    # candidates beyond a limit are not on the front, and do not replace a design that is
    taken = [np.array(each.score.objectives) / ranges for each in problem.known if each.score.feasible]
    chosen: list[Array] = []
    farthest = 0.0
    broken = [bool(problem.broken(point)) or _near_failure(problem, point) for point in points]
    for _ in range(count):
        gaps = [
            -1.0 if wrong else min((float(np.linalg.norm(each / ranges - other)) for other in taken), default=1.0)
            for each, wrong in zip(promised, broken, strict=True)
        ]
        place = int(np.argmax(gaps))
        farthest = max(farthest, gaps[place])
        if gaps[place] <= 1e-3:
            break
        chosen.append(points[place])
        taken.append(promised[place] / ranges)
    return chosen, farthest


def _near_failure(problem: Problem, point: Array) -> bool:
    """Whether the nearest candidate gave no value; surfaces are not trusted there."""
    return not min(problem.candidates, key=lambda each: float(np.linalg.norm(each.at - point))).known


def _as_promised(problem: Problem, computed: Sequence[Candidate], surfaces: Any) -> bool:
    """Whether the computed front agrees with the prediction of the surfaces that were fitted before."""
    front = np.array([each.score.objectives for each in _front(problem)])
    if not len(computed) or len(front) < 2:
        return False
    ranges = np.ptp(front, axis=0)
    ranges = np.where(ranges > 0, ranges, 1.0)
    errors = [
        np.abs(np.array(each.score.objectives) - np.array(problem.score(surfaces(each.at)).objectives)) / ranges
        for each in computed
    ]
    return bool(np.max(errors) < PARETO.front_error)


def _ended(problem: Problem, quiet: bool) -> Ending:
    if not problem.known:
        return Ending.FAILED
    if not _front(problem):
        return Ending.INFEASIBLE if problem.remaining <= 0 or quiet else Ending.BUDGET
    return Ending.CONVERGED if quiet else Ending.BUDGET
