"""Reading: numbers of a row of a study by the name of a column or a factor, or by a function, and in words."""

from collections.abc import Callable
from dataclasses import dataclass
from math import isfinite
from typing import TypeAlias

from turgor.foundation.errors import TurgorError, unknown
from turgor.foundation.response import COLUMN_UNITS, MESH_ERROR, Response, unit_text
from turgor.foundation.source import Source
from turgor.studies.runs.factor import Factor
from turgor.studies.runs.study import Row, Study
from turgor.units import unit_value

Measure: TypeAlias = str | Callable[[Response], float]
At: TypeAlias = tuple[str, float] | None


@dataclass(frozen=True, slots=True, kw_only=True)
class Read:
    """What a goal reads from a row.

    Parameters
    ----------
    name : str
        What was read, in words.
    value : float [SI]
        NaN where the path does not reach it.
    unit : str
        Unit in which it is shown.
    request : str
        What was requested, in words.
    mesh_error : float [SI]
        NaN where none was estimated.
    """

    name: str
    value: float
    unit: str
    request: str
    mesh_error: float = float("nan")

    @classmethod
    def of(cls, row: Row, measure: Measure, at: At, unit: str, request: str) -> "Read":
        """Read a measure with its mesh error."""
        error = float("nan")
        if isinstance(measure, str) and row.response is not None and f"{measure}{MESH_ERROR}" in row.response:
            error = _in_row(row, f"{measure}{MESH_ERROR}", at)
        place = "" if at is None else f" at {at[0].replace('_', ' ')} {_place_text(row, at)}"
        name = f"{words_of(measure)}{place}"
        return cls(name=name, value=read(row, measure, at), unit=unit, request=request, mesh_error=error)

    @property
    def short(self) -> str:
        """The value with its unit."""
        return shown_of(self.value, self.unit) if isfinite(self.value) else "not reached"

    def __str__(self) -> str:
        if not isfinite(self.value):
            return f"{self.name}: not reached ({self.request})"
        error = f" ± {shown_of(self.mesh_error, self.unit, 2)} (mesh)" if isfinite(self.mesh_error) else ""
        return f"{self.name}: {shown_of(self.value, self.unit)}{error} ({self.request})"


def read(row: Row, measure: Measure, at: At = None) -> float:
    """Return a number of a row [SI].

    Parameters
    ----------
    row : Row
    measure : str or callable
        Column of the response, a factor, or a function of the response.
    at : (str, float), optional
        Column and value [SI] at which a column is read; by default the last state.

    Returns
    -------
    float
        NaN where the run failed, or its path does not reach the value.

    Raises
    ------
    TurgorError
        If the response has no such column, or the function gives no number.
    """
    if isinstance(measure, str) and measure in row.values:
        value = row.values[measure]
        if isinstance(value, str):
            raise TurgorError(f"'{measure}' is a choice; a goal needs a number.")
        return float(value)
    if row.response is None:
        return float("nan")
    if not isinstance(measure, str):
        reading = measure(row.response)
        try:
            return float(reading)
        except (TypeError, ValueError):
            raise TurgorError(f"{words_of(measure)} returned {reading!r}; it must return a number.") from None
    known = [each.name for each in row.response.quantities]
    for name in (measure, at[0] if at is not None else measure):
        if name not in row.response:
            raise unknown("measure", name, [*known, *row.values])
    return _in_row(row, measure, at)


def words_of(measure: Measure) -> str:
    """Return the name of a measure in words.

    Examples
    --------
    >>> words_of("bending_angle")
    'bending angle'
    """
    name = measure if isinstance(measure, str) else getattr(measure, "__name__", "objective")
    return "own objective" if name == "<lambda>" else name.replace("_", " ")


def unit_of(row: Row, measure: Measure) -> str:
    """Return the unit of a column; empty if there is no such column."""
    if isinstance(measure, str) and row.response is not None and measure in row.response:
        return row.response.find(measure).unit
    return ""


def shown_of(value: float, unit: str, digits: int = 4) -> str:
    """Return a value with its unit.

    Examples
    --------
    >>> shown_of(0.0123, "mm")
    '12.3 mm'
    """
    factor = COLUMN_UNITS.get(unit, unit_value(unit))
    sign = unit_text(unit)
    return f"{value / factor:.{digits}g}{'' if sign == '°' else ' '}{sign}".strip()


def _in_row(row: Row, name: str, at: At) -> float:
    """Read a column as a study does."""
    study = Study(factors=(Factor(name="row", levels=(0.0,)),), rows=(row,), source=Source(text="a row"))
    return float(study.column(name, at)[0])


def _place_text(row: Row, at: tuple[str, float]) -> str:
    return shown_of(at[1], unit_of(row, at[0]))
