"""Problem: candidates in shares of the ranges, each computed once, and how well each meets the goals."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from turgor.foundation.errors import TurgorError
from turgor.studies.optimization.goals import MET, Goal, Limit, Minimize
from turgor.studies.optimization.rules import Rule
from turgor.studies.runs.computation import Computation
from turgor.studies.runs.evaluations import Evaluations
from turgor.studies.runs.factor import Factor, Value
from turgor.studies.runs.rounding import rounded
from turgor.studies.runs.run import Run
from turgor.studies.runs.study import Row, values_text

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]


@dataclass(frozen=True, slots=True, kw_only=True)
class Score:
    """How well a computed or predicted candidate meets the goals.

    Parameters
    ----------
    objectives : tuple of float
        Values to minimize, each over its scale; without an objective, the length of the misfits.
    violation : float
        The largest miss of a target or passed limit, in units of its tolerance; met up to 1.
    """

    objectives: tuple[float, ...]
    violation: float

    @property
    def known(self) -> bool:
        """Whether all numbers were computed."""
        return bool(np.isfinite([*self.objectives, self.violation]).all())

    @property
    def feasible(self) -> bool:
        """Whether all limits hold, and targets besides an objective are met."""
        return self.known and self.violation <= 1.0


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Candidate:
    """A design that was computed.

    Parameters
    ----------
    at : (n,) array
        Share of the range of each factor.
    row : Row
    readings : (m,) array [SI]
        What the goals read; NaN where the run failed or ends too early.
    score : Score
    slopes : (m, n) array [SI]
        Derivatives of the readings by the shares; NaN where the function does not give them.
    """

    at: Array
    row: Row
    readings: Array
    score: Score
    slopes: Array

    @property
    def known(self) -> bool:
        """Whether all that the goals read was computed."""
        return bool(np.isfinite(self.readings).all())

    @property
    def sloped(self) -> Flags:
        """By which factors the derivatives of all readings are known, (n,)."""
        return np.asarray(np.isfinite(self.slopes).all(axis=0))


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Problem:
    """What is varied, the goals, and the candidates that were computed.

    Parameters
    ----------
    computation : Computation
    factors : tuple of Factor
    goals : tuple of Goal
        With all scales.
    rules : tuple of Rule
    evaluations : Evaluations
    most : int
        Runs at most.
    slopes : bool
        Whether derivatives that responses have are taken.
    candidates : list of Candidate
        In the order of the runs.
    """

    computation: Computation
    factors: tuple[Factor, ...]
    goals: tuple[Goal, ...]
    rules: tuple[Rule, ...]
    evaluations: Evaluations
    most: int
    slopes: bool = True
    candidates: list[Candidate] = field(default_factory=list)

    @property
    def remaining(self) -> int:
        """How many runs are left."""
        return self.most - len(self.candidates)

    @property
    def known(self) -> list[Candidate]:
        """Candidates with all that the goals read."""
        return [each for each in self.candidates if each.known]

    @property
    def levels(self) -> Array:
        """Distance of two whole numbers in shares of the range, 0 for other numbers, (n,)."""
        ranges = [(each.whole, *each.bounds) for each in self.factors]
        return np.array([1 / (high - low) if whole and high > low else 0.0 for whole, low, high in ranges])

    @property
    def objectives(self) -> tuple[Minimize, ...]:
        """What is to be as small or as large as possible."""
        return tuple(each for each in self.goals if isinstance(each, Minimize))

    def snapped(self, at: Array) -> Array:
        """Return shares within the range, rounded for whole numbers."""
        inside, levels = np.clip(at, 0.0, 1.0), self.levels
        steps = np.where(levels > 0, levels, 1.0)
        return np.where(levels > 0, np.round(inside / steps) * steps, inside)

    def values(self, at: Array) -> dict[str, Value]:
        """Return the values of the factors at shares of their ranges [SI]."""
        numbers: dict[str, Value] = {}
        for each, share in zip(self.factors, self.snapped(at), strict=True):
            low, high = each.bounds
            value = low + float(share) * (high - low)
            numbers[each.name] = round(value) if each.whole else rounded(min(max(value, low), high))
        return numbers

    def shares(self, values: Mapping[str, Value]) -> Array:
        """Return shares of the ranges at values."""
        return np.array([each.share_of(values[each.name]) for each in self.factors])

    def margins(self, at: Array) -> Array:
        """Return the margins of the rules, (rules,)."""
        values = self.values(at)
        return np.array([each.of(values) for each in self.rules])

    def broken(self, at: Array) -> str:
        """Return which rule a design breaks; empty where it satisfies all."""
        values = self.values(at)
        return next((why for why in (each.broken(values) for each in self.rules) if why), "")

    def compute(self, points: Sequence[Array], *, nominal: bool = False) -> list[Candidate]:
        """Compute candidates, as far as runs are left; those computed before are not counted again."""
        before = {each.row.ended.run.key: each for each in self.candidates}
        runs: dict[str, tuple[Run, Array, dict[str, Value]]] = {}
        for point in points:
            values = self.values(point)
            run = self.computation.run(values, nominal=nominal, name=values_text(self.factors, values))
            runs.setdefault(run.key, (run, point, values))
        fresh = [entry for key, entry in runs.items() if key not in before][: max(self.remaining, 0)]
        ended = self.evaluations.of([run for run, _, _ in fresh])
        for (_, point, values), each in zip(fresh, ended, strict=True):
            self.candidates.append(self._candidate(self.snapped(point), Row(values=values, ended=each)))
        after = {each.row.ended.run.key: each for each in self.candidates}
        return [after[key] for key in runs if key in after]

    def score(self, readings: Array) -> Score:
        """Return how well readings meet the goals."""
        misfits, excess, objectives = [0.0], [0.0], []
        for goal, part in zip(self.goals, self.parts(readings), strict=True):
            divisor, target = goal.linear()
            scaled = (part - target) / divisor
            if isinstance(goal, Limit):
                excess.extend(scaled.tolist())
            elif isinstance(goal, MET):
                misfits.append(float(np.linalg.norm(scaled)))
            else:
                objectives.append(float(scaled[0]))
        if objectives:
            return Score(objectives=tuple(objectives), violation=_largest([*misfits, *excess]))
        return Score(objectives=(float(np.linalg.norm(misfits)),), violation=_largest(excess))

    def parts(self, readings: Array) -> list[Array]:
        """Split readings by the goals."""
        ends = np.cumsum([0, *(_count(each) for each in self.goals)])
        return [readings[start:end] for start, end in pairwise(ends.tolist())]

    def _candidate(self, at: Array, row: Row) -> Candidate:
        readings = np.concatenate([each.read(row) for each in self.goals])
        names, widths = [each.name for each in self.factors], [high - low for low, high in self._ranges]
        slopes = np.full((len(readings), len(names)), np.nan)
        if self.slopes:
            slopes = np.concatenate([each.slopes(row, names) for each in self.goals]) * widths
        return Candidate(at=at, row=row, readings=readings, score=self.score(readings), slopes=slopes)

    @property
    def _ranges(self) -> list[tuple[float, float]]:
        return [each.bounds for each in self.factors]


def check_factors(factors: Sequence[Factor]) -> None:
    """Raise an error for a factor that no search can move in.

    Parameters
    ----------
    factors : sequence of Factor
    """
    for each in factors:
        if each.is_choice:
            raise TurgorError(
                f"'{each.name}' is a choice ({', '.join(map(str, each.levels))}); a search needs numbers, so optimize "
                "with each choice on its own."
            )
        low, high = each.bounds
        if not low < high:
            raise TurgorError(f"'{each.name}' has one value, {each.shown(low)}; a search needs a range.")


def _largest(values: Sequence[float]) -> float:
    numbers = np.array(values)
    return float("nan") if np.isnan(numbers).any() else float(numbers.max())


def _count(goal: Goal) -> int:
    return 1 if isinstance(goal, Limit | Minimize) or not hasattr(goal, "target") else int(goal.target.size)
