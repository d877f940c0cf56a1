"""The best step that surfaces promise within a box around a candidate, under limits and rules."""

from collections.abc import Callable
from dataclasses import dataclass
from itertools import product
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import minimize

from turgor.studies.optimization.goals import MET, Limit
from turgor.studies.optimization.problem import Problem, Score
from turgor.studies.optimization.searches.surfaces import Surfaces
from turgor.studies.optimization.settings import TRUST_REGION

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Box:
    """Where a step may lead.

    Parameters
    ----------
    center : (n,) array
    radius : float
        Half the width, in shares of the ranges.
    """

    center: Array
    radius: float

    def limits(self, levels: Array) -> tuple[Array, Array]:
        """Return the lowest and highest shares; whole numbers may always move by one."""
        reach = np.maximum(self.radius, levels)
        return np.maximum(self.center - reach, 0.0), np.minimum(self.center + reach, 1.0)


def merit(problem: Problem, score: Score) -> float:
    """Return what a step is to lower: the objective, and a penalty of what is violated."""
    if not score.known:
        return float("inf")
    return score.objectives[0] + max(score.violation - TRUST_REGION.aim, 0.0)


def best_step(problem: Problem, surfaces: Surfaces, box: Box, seed: int) -> Array:
    """Return the point in a box at which the surfaces promise most.

    Parameters
    ----------
    problem : Problem
    surfaces : Surfaces
    box : Box
    seed : int
        Of the random beginnings.

    Returns
    -------
    (n,) array
        Shares of the ranges that keep the rules; the center where nothing better does.
    """
    low, high = box.limits(problem.levels)
    draws = np.random.default_rng(seed).uniform(low, high, size=(TRUST_REGION.beginnings, len(low)))
    lowest = [_minimized(problem, surfaces, begin, (low, high)) for begin in (box.center, *draws)]
    points = [each for point in lowest for each in _whole(problem, surfaces, point, (low, high))]
    points = [_kept(problem, box.center, point) for point in points]
    return min([box.center, *points], key=lambda at: merit(problem, problem.score(surfaces(at))))


def _minimized(
    problem: Problem,
    surfaces: Surfaces,
    begin: Array,
    limits: tuple[Array, Array],
    fixed: Flags | None = None,
) -> Array:
    """Minimize what the surfaces say, with one slack for all that may be violated."""
    low, high = limits
    if fixed is not None:
        low, high = np.where(fixed, begin, low), np.where(fixed, begin, high)
    smooth = _Smooth(problem, surfaces)
    slack = max(float(smooth.conditions(begin)[0].max(initial=0.0)), 0.0)

    def objective(z: Array) -> tuple[float, Array]:
        value, slope = smooth.objective(z[:-1])
        return value + z[-1], np.append(slope, 1.0)

    constraints: list[dict[str, Any]] = [
        {
            "type": "ineq",
            "fun": lambda z: z[-1] - smooth.conditions(z[:-1])[0],
            "jac": lambda z: np.column_stack([-smooth.conditions(z[:-1])[1], np.ones(smooth.count)]),
        }
    ]
    constraints += [_rule(problem, number, begin) for number in range(len(problem.rules))]
    bounds = [*zip(low.tolist(), high.tolist(), strict=True), (0.0, None)]
    ended = minimize(
        objective, np.append(np.clip(begin, low, high), slack), jac=True, bounds=bounds, constraints=constraints,
        method="SLSQP", options={"maxiter": 100, "ftol": 1e-10},
    )  # fmt: skip
    return np.clip(ended.x[:-1], low, high) if np.isfinite(ended.x).all() else begin


class _Smooth:
    """Objective and conditions on the surfaces, with their derivatives."""

    def __init__(self, problem: Problem, surfaces: Surfaces) -> None:
        self.problem, self.surfaces = problem, surfaces
        self.count = len(self.conditions(np.full(surfaces.points.shape[1], 0.5))[0])

    def objective(self, at: Array) -> tuple[float, Array]:
        """Return the objective, or the smoothed length of the misfits, and its derivatives."""
        pairs = self._scaled(at)
        for goal, (values, slopes) in zip(self.problem.goals, pairs, strict=True):
            if not isinstance(goal, (*MET, Limit)):
                return float(values[0]), slopes[0]
        goals = zip(self.problem.goals, pairs, strict=True)
        targets = [pair for goal, pair in goals if isinstance(goal, MET)]
        values = np.concatenate([values for values, _ in targets])
        slopes = np.concatenate([slopes for _, slopes in targets])
        length = float(np.sqrt(values @ values + TRUST_REGION.aim**2))
        return length, (values @ slopes) / length

    def conditions(self, at: Array) -> tuple[Array, Array]:
        """Return what must not be above 0, and its derivatives: limits, and targets besides an objective."""
        violations, slopes = [0.0], [np.zeros(len(at))]
        for goal, (values, slope) in zip(self.problem.goals, self._scaled(at), strict=True):
            if isinstance(goal, Limit):
                violations.extend((values - TRUST_REGION.aim).tolist())
                slopes.extend(slope)
            elif isinstance(goal, MET) and self.problem.objectives:
                length = float(np.sqrt(values @ values + TRUST_REGION.aim**2))
                violations.append(length - TRUST_REGION.aim)
                slopes.append((values @ slope) / length)
        return np.array(violations), np.array(slopes)

    def _scaled(self, at: Array) -> list[tuple[Array, Array]]:
        """Return scaled values of each goal and their derivatives."""
        parts, gradient = self.problem.parts(self.surfaces(at)), self.surfaces.gradient(at)
        pairs, begun = [], 0
        for goal, part in zip(self.problem.goals, parts, strict=True):
            divisor, wanted = goal.linear()
            slopes = gradient[begun : begun + len(part)] / divisor[:, None]
            pairs.append(((part - wanted) / divisor, slopes))
            begun += len(part)
        return pairs


def _rule(problem: Problem, number: int, center: Array) -> dict[str, Any]:
    """Return a rule as a condition of about the size of a share."""
    rule = problem.rules[number]

    def relaxed(at: Array) -> float:
        # not rounded, so that differences of small steps are right
        values = problem.values(at)
        for each, share in zip(problem.factors, at, strict=True):
            if not each.whole:
                values[each.name] = each.bounds[0] + float(share) * (each.bounds[1] - each.bounds[0])
        return max(rule.of(values), -1.0)

    here = relaxed(center)
    changes = [abs(relaxed(center + step) - here) / 1e-3 for step in 1e-3 * np.eye(len(center))]
    size = max([each for each in changes if np.isfinite(each) and each > 0], default=1.0)
    return {"type": "ineq", "fun": _of_shares(relaxed, size)}


def _of_shares(relaxed: Callable[[Array], float], size: float) -> Callable[[Array], float]:
    return lambda z: relaxed(z[:-1]) / size


def _whole(problem: Problem, surfaces: Surfaces, point: Array, limits: tuple[Array, Array]) -> list[Array]:
    """Round whole numbers to both sides, and search again in the others."""
    levels = problem.levels
    which = np.flatnonzero(levels > 0)[: TRUST_REGION.whole]
    if not len(which):
        return [point]
    choices = [
        sorted({float(np.clip(side(point[k] / levels[k]) * levels[k], *(end[k] for end in limits))) for side in _SIDES})
        for k in which
    ]
    rounded = []
    for chosen in product(*choices):
        begin = problem.snapped(point)
        begin[which] = chosen
        begin = problem.snapped(begin)
        rounded.append(_minimized(problem, surfaces, begin, limits, levels > 0) if len(which) < len(point) else begin)
    return rounded


_SIDES = (np.floor, np.ceil)


def _kept(problem: Problem, center: Array, point: Array) -> Array:
    """Go back to the center until the rules are kept."""
    for share in (1.0, 0.75, 0.5, 0.25):
        there = problem.snapped(center + share * (point - center))
        if not problem.broken(there):
            return there
    return center
