"""Comparison of two responses: what was computed against what was measured, or any two others."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.accuracy.laboratory.headers import spelled_column
from turgor.accuracy.laboratory.loops import Loop, computed_at, loop_of
from turgor.accuracy.laboratory.rest import Rest, rest_of
from turgor.accuracy.laboratory.runs import SPREAD, branches, interpolated
from turgor.accuracy.laboratory.settings import LABORATORY
from turgor.core.results.drive import drive_of
from turgor.core.results.error_text import NOT_SHOWN
from turgor.core.results.measures.headlines import headlines
from turgor.foundation.errors import TurgorError, unknown
from turgor.foundation.given import one
from turgor.foundation.response import MESH_ERROR, Column, Response
from turgor.foundation.source import Source

Array = NDArray[np.float64]

#: The second response, unless it is that of another run.
MEASURED = "measured"

#: A shift of the drive must leave this share of the measured rows within the computed range.
LEAST_OVERLAP = 0.7
#: Stands for the difference where a shift leaves fewer rows; a number, because the search subtracts it.
FAR = 1e30
#: Shifts that are tried before the best one is refined.
TRIED = 201


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Comparison:
    """Two responses side by side; every difference is computed minus measured, at the measured values of the drive.

    Parameters
    ----------
    computed, measured : Response
        What is compared.
    x, y : str
        Columns of the computed response: what drives, and what is compared.
    measured_x, measured_y : str
        The columns of the measured response that they are compared with.
    rows : (n, 3) array [SI]
        Drive, measured value and computed value, in the measured order, without rows beyond the computed range.
    rms : float [SI]
        Root of the mean square of the differences.
    largest : float [SI]
        Difference of the largest amount, with its sign.
    largest_at : float [SI]
        Value of the drive at which it occurs.
    relative : float [-]
        ``rms`` over the range of the measured values.
    shift : float [SI]
        What is added to the measured drive so that the curves lie closest; nan where there is no such shift.
    rms_shifted : float [SI]
        ``rms`` with this shift.
    loop : Loop or None
        Loading and unloading apart; None where the measured drive does not turn.
    offset : float [SI]
        Measured minus computed value at rest, at the beginning; nan where the record does not begin there.
    drift : float [SI]
        Measured value at rest at the end minus that at the beginning; nan where the drive does not come back.
    other : str
        Word for the second response in sentences and pictures.
    notes : tuple of str
        What was left out or assumed.
    """

    computed: Response
    measured: Response
    x: str
    y: str
    measured_x: str
    measured_y: str
    rows: Array
    rms: float
    largest: float
    largest_at: float
    relative: float
    shift: float
    rms_shifted: float
    loop: Loop | None = None
    offset: float = np.nan
    drift: float = np.nan
    other: str = MEASURED
    notes: tuple[str, ...] = ()

    def __repr__(self) -> str:
        return f"Comparison({self.summary()})"

    def summary(self) -> str:
        """Return what came out, in one sentence with units."""
        x, y = self.computed.find(self.x), self.computed.find(self.y)
        rows = f"{len(self.rows)} {'measured rows' if self.other == MEASURED else 'rows'}"
        text = (
            f"{_words(self.y)} differs by {_in(y, self.rms)} (RMS, {self.relative:.1%} of the {self.other} range), "
            f"at most by {_in(y, self.largest, signed=True)} at {_in(x, self.largest_at)}, over {rows}"
        )
        if np.isfinite(self.shift) and self.rms_shifted < 0.9 * self.rms:
            text += (
                f"; with {_in(x, self.shift, signed=True)} added to the {self.other} {_words(self.x)} it is "
                f"{_in(y, self.rms_shifted)}"
            )
        return text + "."

    def to_response(self) -> Response:
        """Return the compared rows as a response: drive, measured, computed, difference."""
        x, y = self.computed.find(self.x), self.computed.find(self.y)
        drive, measured, computed = self.rows.T
        columns = (
            Column(self.x, x.unit, drive),
            Column(f"{self.y}_measured", y.unit, measured),
            Column(f"{self.y}_computed", y.unit, computed),
            Column(f"{self.y}_difference", y.unit, computed - measured),
        )
        return Response(columns=columns, source=Source(text=f"{self.computed.source} against {self.measured.source}"))


def compare(computed: Response, measured: Response, y: str | None = None, *, x: str | None = None) -> Comparison:
    """Compare two responses, such as a run and an experiment.

    The computed curve is interpolated at the measured values of the drive. Where it turns, such as after a snap, its
    part before the first turn is compared.

    Parameters
    ----------
    computed, measured : Response
        Any two, of `turgor.measure`, `turgor.experiments.read_experiment` or a formula.
    y : str, optional
        What is compared: a column of ``computed``, or ``"computed name=measured name"`` where they have different ones.
        By default what both have, or what has the same kind of unit in both.
    x : str, optional
        What drives, in the same manner; by default the drive that both have.

    Returns
    -------
    Comparison

    Raises
    ------
    TurgorError
        If there is no such column, units of two kinds meet, or the curves share no range of the drive.

    Examples
    --------
    >>> def made(top, text):
    ...     columns = Column("pressure", "kPa", [0, 10e3, 20e3]), Column("bending_angle", "deg", [0, top / 2, top])
    ...     return Response(columns=columns, source=Source(text=text))
    >>> found = compare(made(1.0, "a run"), made(0.9, "a test"))
    >>> round(found.largest, 6), found.largest_at, round(found.relative, 4)
    (0.1, 20000.0, 0.0717)
    """
    for what, each in (("computed", computed), ("measured", measured)):
        one(each, Response, what, "a Response is needed, as measure(solution) or read_experiment(file) returns it")
    ours, theirs = _columns(computed, measured, x, driving=True)
    name, other = _columns(computed, measured, y, driving=False, besides=(ours, theirs))
    notes = _named_differently(ours, theirs) + _named_differently(name, other)
    curve, turned = first_branch(computed, ours)
    drive, values = measured.column(theirs), measured.column(other)
    known = np.isfinite(drive) & np.isfinite(values)
    drive, values = drive[known], values[known]
    interpolated(curve, ours, name, drive)  # two rows are needed
    at, unloaded = computed_at(computed.column(ours), computed.column(name), drive)
    notes += () if unloaded else turned
    within = np.isfinite(at)
    if within.sum() < 2:
        span, theirs_span = computed.find(ours).span, measured.find(theirs).span
        raise TurgorError(f"the curves share no range of '{ours}': computed {span}, measured {theirs_span}.")
    if not within.all():
        notes += (f"{(~within).sum()} of {len(within)} measured rows lie beyond the computed range and are left out.",)
    rows = np.column_stack([drive, values, at])[within]
    away = rows[:, 2] - rows[:, 1]
    worst = int(np.argmax(np.abs(away)))
    shift, shifted = best_shift(curve, ours, name, np.column_stack([drive, values]))
    rms, reach = _rms(away), float(np.ptp(rows[:, 1]))
    rest = rest_of(measured, theirs, other)
    offset = np.nan if rest is None else rest.start - float(interpolated(curve, ours, name, np.array([rest.drive]))[0])
    loop, drift = loop_of(rows[:, 0], rows[:, 1], away), np.nan if rest is None else rest.drift
    notes += _of_measurement((computed.find(ours), computed.find(name)), reach, loop, rest, offset)
    return Comparison(
        computed=computed, measured=measured, x=ours, y=name, measured_x=theirs, measured_y=other, rows=rows, rms=rms,
        largest=float(away[worst]), largest_at=float(rows[worst, 0]), relative=rms / reach if reach else np.inf,
        shift=shift, rms_shifted=shifted, loop=loop, offset=offset, drift=drift, notes=notes,
    )  # fmt: skip


def _of_measurement(
    columns: tuple[Column, Column], reach: float, loop: Loop | None, rest: Rest | None, offset: float
) -> tuple[str, ...]:
    """Sentences on loading and unloading, offset and drift of a measurement, where they are more than its noise."""
    (x, y), notes, least = columns, [], LABORATORY.shown * reach
    if loop is not None:
        notes.append(
            f"Loading differs by {_in(y, loop.loading)} (RMS), unloading by {_in(y, loop.unloading)}; measured "
            f"values are {_in(y, loop.width, signed=True)} in unloading, on average."
        )
    if rest is not None and abs(offset) > least:
        notes.append(
            f"At {_in(x, rest.drive)}, the lowest {_words(x.name)}, the measured value is "
            f"{_in(y, offset, signed=True)} from the computed one at the beginning."
        )
    if rest is not None and abs(rest.drift) > least:
        notes.append(f"It drifts by {_in(y, rest.drift, signed=True)} until it is there again.")
    return tuple(notes)


def best_shift(computed: Response, x: str, y: str, measured: Array) -> tuple[float, float]:
    """Find what to add to a measured drive so that the curves lie closest.

    Parameters
    ----------
    computed : Response
        With a drive that does not turn.
    x, y : str
        Its columns.
    measured : (n, 2) array [SI]
        Drive and value.

    Returns
    -------
    shift, rms : float [SI]
        The shift, and the root of the mean square of what remains; both nan where none leaves enough rows within the
        computed range.
    """

    def distance(shift: float) -> float:
        at = interpolated(computed, x, y, measured[:, 0] + shift)
        within = np.isfinite(at)
        if within.mean() < LEAST_OVERLAP:
            return FAR
        return _rms((at - measured[:, 1])[within])

    from scipy.optimize import minimize_scalar  # slow to load, and every run loads this file

    reach = float(np.ptp(measured[:, 0])) / 2
    tried = np.linspace(-reach, reach, TRIED)
    differences = np.array([distance(shift) for shift in tried])
    if (differences >= FAR).all():
        return np.nan, np.nan
    best = int(np.argmin(differences))
    step = tried[1] - tried[0]
    finer = minimize_scalar(distance, bounds=(tried[best] - step, tried[best] + step), method="bounded")
    if finer.fun < differences[best]:
        return float(finer.x), float(finer.fun)
    return float(tried[best]), float(differences[best])


def first_branch(response: Response, x: str) -> tuple[Response, tuple[str, ...]]:
    """Return the part of a path before its drive turns, and what to say about it.

    Parameters
    ----------
    response : Response
    x : str
        What drives.

    Returns
    -------
    part : Response
    notes : tuple of str
        Empty where the drive does not turn.
    """
    turns = branches(response.column(x))
    if len(turns) <= 1:
        return response, ()
    first, last = turns[0]
    part = tuple(Column(c.name, c.unit, c.values[first : last + 1]) for c in response.columns)
    at = _in(response.find(x), float(response.column(x)[last]))
    note = f"The computed {_words(x)} turns at {at}; what follows is not compared."
    return Response(columns=part, source=response.source), (note,)


def _columns(
    computed: Response, measured: Response, requested: str | None, *, driving: bool, besides: tuple[str, str] = ("", "")
) -> tuple[str, str]:
    """Names of the column of each response that are compared with each other."""
    if requested is not None:
        ours, _, theirs = (part.strip() for part in requested.partition("="))
        theirs = spelled_column(theirs, measured.names)
        return _of_one_kind(computed, ours, measured, theirs or _same(computed, ours, measured, besides[1]))
    if driving:
        drives = (drive_of(computed), drive_of(measured), "pressure", "time")
        shared = [name for name in drives if name in computed and name in measured]
        ours = shared[0] if shared else drive_of(computed)
        return _of_one_kind(computed, ours, measured, _same(computed, ours, measured, ""))
    common = [name for name in _values(computed, besides[0]) if name in _values(measured, besides[1])]
    changing = [name for name in common if _changes(computed, name) or _changes(measured, name)]
    chosen = next(iter([*headlines(changing), *changing, *common]), None)
    if chosen is not None:
        return chosen, chosen
    pairs = [
        (ours, theirs)
        for theirs in _values(measured, besides[1])
        for ours in headlines(_values(computed, besides[0])) or _values(computed, besides[0])
        if measured.find(theirs).unit and measured.find(theirs).si_unit == computed.find(ours).si_unit
    ]
    if not pairs:
        raise TurgorError(
            f"nothing to compare: computed {', '.join(_values(computed, besides[0]))}; measured "
            f"{', '.join(_values(measured, besides[1]))}.",
            python="Give y as 'computed name=measured name'.",
            command="Say --y 'computed name=measured name'.",
        )
    return pairs[0]


def _changes(response: Response, name: str) -> bool:
    """Whether a column is more than round-off: not zero throughout in its unit."""
    return bool((np.abs(response.find(name).in_unit) > NOT_SHOWN).any())


def _same(computed: Response, ours: str, measured: Response, besides: str) -> str:
    """The measured column of a name; else the only one with units of its kind."""
    if ours in measured:
        return ours
    kind = computed.find(ours).si_unit
    fitting = [name for name in _values(measured, besides) if measured.find(name).si_unit == kind]
    if len(fitting) != 1:
        raise unknown(f"column of {measured.source}", ours, measured.names)
    return fitting[0]


def _of_one_kind(computed: Response, ours: str, measured: Response, theirs: str) -> tuple[str, str]:
    first, second = computed.find(ours), measured.find(theirs)
    if first.si_unit != second.si_unit:
        raise TurgorError(f"'{ours}' is in {first.unit or 'no unit'} and '{theirs}' in {second.unit or 'no unit'}.")
    return ours, theirs


def _values(response: Response, drive: str) -> list[str]:
    """Names of what was measured, without the drive, mesh errors and spreads."""
    ends = (MESH_ERROR, SPREAD)
    return [name for name in response.names if name not in (drive, "load_factor", "time") and not name.endswith(ends)]


def _named_differently(ours: str, theirs: str) -> tuple[str, ...]:
    if ours == theirs:
        return ()
    return (f"The measured '{theirs}' is compared with '{ours}': make sure that both are defined alike.",)


def _rms(values: Array) -> float:
    return float(np.sqrt(np.mean(values**2)))


def _words(name: str) -> str:
    return name.replace("_", " ")


def _in(column: Column, value: float, *, signed: bool = False) -> str:
    """A value in the unit of a column."""
    number = Column(column.name, column.unit, np.array([value])).in_unit[0]
    return f"{number:{'+' if signed else ''}.3g} {column.unit}".rstrip()
