"""Grid: the rows of a study on a full grid of its factors, as pictures of effects need them."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import product

import numpy as np

from turgor.studies.runs.factor import Array, Factor, Value
from turgor.studies.runs.study import Study
from turgor.units import unit_value
from turgor.views.plots.studies.effects import Effect


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Grid:
    """The rows of a study on a full grid.

    Parameters
    ----------
    factors : tuple of Factor
        Those that vary.
    levels : tuple of list
        Levels of each in their order.
    rows : array of int
        Number of the row at each point of the grid.
    """

    factors: tuple[Factor, ...]
    levels: tuple[list[Value], ...]
    rows: "np.ndarray[tuple[int, ...], np.dtype[np.int64]]"

    @staticmethod
    def of(study: Study) -> "Grid | None":
        """Return the grid of a study; None where there is none."""
        levels_of: dict[str, list[Value]] = {}
        for each in study.factors:
            values = list(dict.fromkeys(row.values[each.name] for row in study.rows))
            if len(values) > 1:
                levels_of[each.name] = values if each.is_choice else sorted(values)
        factors = tuple(each for each in study.factors if each.name in levels_of)
        levels = tuple(levels_of.values())
        places = {tuple(row.values[each.name] for each in factors): k for k, row in enumerate(study.rows)}
        points = list(product(*levels))
        if not factors or len(points) != len(study.rows) or any(point not in places for point in points):
            return None
        rows = np.array([places[point] for point in points]).reshape([len(each) for each in levels])
        return Grid(factors=factors, levels=levels, rows=rows)

    def effect(self, values: Array, errors: Array, along: int, others: Sequence[int], label: str = "") -> Effect:
        """Return the effect of a factor, at a level of each other one, by its place."""
        index: list[int | slice] = [*others]
        index.insert(along, slice(None))
        rows = self.rows[tuple(index)]
        return Effect(label=label, values=values[rows], errors=errors[rows])

    def ticks(self, along: int) -> list[float | str]:
        """Return the levels of a factor in its unit."""
        factor = self.factors[along]
        return [each if isinstance(each, str) else each / unit_value(factor.unit) for each in self.levels[along]]
