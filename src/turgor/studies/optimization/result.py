"""Optimization: the best design, all candidates as a study, and how the search ended."""

from dataclasses import dataclass

import numpy as np

from turgor.studies.optimization.goals import Goal, Minimize
from turgor.studies.optimization.problem import Score
from turgor.studies.optimization.row_values import Read
from turgor.studies.optimization.search import Ending
from turgor.studies.optimization.searches.starts import Descent
from turgor.studies.runs.factor import Value
from turgor.studies.runs.study import Row, Study


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Optimization:
    """Result of an optimization.

    Parameters
    ----------
    study : Study
        Every candidate is a row, in the order of the runs.
    goals : tuple of Goal
        The goals, with all scales.
    scores : tuple of Score
        How well each row meets the goals.
    start : int
        Row of the start.
    best : int or None
        Row of the best design; of several objectives, the one whose worst objective is best within the ranges of the
        front. None where no run gave a response.
    pareto : tuple of int
        Rows that no other one beats in all objectives, in the order of the first; empty for one objective.
    ending : Ending
    message : str
        How it ended, in a sentence.
    advice : str
        What to do; empty where nothing is to be done.
    descents : tuple of Descent
        Where the search from each start ended, the first one from ``start``.
    notes : tuple of str
        What the runs say of themselves, such as why they have no slopes: those of the first one that says something.
    """

    study: Study
    goals: tuple[Goal, ...]
    scores: tuple[Score, ...]
    start: int
    best: int | None
    pareto: tuple[int, ...]
    ending: Ending
    message: str
    advice: str
    descents: tuple[Descent, ...] = ()
    notes: tuple[str, ...] = ()

    @property
    def converged(self) -> bool:
        """Whether all targets are met, or no better design is near."""
        return self.ending is Ending.CONVERGED

    @property
    def solves(self) -> int:
        """Count the runs, those included that were read from disk."""
        return len(self.study)

    @property
    def best_row(self) -> Row | None:
        """Row of the best design."""
        return None if self.best is None else self.study.rows[self.best]

    @property
    def values(self) -> dict[str, Value]:
        """Values of the best design by factor [SI]; empty where no run gave a response."""
        return {} if self.best_row is None else dict(self.best_row.values)

    def reads(self, row: int | None = None) -> tuple[Read, ...]:
        """Return what each goal reads from a row; by default from the best design."""
        number = self.best if row is None else row
        return () if number is None else tuple(each.reading(self.study.rows[number]) for each in self.goals)

    def objectives(self) -> np.ndarray:
        """Return the objectives of the rows [SI], (rows, objectives), as they are reported; NaN where a run failed."""
        objectives = [each for each in self.goals if isinstance(each, Minimize)]
        return np.array([[each.read(row)[0] for each in objectives] for row in self.study.rows])

    def summary(self) -> str:
        """Return the result as text: how it ended, the design, and what it reaches, before and after."""
        lines = [self.message, *([self.advice] if self.advice else [])]
        if self.best is None:
            return "\n".join(lines)
        start, best = self.study.rows[self.start], self.study.rows[self.best]
        for each in self.study.factors:
            before, after = each.shown(start.values[each.name]), each.shown(best.values[each.name])
            lines.append(f"{each.name}: {before} → {after}{_at_end(each.bounds, best.values[each.name])}")
        for goal in self.goals:
            before_read, after_read = goal.reading(start), goal.reading(best)
            if before_read.name == after_read.name and np.isfinite(before_read.value):
                lines.append(f"{after_read}, at the start {before_read.short}")
            else:
                lines.append(str(after_read))
        return "\n".join([*lines, *self.descent_lines(), *self.front_lines(), *self.notes])

    def descent_lines(self) -> list[str]:
        """Return where the search from each start ended as lines of text; none for one start."""
        if len(self.descents) < 2:
            return []
        lines = [f"{len(self.descents)} starts; the best design of each:"]
        for each in self.descents:
            begun = self.study.values_text(self.study.rows[each.start].values)
            if each.best is None:
                lines.append(f"  from {begun}: no run gave all values")
                continue
            values = "; ".join(f"{read.name} {read.short}" for read in self.reads(each.best))
            led = self.study.values_text(self.study.rows[each.best].values)
            lines.append(f"  from {begun}: {led}: {values} ({each.ending.value.replace('_', ' ')})")
        return lines

    def front_lines(self) -> list[str]:
        """Return the Pareto front as lines of text; none for one objective."""
        if not self.pareto:
            return []
        lines = [f"{len(self.pareto)} designs that no other one beats in all objectives:"]
        for number in self.pareto:
            values = "; ".join(f"{each.name} {each.short}" for each in self.reads(number))
            lines.append(f"  {self.study.values_text(self.study.rows[number].values)}: {values}")
        return lines


def _at_end(bounds: tuple[float, float], value: Value) -> str:
    """Say that a value is at an end of its range."""
    low, high = bounds
    near = 1e-6 * (high - low)
    if float(value) <= low + near:
        return " (at the lower end of its range)"
    return " (at the upper end of its range)" if float(value) >= high - near else ""
