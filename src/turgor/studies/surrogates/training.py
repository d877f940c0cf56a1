"""Training: the numbers of a study that a surrogate is fitted to."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.core.results.error_text import NOT_SHOWN
from turgor.foundation.errors import TurgorError, unknown
from turgor.foundation.response import COLUMN_UNITS, Column, Response
from turgor.foundation.round_off import ROUND_OFF
from turgor.studies.runs.factor import Factor
from turgor.studies.runs.study import Row, Study
from turgor.studies.surrogates.coding import Coding, check_levels
from turgor.studies.surrogates.settings import SURROGATE

Array = NDArray[np.float64]
Whole = NDArray[np.int64]

#: Columns that no surrogate is fitted to unless they are named.
WITHOUT = ("load_factor", "time", "stage")


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Training:
    """Numbers that a surrogate is fitted to.

    Parameters
    ----------
    factors : tuple of Factor
        Inputs, the drive last where it is one.
    outputs : tuple of Column
        Measures with their values, (n,) [SI].
    inputs : (n, k) array [SI]
        Of a choice the place among its levels.
    noise : (n, m) array [SI]
        Mesh error of each value; 0 where none was estimated.
    row : (n,) array
        Row of the study that each point comes from; points of one row are held out together.
    notes : tuple of str
        What was left out.
    """

    factors: tuple[Factor, ...]
    outputs: tuple[Column, ...]
    inputs: Array
    noise: Array
    row: Whole
    notes: tuple[str, ...]

    @property
    def targets(self) -> Array:
        """Values of the measures, (n, m) [SI]."""
        return np.stack([each.values for each in self.outputs], axis=1)

    @property
    def shares(self) -> Array:
        """Inputs as a model takes them, (n, w)."""
        return Coding(factors=self.factors).inputs(self.inputs)


def training(
    study: Study,
    measures: Sequence[str] | None = None,
    *,
    at: tuple[str, float] | None = None,
    along: str = "",
    points: int = SURROGATE.points,
) -> Training:
    """Read the numbers of a study that a surrogate is fitted to.

    Parameters
    ----------
    study : Study
    measures : sequence of str, optional
        By default all but the drive and those that do not vary.
    at : (str, float), optional
        Column and value [SI] at which measures are read; by default the last state.
    along : str
        Column that becomes an input, such as ``"pressure"``.
    points : int
        Values of this column on each path.

    Returns
    -------
    Training

    Raises
    ------
    TurgorError
        If a choice has too many levels, a measure is unknown, or fewer than five rows can be used.
    """
    varied = tuple(each for each in study.factors if _moves(each))
    if not varied:
        fixed = ", ".join(each.name for each in study.factors)
        raise TurgorError(f"no factor of the study ({fixed}) varies; a surrogate needs one that does.")
    check_levels(varied)
    if at is not None and along:
        raise TurgorError(f"at is {at} and along is '{along}'; give one of them.")
    names = _names(study, measures, {along, at[0] if at else ""} | {each.name for each in varied})
    drive, values = ("", None) if at is None else at
    grid = _grid(study, along, points) if along else np.array([np.nan if values is None else values])
    lines_read, problems = [], []
    for number, row in enumerate(study.rows):
        lines = _read(row, names, along or drive, grid)
        problems += [] if len(lines) else [study.values_text(row.values)]
        lines_read += [(number, *line) for line in lines]
    rows = np.array([line[0] for line in lines_read], dtype=np.int64)
    used = len(set(rows.tolist()))
    if used < SURROGATE.rows:
        raise TurgorError(
            f"{used} of {len(study)} rows of the study give {', '.join(names)}{_where(study, at)}; a surrogate needs "
            f"{SURROGATE.rows} or more. {' '.join(study.problems[:1])}".strip()
        )
    table = np.array([line[1:] for line in lines_read], dtype=np.float64)
    inputs = np.array([[each.number(study.rows[number].values[each.name]) for each in varied] for number in rows])
    factors = (*varied, _drive(study, along, grid)) if along else varied
    return Training(
        factors=factors,
        outputs=tuple(Column(name, study.unit(name), table[:, 1 + n]) for n, name in enumerate(names)),
        inputs=np.column_stack([inputs, table[:, 0]]) if along else inputs,
        noise=np.nan_to_num(table[:, 1 + len(names) :]),
        row=rows,
        notes=_notes(problems, len(study), rows, len(grid)),
    )


def _moves(factor: Factor) -> bool:
    return len(factor.levels) > 1 if factor.is_choice else factor.bounds[0] < factor.bounds[1]


def _names(study: Study, measures: Sequence[str] | None, inputs: Iterable[str]) -> list[str]:
    """Names of measures that vary, or those that were requested."""
    if measures is not None:
        for name in measures:
            if name not in study.measures:
                raise unknown("measure of the study", name, study.measures)
        if not measures:
            raise TurgorError(f"measures is empty; the study has {', '.join(study.measures)}.")
        return list(dict.fromkeys(measures))
    return measures_that_vary(study, None, inputs)


def measures_that_vary(study: Study, at: tuple[str, float] | None = None, inputs: Iterable[str] = ()) -> list[str]:
    """Return the measures of a study except the drive and those that do not vary.

    Parameters
    ----------
    study : Study
    at : (str, float), optional
        Column at which measures are read, which is none of them.
    inputs : iterable of str
        Further names that are no measures.

    Returns
    -------
    list of str

    Raises
    ------
    TurgorError
        If there is none.
    """
    excluded = {*WITHOUT, *inputs, *((at[0],) if at else ())}
    names = [name for name in study.measures if name not in excluded and _varies(study, name)]
    if not names:
        given = ", ".join(study.measures)
        raise TurgorError(f"no measure of the study ({given}) varies; there is nothing to compare or to fit.")
    return names


def _varies(study: Study, name: str) -> bool:
    values = study.column(name)
    known = values[np.isfinite(values)]
    least = NOT_SHOWN * COLUMN_UNITS[study.unit(name)]  # forces at the supports of a free actuator are smaller
    return bool(len(known) and np.ptp(known) > ROUND_OFF.same * abs(known).max() and abs(known).max() > least)


def _grid(study: Study, along: str, points: int) -> Array:
    """Values of the drive at which paths are read."""
    study.unit(along)
    if points < 2:
        raise TurgorError(f"points is {points}; allowed is 2 or more.")
    rising = [_rising(row.response, along) for row in study.rows if row.response is not None and along in row.response]
    rising = [each for each in rising if len(each)]
    if not rising:
        raise TurgorError(f"no row of the study has a path along '{along}'.")
    low, high = min(float(each[0]) for each in rising), max(float(each[-1]) for each in rising)
    if not low < high:
        raise TurgorError(f"'{along}' is {low:g} in all rows; it cannot be an input.")
    return np.linspace(low, high, points)


def _rising(response: Response, name: str) -> Array:
    """Values of a column as far as it rises."""
    values = response.column(name)
    falls = np.flatnonzero(~(np.diff(values) > 0))
    return values[: int(falls[0]) + 1] if len(falls) else values


def _read(row: Row, names: Sequence[str], drive: str, grid: Array) -> list[list[float]]:
    """Drive, measures and mesh errors at the values of the drive that the path reaches."""
    response = row.response
    if response is None or not len(response) or not {*names, *([drive] if drive else [])} <= set(response.names):
        return []
    errors = [response.mesh_error(name) for name in names]
    columns = [response.column(name) for name in names]
    columns += [np.full(len(response), np.nan) if error is None else error for error in errors]
    if not drive:
        line = [np.nan, *(float(values[-1]) for values in columns)]
        return [line] if np.isfinite(line[1 : 1 + len(names)]).all() else []
    known = _rising(response, drive)
    inside = grid[(grid >= known[0]) & (grid <= known[-1] * (1 + 1e-9))]
    lines = [[float(at), *(float(np.interp(at, known, each[: len(known)])) for each in columns)] for at in inside]
    return [line for line in lines if np.isfinite(line[1 : 1 + len(names)]).all()]


def _drive(study: Study, along: str, grid: Array) -> Factor:
    return Factor(name=along, low=float(grid[0]), high=float(grid[-1]), unit=study.unit(along))


def _where(study: Study, at: tuple[str, float] | None) -> str:
    if at is None:
        return ""
    column = Column(at[0], study.unit(at[0]), np.array([at[1]]))
    return f" at {column.in_unit[0]:g} {column.unit}".rstrip()


def _notes(problems: Sequence[str], count: int, rows: Whole, points: int) -> tuple[str, ...]:
    notes = []
    if problems:
        which = f"{'; '.join(problems[:3])}{' …' if len(problems) > 3 else ''}"
        notes.append(f"{len(problems)} of {count} rows were left out, without a response there: {which}.")
    short = sum(int((rows == number).sum()) < points for number in set(rows.tolist()))
    if short:
        notes.append(f"{short} paths end before the others; the surrogate knows less there.")
    return tuple(notes)
