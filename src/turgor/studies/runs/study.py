"""Study: many responses over a design space, a row for each design."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from turgor.foundation.errors import TurgorError, unknown
from turgor.foundation.response import COLUMN_UNITS, MESH_ERROR, Response
from turgor.foundation.round_off import ROUND_OFF
from turgor.foundation.source import Source
from turgor.studies.runs.designs import design_table
from turgor.studies.runs.executors.run_outcome import Ended
from turgor.studies.runs.factor import Factor, Value, inputs_of
from turgor.studies.runs.files.tables import Cells, header, write_csv, write_parquet
from turgor.studies.runs.optional_parts import needed

Array = NDArray[np.float64]


#: Status of a row whose run gave no response.
FAILED = "failed"


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Row:
    """One design of a study, and how its run ended.

    Parameters
    ----------
    values : mapping of str to float, int or str [SI]
        Value of each factor.
    ended : Ended
        The run, with its response or the sentence that says why there is none.
    """

    values: Mapping[str, Value]
    ended: Ended

    @property
    def response(self) -> Response | None:
        """What was measured, as far as the path goes; None where the run failed."""
        return None if self.ended.result is None else self.ended.result.response

    @property
    def status(self) -> str:
        """How the solve ended (``"converged"``, ``"limit_point"`` …), ``"failed"`` where there is no response."""
        return FAILED if self.response is None else self.response.status

    @property
    def problem(self) -> str:
        """Why it failed or ended early, in a sentence; empty where it did not."""
        return self.ended.problem if self.response is None else self.response.message

    @property
    def seconds(self) -> float:
        """CPU time of the run [s]; 0 where it failed."""
        return 0.0 if self.ended.result is None else self.ended.result.seconds


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Study:
    """Many responses over a design space.

    Parameters
    ----------
    factors : tuple of Factor
        What varies.
    rows : tuple of Row
        A row for each design, in the order of the request.
    source : Source
        Where the numbers came from.

    Raises
    ------
    TurgorError
        If there is no factor, or two share a name.
    """

    factors: tuple[Factor, ...]
    rows: tuple[Row, ...]
    source: Source

    def __post_init__(self) -> None:
        names = [each.name for each in self.factors]
        if not names:
            raise TurgorError("a study needs a factor: something that varies.")
        twice = next((name for name in names if names.count(name) > 1), None)
        if twice is not None:
            raise TurgorError(f"the factor '{twice}' is given twice.")

    def __len__(self) -> int:
        """Count the rows."""
        return len(self.rows)

    @property
    def inputs(self) -> Array:
        """Values of the factors, (rows, factors) [SI]; a choice is NaN."""
        return inputs_of(self.factors, [dict(row.values) for row in self.rows])

    @property
    def measures(self) -> tuple[str, ...]:
        """Names of the columns that any response has, those of mesh errors left out."""
        names = [each.name for row in self.rows if row.response is not None for each in row.response.quantities]
        return tuple(dict.fromkeys(names))

    def factor(self, name: str) -> Factor:
        """Return a factor; an unknown name fails with the near match."""
        for each in self.factors:
            if each.name == name:
                return each
        raise unknown("factor", name, [each.name for each in self.factors])

    def unit(self, name: str) -> str:
        """Return the unit in which a measure is shown; an unknown name fails with the near match."""
        for row in self.rows:
            if row.response is not None and name in row.response:
                return row.response.find(name).unit
        if not self.measures:
            raise TurgorError(
                f"all {len(self)} runs failed; the first one: {self.rows[0].problem if self.rows else ''}"
            )
        raise unknown("measure of the study", name, self.measures)

    def column(self, name: str, at: tuple[str, float] | None = None) -> Array:
        """Return a measure of each row, (rows,) [SI].

        Parameters
        ----------
        name : str
            Name of the measure; an unknown one fails with the near match.
        at : (str, float), optional
            Column and value [SI] at which it is read between the states, such as ``("pressure", 50e3)``, on the part of
            the path where this column moves away from its first value; by default the last state.

        Returns
        -------
        (rows,) array
            NaN where the run failed, or its path does not reach the value.
        """
        self.unit(name)
        return np.array([read_at(row.response, name, at) for row in self.rows])

    def mesh_error(self, name: str, at: tuple[str, float] | None = None) -> Array:
        """Return the mesh error of a measure of each row, (rows,) [SI]; NaN where none was estimated."""
        self.unit(name)
        return np.array([read_at(row.response, name + MESH_ERROR, at) for row in self.rows])

    def table(self, measures: Sequence[str] = (), at: tuple[str, float] | None = None) -> dict[str, Cells]:
        """Return a table with a row for each design, whose headers have the units of their numbers.

        Parameters
        ----------
        measures : sequence of str
            Names of columns of the responses; all by default.
        at : (str, float), optional
            Column and value [SI] at which they are read, as for `column`; by default the last state.

        Returns
        -------
        dict of str to list
            Values of the factors; ``status``, ``problem`` and ``cpu_seconds``; then each measure, with its mesh error
            behind it where any row has one.
        """
        cells: dict[str, Cells] = {**design_table(self.factors, [row.values for row in self.rows])}
        cells["status"] = [row.status for row in self.rows]
        cells["problem"] = [row.problem for row in self.rows]
        cells["cpu_seconds"] = [row.seconds for row in self.rows]
        for name in measures or self.measures:
            unit = self.unit(name)
            cells[header(name, unit)] = (self.column(name, at) / COLUMN_UNITS[unit]).tolist()
            errors = self.mesh_error(name, at) / COLUMN_UNITS[unit]
            if np.isfinite(errors).any():
                cells[header(name + MESH_ERROR, unit)] = errors.tolist()
        return cells

    def to_csv(self, path: str | Path, measures: Sequence[str] = (), at: tuple[str, float] | None = None) -> None:
        """Write `table` as CSV; `turgor.studies.load_study` reads it."""
        write_csv(self.table(measures, at), path)

    def to_parquet(self, path: str | Path, measures: Sequence[str] = (), at: tuple[str, float] | None = None) -> None:
        """Write `table` as Parquet, which needs pyarrow."""
        write_parquet(self.table(measures, at), path)

    def to_dataframe(self, measures: Sequence[str] = (), at: tuple[str, float] | None = None) -> Any:
        """Return `table` as a pandas data frame, which needs pandas."""
        return needed("pandas", "to_dataframe").DataFrame(self.table(measures, at))

    @property
    def problems(self) -> tuple[str, ...]:
        """Rows that failed, and those whose path ended early, in sentences."""
        sentences = []
        for row in self.rows:
            if row.problem:
                ended = "failed" if row.response is None else "ended early"
                sentences.append(f"The run with {self.values_text(row.values)} {ended}: {row.problem}")
        return tuple(sentences)

    def values_text(self, values: Mapping[str, Value]) -> str:
        """Return values of the factors as text, with their units."""
        return values_text(self.factors, values)


def values_text(factors: Sequence[Factor], values: Mapping[str, Value]) -> str:
    """Return values of factors as text, with their units."""
    return ", ".join(f"{each.name} {each.shown(values[each.name])}" for each in factors)


def read_at(response: Response | None, name: str, at: tuple[str, float] | None) -> float:
    """Return a column of a response at the value of another one, or at the end; NaN where it is not known.

    Parameters
    ----------
    response : Response or None
    name : str
    at : (str, float) or None
        Another column and its value [SI].
    """
    if response is None or name not in response or not len(response):
        return float("nan")
    values = response.column(name)
    if at is None:
        return float(values[-1])
    place = place_on(response.column(at[0]), at[1])
    if place is None:
        return float("nan")
    first, share = place
    return float(values[first] + share * (values[first + 1] - values[first]) if share else values[first])


def place_on(drive: Array, value: float) -> tuple[int, float] | None:
    """Return where a drive has a value on its first way: a row, and the share of the way to the next one.

    Parameters
    ----------
    drive : (n,) array
    value : float

    Returns
    -------
    (int, float) or None
        The share is 0 at a row, but for its last digits; None where the drive does not reach the value.

    Examples
    --------
    >>> place_on(np.array([0.0, 10.0, 20.0, 15.0]), 15.0), place_on(np.array([0.0, 10.0]), 10.0 + 1e-12)
    ((1, 0.5), (1, 0.0))
    """
    if len(drive) > 1 and drive[1] < drive[0]:  # a vacuum
        drive, value = -drive, -value
    falls = np.flatnonzero(np.diff(drive) <= 0)
    way = drive[: int(falls[0]) + 1] if len(falls) else drive
    same = np.flatnonzero(np.isclose(way, value, rtol=ROUND_OFF.same, atol=0.0))
    if len(same):
        return int(same[0]), 0.0
    if not way[0] < value < way[-1]:
        return None
    first = int(np.searchsorted(way, value)) - 1
    return first, float((value - way[first]) / (way[first + 1] - way[first]))
