"""track: inputs of a reduced model that make it follow a path."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from time import process_time

import numpy as np
from numpy.typing import NDArray

from turgor.foundation.display import Shown
from turgor.foundation.errors import NotSolved, TurgorError
from turgor.foundation.response import COLUMN_UNITS, Column, Response
from turgor.foundation.source import Source
from turgor.reduced.states.answer import ReducedState
from turgor.reduced.states.reduced import Reduced
from turgor.systems.control.forces import continued
from turgor.systems.control.limits import Limits
from turgor.systems.control.outputs import Output, OutputOf, Tip, trained_states
from turgor.systems.control.search import Request, Search
from turgor.systems.control.settings import CONTROL

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class Track(Shown):
    """Inputs that make an actuator follow a path, and what it reaches.

    Parameters
    ----------
    output : OutputOf
        What follows the path.
    times : (k,) array [s]
    target, reached : (k, m) arrays [SI]
        Wanted and reached output.
    states : tuple of ReducedState
        Equilibrium of each row.
    active : tuple of tuples of str
        Limits that each row has reached, such as ``"loads.pressure high"``.
    seconds : (k,) array [s]
        Processor time of the search of each row.
    """

    output: OutputOf
    times: Array
    target: Array
    reached: Array
    states: tuple[ReducedState, ...]
    active: tuple[tuple[str, ...], ...]
    seconds: Array

    @property
    def inputs(self) -> Array:
        """Inputs (k, n) [SI]."""
        return np.array([state.inputs for state in self.states])

    @property
    def distance(self) -> Array:
        """Distance (k,) [SI] between the wanted and the reached output: the root of the sum of squares."""
        return np.asarray(np.linalg.norm(self.reached - self.target, axis=1))

    def __repr__(self) -> str:
        worst = self.distance.max() / COLUMN_UNITS[self.output.unit]
        limited = sum(map(bool, self.active))
        return f"Track({len(self.times)} rows, largest distance {worst:.3g} {self.output.unit}, {limited} at a limit)"

    def response(self) -> Response:
        """Return times, inputs, wanted and reached output as columns, which `Response.to_csv` writes."""
        box, unit = self.states[0].reduced.inputs, self.output.unit
        columns = [Column("time", "s", self.times)]
        columns += [
            Column(_short(key, box.keys), box.units[place], self.inputs[:, place]) for place, key in enumerate(box.keys)
        ]
        for place, name in enumerate(self.output.names):
            columns += [
                Column(f"{name}_wanted", unit, self.target[:, place]),
                Column(name, unit, self.reached[:, place]),
            ]
        columns.append(Column("distance", unit, self.distance))
        return Response(columns=tuple(columns), source=Source(text="a reduced model that follows a path"))


def _short(key: str, keys: Sequence[str]) -> str:
    """End of a key that no other key has, as a name of a column."""
    parts = key.split(".")
    for count in range(2 if parts[-1].isdigit() else 1, len(parts) + 1):
        end = ".".join(parts[-count:])
        if sum(other == end or other.endswith(f".{end}") for other in keys) == 1:
            return end.replace(".", "_")
    return key


def track(
    reduced: Reduced,
    path: Array,
    *,
    times: Sequence[float] | Array | None = None,
    output: Output | None = None,
    limits: Limits | None = None,
    smoothness: float = CONTROL.smoothness,
) -> Track:
    """Find inputs, such as pressures, that make an actuator follow a path.

    Each row minimizes ``‖y − y*‖² + μ ‖p − p_before‖²`` under the limits, with exact derivatives of the output y by
    the inputs p. A target that is out of reach gives the closest point, its distance and the limits that it has
    reached.

    Parameters
    ----------
    reduced : Reduced
    path : (k, m) array [SI]
        Wanted output of each row: displacements of the tip (k, 3), or what ``output`` names.
    times : (k,) array [s], optional
        Time of each row, rising; needed for rates. The first row has no rate: the actuator is brought there before.
    output : Output, optional
        `Tip` (the default), `Points`, `Shape`, `Angle` or `ContactForce`.
    limits : Limits, optional
    smoothness : float, optional
        Weight μ, inputs over their ranges and outputs over the length of the actuator.

    Returns
    -------
    Track

    Raises
    ------
    TurgorError
        If the path has another number of columns than the output, a number that is not finite, or no row.
    NotSolved
        If the reduced model has no equilibrium on the way.
    """
    limits = limits or Limits()
    of, bounds = (output or Tip()).of(reduced), limits.of(reduced)
    if not 0 < smoothness < 1:
        raise TurgorError(f"smoothness is {smoothness:g}; allowed is more than 0 and less than 1.")
    target = checked_path(path, of)
    clock = _checked_times(times, len(target), bool(np.isfinite(bounds.rate).any()))
    search = Search(reduced, of, bounds, smoothness)
    states: list[ReducedState] = []
    active, seconds, before, reached_before = [], [], None, True
    for place, row in enumerate(target):
        passed, began = float(clock[place] - clock[place - 1]) if place else 0.0, process_time()
        low, high = bounds.after(before, passed)
        start = states[-1] if states else next(other_starts(search, row, low, high), None)
        start = start or reduced.at(np.clip(0.0, low, high))
        request = Request(row, low, high, start.inputs)
        state = search.nearest(start, request)
        far = (high - low > CONTROL.longest * bounds.widths).any()
        if far and reached_before and search.error(state, row) > CONTROL.stalled * of.size:
            state = search.best(state, other_starts(search, row, low, high), request)
        reached_before = search.error(state, row) <= CONTROL.stalled * of.size
        seconds.append(process_time() - began)
        active.append(bounds.active(state, before, passed, CONTROL.near))
        states.append(state)
        before = state.inputs
    reached = np.array([of.at(state)[0] for state in states])
    return Track(of, clock, target, reached, tuple(states), tuple(active), np.array(seconds))


def other_starts(search: Search, target: Array, low: Array, high: Array) -> Iterator[ReducedState]:
    """Equilibria at the inputs of the training states that are nearest to a target, within limits."""
    reduced = search.reduced
    away = [np.linalg.norm(continued(search.output, state)[0] - target) for state in trained_states(reduced)]
    for place in np.argsort(away, kind="stable")[: CONTROL.starts].tolist():
        try:
            yield reduced.at(np.clip(reduced.trained_inputs[place, 1:], low, high))
        except NotSolved:
            continue


def checked_path(path: Array, output: OutputOf) -> Array:
    """Return a path as an array (k, m), or say what is wrong with it."""
    rows = np.asarray(path, dtype=np.float64)
    m = len(output.names)
    rows = rows[:, None] if rows.ndim == 1 and m == 1 else rows
    if rows.ndim != 2 or rows.shape[1] != m or not len(rows):
        raise TurgorError(
            f"the path has the shape {rows.shape}; needed is (rows, {m}), a row for each time with "
            f"{', '.join(output.names)}."
        )
    for place in np.flatnonzero(~np.isfinite(rows).all(axis=1)).tolist():
        raise TurgorError(f"row {place + 1} of the path has a number that is not finite: {rows[place]}.")
    return rows


def _checked_times(times: Sequence[float] | Array | None, count: int, needed: bool) -> Array:
    if times is None:
        if needed:
            raise TurgorError("a limit of the rate needs the time of each row; give times.")
        return np.arange(count, dtype=np.float64)
    clock = np.asarray(times, dtype=np.float64)
    if clock.shape != (count,):
        raise TurgorError(f"there are {clock.size} times for {count} rows of the path; each row needs one.")
    for place in np.flatnonzero(~(np.diff(clock) > 0)).tolist():
        raise TurgorError(
            f"the time of row {place + 2} is {clock[place + 1]:g} s after {clock[place]:g} s; times must rise."
        )
    return clock
