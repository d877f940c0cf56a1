"""Factor: a number or a choice that a study varies, with its range or its levels."""

from collections.abc import Sequence
from dataclasses import dataclass
from math import isfinite

import numpy as np
from numpy.typing import NDArray

from turgor.foundation.errors import TurgorError, unknown
from turgor.foundation.store.limits import most_designs
from turgor.studies.runs.settings import RUNS
from turgor.units import unit_value

Array = NDArray[np.float64]
Value = float | int | str


@dataclass(frozen=True, slots=True, kw_only=True)
class Factor:
    """A number or a choice that a study varies.

    Parameters
    ----------
    name : str
        Keyword of the function, field of the design, or key of a job, such as ``"actuator.wall"``. Keys of a job with
        commas between them have one value.
    low, high : float or None [SI]
        Range of a number; by default that of its levels.
    levels : tuple of float, int or str [SI]
        Values of a full factorial. Text is a choice, such as a record of the library or a kind of cells.
    unit : str
        Unit in which values are shown, such as ``"mm"``.
    whole : bool
        Whether values are whole numbers, such as a number of chambers.

    Raises
    ------
    TurgorError
        If there is neither a range nor a level, a range is empty, or numbers and choices are mixed.

    Examples
    --------
    >>> wall = Factor(name="wall", low=1e-3, high=2e-3, unit="mm")
    >>> wall.spaced(3), wall.shown(1.5e-3)
    ((0.001, 0.0015, 0.002), '1.5 mm')
    >>> Factor(name="chambers", levels=(4, 6, 8), whole=True).bounds
    (4.0, 8.0)
    """

    name: str
    low: float | None = None
    high: float | None = None
    levels: tuple[Value, ...] = ()
    unit: str = ""
    whole: bool = False

    def __post_init__(self) -> None:
        texts = [level for level in self.levels if isinstance(level, str)]
        if texts and len(texts) < len(self.levels):
            raise TurgorError(f"levels of '{self.name}' are {list(self.levels)}; give either numbers or choices.")
        if texts and not (self.low is None and self.high is None):
            raise TurgorError(f"'{self.name}' is a choice, which has no range; leave out low and high.")
        if not self.levels and (self.low is None or self.high is None):
            raise TurgorError(f"'{self.name}' needs low and high, or levels.")
        for each in (*self.levels, self.low, self.high):
            if not (isinstance(each, str) or each is None or isfinite(each)):
                raise TurgorError(f"'{self.name}' has the value {each:g}; a finite number is needed.")
        if not texts:
            low, high = self.bounds
            if not low < high and len(self.levels) != 1:
                raise TurgorError(f"'{self.name}' goes from {low:g} to {high:g}; low must be below high.")

    @property
    def is_choice(self) -> bool:
        """Whether its values are text."""
        return any(isinstance(level, str) for level in self.levels)

    @property
    def bounds(self) -> tuple[float, float]:
        """Lowest and highest value of a number [SI]."""
        numbers = [float(level) for level in self.levels]
        low = min(numbers) if self.low is None else self.low
        return low, max(numbers) if self.high is None else self.high

    def at(self, share: float) -> Value:
        """Return the value at a share of the range, from 0 to 1; of a whole number or a choice, each has equal room."""
        if self.is_choice:
            return self.levels[min(int(share * len(self.levels)), len(self.levels) - 1)]
        low, high = self.bounds
        if self.whole:
            return min(int(low + share * (high - low + 1)), int(high))
        return low + share * (high - low)

    def share_of(self, value: Value) -> float:
        """Return which share of the range a number has; 0.5 where the range is a point."""
        low, high = self.bounds
        return (float(value) - low) / (high - low) if high > low else 0.5

    def number(self, value: Value) -> float:
        """Return the value of a number, or the place of a choice among its levels, from 0; others are refused."""
        if not self.is_choice:
            if isinstance(value, str):
                raise TurgorError(f"'{self.name}' is '{value}'; a number is needed.")
            return float(value)
        if value not in self.levels:
            raise unknown(f"choice of '{self.name}'", str(value), map(str, self.levels))
        return float(self.levels.index(value))

    def value(self, number: float) -> Value:
        """Return the value of a number as it is, or the level of a choice at a place."""
        return self.levels[int(number)] if self.is_choice else float(number)

    @property
    def range_text(self) -> str:
        """Its range or its choices in words."""
        if self.is_choice:
            return " or ".join(map(str, self.levels))
        low, high = self.bounds
        return f"{self.shown(low)} to {self.shown(high)}"

    def spaced(self, count: int | None = None) -> tuple[Value, ...]:
        """Return its levels, or so many equally spaced values of its range."""
        if self.levels and count is None:
            return self.levels
        if self.is_choice:
            return self.levels
        if count is not None and not 1 <= count <= most_designs():
            raise TurgorError(f"levels of '{self.name}' is {count}; allowed is 1 to {most_designs()}.")
        values = np.linspace(*self.bounds, count or RUNS.range_levels)
        return tuple(dict.fromkeys(round(float(each)) for each in values)) if self.whole else tuple(values.tolist())

    def shown(self, value: Value) -> str:
        """Return a value as text with its unit."""
        if isinstance(value, str):
            return value
        return f"{value / unit_value(self.unit):.5g} {self.unit}".strip()


def inputs_of(factors: Sequence[Factor], values: Sequence[dict[str, Value]]) -> Array:
    """Return the numbers of rows, (n, k) [SI]; a choice is NaN."""
    return np.array(
        [[np.nan if isinstance(row[each.name], str) else float(row[each.name]) for each in factors] for row in values],
        dtype=np.float64,
    ).reshape(len(values), len(factors))
