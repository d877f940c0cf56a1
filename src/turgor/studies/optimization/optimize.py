"""optimize: search for the design that meets targets, or is best within limits; every candidate is a row of a study."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from inspect import Parameter, signature

import numpy as np

from turgor.foundation.errors import TurgorError, unknown
from turgor.foundation.response import Response
from turgor.foundation.source import Source
from turgor.studies.optimization.goals import MET, Goal, Minimize, with_scales
from turgor.studies.optimization.outcome_text import ending_text
from turgor.studies.optimization.problem import Candidate, Problem, check_factors
from turgor.studies.optimization.result import Optimization
from turgor.studies.optimization.rules import Rule
from turgor.studies.optimization.search import Search
from turgor.studies.optimization.searches.pareto import best_of_front, evolution, front_of, pareto_search
from turgor.studies.optimization.searches.starts import Descent, best_of, descents_of
from turgor.studies.optimization.searches.trust_region import trust_region
from turgor.studies.runs.computation import Computation
from turgor.studies.runs.evaluations import Evaluations
from turgor.studies.runs.factor import Factor, Value
from turgor.studies.runs.run import Computed
from turgor.studies.runs.study import Study

Function = Callable[..., Response | Computed]

_SEARCHES = {"trust_region": trust_region, "pareto": pareto_search, "evolution": evolution}


def optimize(
    function: Function | Computation,
    factors: Sequence[Factor],
    goals: Sequence[Goal | Rule],
    *,
    start: Mapping[str, Value] | None = None,
    search: Search | None = None,
    evaluations: Evaluations | None = None,
) -> Optimization:
    """Search for the design that meets targets, or is best within limits, with few runs.

    One objective or targets alone are searched in a trust region: surfaces through all candidates say where to go. With
    several objectives, the front of designs that no other one beats is searched (NSGA-II) on such surfaces, and
    what they promise is computed. It then returns its best design; with runs saved in a folder, the same call goes on.

    Parameters
    ----------
    function : callable or Computation
        Function of a module that takes the factors as keywords [SI] and returns a `Response`.
    factors : sequence of Factor
        Numbers to choose, with their ranges.
    goals : sequence of Target, TipPath, Limit, Minimize, Maximize or Rule
        Besides `Minimize` and `Maximize`, targets are conditions to be met within their tolerance.
    start : mapping of str to number, optional
        Where the search begins [SI]; by default the middle of the ranges.
    search : Search, optional
        Method, most runs, precision, number of starts, whether slopes are taken.
    evaluations : Evaluations, optional
        Where runs are computed and saved, such as `turgor.studies.saved_in`; by default in this process, without files.

    Returns
    -------
    Optimization

    Raises
    ------
    TurgorError
        If there is no goal, a factor or a measure is unknown, a factor is a choice, or the start breaks a rule.

    Examples
    --------
    Which radius and length of a tin hold 10 mL with the least surface? It is as high as it is wide, π (2r)³/4 = V:

    >>> from turgor.foundation.response import Column, Response
    >>> from turgor.studies.optimization.goals import Limit
    >>> from turgor.studies.optimization.search import Search
    >>> from turgor.foundation.source import Source
    >>> def tin(radius, length):
    ...     volume, surface = np.pi * radius**2 * length, 2 * np.pi * radius * (radius + length)
    ...     columns = Column("volume", "mL", [volume]), Column("surface", "mm2", [surface])
    ...     return Response(columns=columns, source=Source(text="a tin"))
    >>> factors = [Factor(name=each, low=5e-3, high=40e-3, unit="mm") for each in ("radius", "length")]
    >>> goals = [Minimize("surface"), Limit("volume", least=10e-6)]
    >>> result = optimize(tin, factors, goals, search=Search(most_solves=60))
    >>> surface = result.reads()[0].value
    >>> result.ending.value, round(surface / (6 * np.pi * (10e-6 / 2 / np.pi) ** (2 / 3)), 2)
    ('converged', 1.0)
    """
    computation = function if isinstance(function, Computation) else Computation(function=function)
    settings = search or Search()
    check_factors(factors)
    _check_names(computation, factors)
    problem = _problem(computation, factors, goals, settings, evaluations or Evaluations())
    descend = _SEARCHES[_method(settings, problem.goals)]
    begin = _start(problem, start)
    problem = replace(problem, goals=_scaled(problem, begin))
    return _result(problem, descents_of(problem, begin, settings, descend), settings)


def _problem(
    computation: Computation,
    factors: Sequence[Factor],
    goals: Sequence[Goal | Rule],
    search: Search,
    evaluations: Evaluations,
) -> Problem:
    """Part goals and rules, and set the budget."""
    return Problem(
        computation=computation, factors=tuple(factors), evaluations=evaluations,
        goals=tuple(each for each in goals if not isinstance(each, Rule)),
        rules=tuple(each for each in goals if isinstance(each, Rule)), most=search.most_solves, slopes=search.slopes,
    )  # fmt: skip


def _result(problem: Problem, descents: tuple[Descent, ...], search: Search) -> Optimization:
    """Gather the result; the status is that of the search that reached the best design."""
    front = front_of(problem) if len(problem.objectives) > 1 else []
    best = best_of_front(problem, front) if front else best_of(problem)
    led = [each for each in descents if each.best is not None and problem.candidates[each.best] is best]
    ending = (led or descents)[0].ending
    if best is not None and problem.computation.nominal:
        best = _verified(problem, best)
    rows = [each.row for each in problem.candidates]
    names = ", ".join(each.name for each in problem.factors)
    study = Study(factors=problem.factors, rows=tuple(rows), source=Source(text=f"optimization of {names}"))
    message, advice = ending_text(problem, ending, best, search)
    places = {id(each.row): number for number, each in enumerate(problem.candidates)}
    return Optimization(
        study=study, goals=problem.goals, scores=tuple(each.score for each in problem.candidates), start=0,
        best=None if best is None else places[id(best.row)], pareto=tuple(places[id(each.row)] for each in front),
        ending=ending, message=message, advice=advice, descents=descents,
        notes=next((each.ended.result.notes for each in rows if each.ended.result and each.ended.result.notes), ()),
    )  # fmt: skip


def _verified(problem: Problem, best: Candidate) -> Candidate:
    """Compute the best design once more with the arguments of the nominal run, such as for its mesh error."""
    place = next(number for number, each in enumerate(problem.candidates) if each is best)
    extra = replace(problem, most=len(problem.candidates) + 1, candidates=list(problem.candidates))
    (computed,) = extra.compute([best.at], nominal=True)
    if computed.known:
        problem.candidates[place] = computed
        return computed
    return best


def _start(problem: Problem, start: Mapping[str, Value] | None) -> np.ndarray:
    """Return the shares at which the search begins."""
    given = dict(start or {})
    known = {each.name: each for each in problem.factors}
    for name, value in given.items():
        if name not in known:
            raise unknown("factor in start", name, known)
        low, high = known[name].bounds
        if not low <= float(value) <= high:
            each = known[name]
            raise TurgorError(
                f"the start of '{name}' is {each.shown(value)}; allowed is {each.shown(low)} to {each.shown(high)}, "
                "its range."
            )
    begin = np.array([each.share_of(given[each.name]) if each.name in given else 0.5 for each in problem.factors])
    begin = problem.snapped(begin)
    broken = problem.broken(begin)
    if broken:
        shown = ", ".join(f"{each.name} {each.shown(problem.values(begin)[each.name])}" for each in problem.factors)
        raise TurgorError(f"the start ({shown}) breaks the rule '{broken}'; begin at a design that keeps it.")
    return begin


def _scaled(problem: Problem, begin: np.ndarray) -> tuple[Goal, ...]:
    """Compute the start, and give its values as scales to objectives without one."""
    (first,) = replace(problem, candidates=[]).compute([begin])
    return with_scales(problem.goals, first.row)


def _method(search: Search, goals: Sequence[Goal]) -> str:
    """Return the method, after a check that it fits the goals."""
    count = sum(isinstance(each, Minimize) for each in goals)
    if not count and not any(isinstance(each, MET) for each in goals):
        raise TurgorError("goals has neither a target nor an objective; add a Target, TipPath, Minimize or Maximize.")
    if search.starts > 1 and count > 1:
        raise TurgorError(f"starts is {search.starts}; a search for a front begins all over the ranges, leave it out.")
    if search.method == "auto":
        return "pareto" if count > 1 else "trust_region"
    if search.method == "trust_region" and count > 1:
        raise TurgorError(f"trust_region searches for one objective, and goals has {count}; take the method 'pareto'.")
    if search.method != "trust_region" and count < 2:
        raise TurgorError(
            f"{search.method} searches for several objectives, and goals has {count}; take 'trust_region'."
        )
    return search.method


def _check_names(computation: Computation, factors: Sequence[Factor]) -> None:
    """Raise an error for a factor that the function does not take."""
    if computation.gather:
        return
    takes = signature(computation.function).parameters
    if any(each.kind is Parameter.VAR_KEYWORD for each in takes.values()):
        return
    for each in factors:
        if each.name not in takes:
            raise unknown("factor", each.name, takes)
