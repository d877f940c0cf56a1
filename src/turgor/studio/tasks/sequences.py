"""Sequences: inputs of a reduced model over time, as a list of moves and waits and as a CSV file with the tip."""

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from turgor.core.results.files.response_csv import read_response
from turgor.foundation.errors import TurgorError
from turgor.foundation.response import COLUMN_UNITS
from turgor.reduced.history_table import history_table, input_columns
from turgor.reduced.states.reduced import Reduced
from turgor.studio.settings import LIVE

Array = NDArray[np.float64]

#: Share of a range within which two inputs, and of a second within which two times, are the same.
SAME = 1e-5


def write_sequence(model: Path, file: Path, knots: Any) -> dict[str, Any]:
    """Write time, inputs, tip, volumes and estimated error along a sequence, at its knots and between them.

    Parameters
    ----------
    model : Path
        Reduced model.
    file : Path
        CSV file to write.
    knots : list
        Times [s] with a list of inputs in order, in the units that the page shows.

    Raises
    ------
    TurgorError
        If a number is none, times fall, or an input is outside of the trained range.
    """
    reduced = Reduced.load(model)
    times, table = _knots(reduced, knots)
    count = max(2, int(np.ceil(times[-1] / LIVE.rows)) + 1)
    rows = np.unique(np.concatenate([times, np.linspace(0.0, times[-1], count)]).round(9))
    inputs = np.column_stack([np.interp(rows, times, column) for column in table.T])
    followed = reduced.follow(rows, dict(zip(reduced.inputs.keys, inputs.T, strict=True)))
    history_table(reduced, followed).to_csv(file)
    doubtful = sum(each.doubtful for each in followed.answers)
    return {"name": file.name, "rows": len(rows), "doubtful": doubtful}


def read_sequence(model: Path, file: Path) -> dict[str, Any]:
    """Read the inputs of a CSV file with times as a short list of moves and waits, and how often it is repeated.

    Raises
    ------
    TurgorError
        If the file lacks the time or an input, or an input is outside of the trained range.
    """
    reduced, table = Reduced.load(model), read_response(file)
    names = input_columns(reduced)
    missing = [name for name in ("time", *names) if name not in table.names]
    if missing:
        raise TurgorError(
            f"'{file.name}' has no column {' and no column '.join(missing)}; a sequence of this model has time_s and "
            f"{', '.join(names)} with their units."
        )
    inputs = np.column_stack([table[name] for name in names])
    times = _rising(np.asarray(table["time"], dtype=np.float64))
    for row in inputs:
        reduced.inputs.check(row)
    units = np.array([COLUMN_UNITS[unit] for unit in reduced.inputs.units])
    places = _corners(times, inputs / (reduced.inputs.high - reduced.inputs.low))
    shown = [[float(value) for value in inputs[place] / units] for place in places]
    ways = [(float(times[b] - times[a]), two) for a, b, two in zip(places, places[1:], shown[1:], strict=False)]
    length, repeats = _period(ways)
    return {
        "start": shown[0],
        "steps": [{"seconds": round(seconds, 9), "inputs": end} for seconds, end in ways[:length]],
        "repeats": repeats,
    }


def _knots(reduced: Reduced, knots: Any) -> tuple[Array, Array]:
    """Times (k,) and inputs (k, n) [SI]."""
    n = len(reduced.inputs.keys)
    try:
        times = np.array([each[0] for each in knots], dtype=np.float64)
        table = np.array([each[1] for each in knots], dtype=np.float64).reshape(len(times), n)
    except (TypeError, ValueError, IndexError) as error:
        raise TurgorError(f"a sequence is a list of times, each with {n} numbers.") from error
    if len(times) < 2 or not np.isfinite(table).all():
        raise TurgorError("a sequence needs two states at least; record or add a step.")
    table *= [COLUMN_UNITS[unit] for unit in reduced.inputs.units]
    for row in table:
        reduced.inputs.check(row)
    if not times[-1] <= LIVE.longest:
        raise TurgorError(f"the sequence takes {times[-1]:.4g} s; allowed are {LIVE.longest:g} s.")
    return _rising(times - times[0]), np.clip(table, reduced.inputs.low, reduced.inputs.high)


def _rising(times: Array) -> Array:
    if len(times) < 2 or not (np.isfinite(times).all() and (np.diff(times) > 0).all()):
        raise TurgorError("the times of a sequence must rise from row to row, and there must be two at least.")
    return times


def _corners(times: Array, shares: Array) -> list[int]:
    """Places where the way of the inputs changes, with the first and the last: all others follow from these."""
    places, last = [0], len(times) - 1
    end = 1
    while end < last:
        start = places[-1]
        inside = np.arange(start + 1, end + 1)
        part = (times[inside] - times[start]) / (times[end + 1] - times[start])
        line = shares[start] + part[:, None] * (shares[end + 1] - shares[start])
        if (np.abs(line - shares[inside]) > SAME).any():
            places.append(end)
        end += 1
    return [*places, last]


def _period(ways: list[tuple[float, list[float]]]) -> tuple[int, int]:
    """Shortest beginning of a list of moves of which the whole list is a repetition, and how often."""
    numbers = np.array([[seconds, *end] for seconds, end in ways])
    scale = np.abs(numbers).max(axis=0) + 1e-300
    for length in range(1, len(ways) // 2 + 1):
        if len(ways) % length:
            continue
        parts = numbers.reshape(-1, length, numbers.shape[1])
        if (np.abs(parts - parts[0]) <= 10 * SAME * scale).all():
            return length, len(parts)
    return len(ways), 1
