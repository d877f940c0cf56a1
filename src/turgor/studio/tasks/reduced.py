"""Reduced: a reduced model that a page moves: its description, states at inputs, and inputs for a place of the tip."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import lru_cache
from pathlib import Path
from time import perf_counter
from typing import Any

import numpy as np
from numpy.typing import NDArray

from turgor.core.results.error_text import with_error
from turgor.foundation.errors import NotSolved, TurgorError
from turgor.foundation.response import COLUMN_UNITS
from turgor.reduced.measures import readings
from turgor.reduced.states.answer import ReducedState
from turgor.reduced.states.reduced import Reduced
from turgor.studio.settings import LIVE
from turgor.studio.tasks.live_scene import live_scene, tip_at_rest, tip_plane
from turgor.systems.control.limits import Limits
from turgor.systems.control.outputs import Angle, OutputOf, Tip
from turgor.systems.control.search import Request, Search
from turgor.systems.control.settings import CONTROL
from turgor.systems.control.track import other_starts

Array = NDArray[np.float64]


@dataclass(slots=True, eq=False)
class Opened:
    """A reduced model and the last state, from which the next one begins.

    Parameters
    ----------
    reduced : Reduced
    tip, angle : OutputOf or None
        None without a face ``tip``.
    last : ReducedState or None
    """

    reduced: Reduced
    tip: OutputOf | None
    angle: OutputOf | None
    last: ReducedState | None = field(default=None)


@lru_cache(maxsize=2)  # the model that is shown, and the one before it
def opened(file: Path, changed: float) -> Opened:
    """Read a reduced model; a file that has changed is read again."""
    reduced = Reduced.load(file)
    has_tip = tip_at_rest(reduced) is not None
    return Opened(reduced, Tip().of(reduced) if has_tip else None, Angle().of(reduced) if has_tip else None)


def _of(file: Path) -> Opened:
    return opened(file, file.stat().st_mtime)


def described(file: Path) -> tuple[dict[str, Any], bytes]:
    """Return what the page gets once: a table, and float32 numbers of surface, obstacles and frames."""
    reduced, scene = _of(file).reduced, live_scene(_of(file).reduced)
    tip, plane = tip_at_rest(reduced), tip_plane(reduced)
    table = {
        "name": file.name,
        "title": reduced.model.mesh.name,
        "inputs": [_input(reduced, place) for place in range(len(reduced.inputs.keys))],
        "scene": scene.values,
        "shapes": [list(each.shape) for each in (scene.surface, scene.obstacles, scene.frames)],
        "tip": None if tip is None else tip.tolist(),
        "plane": None if plane is None or tip is None else plane.tolist(),
        "length": float(np.ptp(reduced.model.mesh.points, axis=0).max()),
        "trained": _trained(reduced),
        "measured": list(reduced.measures.names),
    }
    return table, b"".join(each.tobytes() for each in (scene.surface, scene.obstacles, scene.frames))


def _input(reduced: Reduced, place: int) -> dict[str, Any]:
    box = reduced.inputs
    key, unit = box.keys[place], box.units[place]
    low, high = float(box.low[place]), float(box.high[place])
    factor = COLUMN_UNITS[unit]
    rest = (low + high) / 2 if box.places[place] else min(max(0.0, low), high)
    return {
        "key": key, "unit": unit or _si_unit(key), "factor": factor, "low": low / factor, "high": high / factor,
        "rest": rest / factor, "free": "pressure" in key,
    }  # fmt: skip


def _si_unit(key: str) -> str:
    """Unit of an input that is shown in SI."""
    return "m/s²" if "gravity" in key else "N" if "vector" in key or "force" in key else ""


def _trained(reduced: Reduced) -> str:
    """Sentence on the training and its known error."""
    count, worst = len(reduced.held_out.inputs), reduced.held_out.worst
    if not count or not np.isfinite(worst):
        return "The error at states that training has not seen is unknown."
    return (
        f"At {count} states that training has not seen, displacements were within {100 * worst:.2g} % of the largest."
    )


def at_inputs(file: Path, values: Mapping[str, float]) -> dict[str, Any]:
    """Return the state at inputs by their keys, in the units that the page shows.

    Raises
    ------
    TurgorError
        If an input lies outside of the trained range, or there is no equilibrium.
    """
    one, began = _of(file), perf_counter()
    vector = one.reduced.inputs.vector(_in_si(one.reduced, values))
    one.last = _state(one, vector)
    return _answer(one, one.last, began)


def at_tip(
    file: Path, wanted: Sequence[float], values: Mapping[str, float], free: Sequence[str], settle: bool
) -> dict[str, Any]:
    """Return the state whose tip is nearest to a place, with the inputs that may change.

    Parameters
    ----------
    file : Path
    wanted : (3,) sequence [m]
        Displacement of the tip from rest.
    values : mapping of str to float
        Inputs now, in the units that the page shows.
    free : sequence of str
        Keys of the inputs that may change.
    settle : bool
        Whether to search until nothing is nearer, also from other states; else a few updates.
    """
    one, began = _of(file), perf_counter()
    box = one.reduced.inputs
    if one.tip is None:
        raise TurgorError("this model has no face 'tip' that could be dragged.")
    target = np.asarray(wanted, dtype=np.float64)
    if target.shape != (3,) or not np.isfinite(target).all():
        raise TurgorError(f"a place of the tip is three finite numbers, not {list(wanted)[:5]}.")
    now = box.vector(_in_si(one.reduced, values))
    fixed = {key: float(now[place]) for place, key in enumerate(box.keys) if key not in free}
    if len(fixed) == len(box.keys):
        raise TurgorError("no input may change; mark one as moved with the tip.")
    limits = Limits(low=fixed, high=fixed).of(one.reduced)
    search = Search(one.reduced, one.tip, limits, iterations=CONTROL.iterations if settle else LIVE.updates)
    request = Request(target, limits.low, limits.high, now)
    state = search.nearest(_state(one, now), request)
    if settle and search.error(state, target) > CONTROL.stalled * one.tip.size:
        state = search.best(state, other_starts(search, target, limits.low, limits.high), request)
    one.last = state
    reached = limits.active(state, None, 0.0, CONTROL.near)
    distance = float(np.linalg.norm(one.tip.at(state)[0] - target))
    return _answer(one, state, began) | {"distance": distance, "limits": list(reached)}


def read_off(file: Path, values: Mapping[str, float]) -> list[tuple[str, str]]:
    """Return words and texts of all measures at inputs, with the errors of mesh and reduction."""
    one = _of(file)
    state = _state(one, one.reduced.inputs.vector(_in_si(one.reduced, values)))
    return [(each.words, each.text) for each in readings(state)]


def _state(one: Opened, vector: Array) -> ReducedState:
    """Equilibrium at inputs, from the last state if there is one."""
    if one.last is not None and (one.last.inputs == vector).all():
        return one.last
    try:
        return one.reduced.at(vector, one.last)
    except NotSolved:
        return one.reduced.at(vector)


def _in_si(reduced: Reduced, values: Mapping[str, float]) -> dict[str, float]:
    box, out = reduced.inputs, {}
    for key, value in values.items():
        if isinstance(value, bool) or not isinstance(value, int | float) or not np.isfinite(value):
            raise TurgorError(f"the input '{str(key)[:80]}' is {str(value)[:40]}; a number is needed.")
        out[key] = float(value) * COLUMN_UNITS[box.units[box.place(key)]]
    return out


def _answer(one: Opened, state: ReducedState, began: float) -> dict[str, Any]:
    box = one.reduced.inputs
    shown = [float(value) / COLUMN_UNITS[unit] for value, unit in zip(state.inputs, box.units, strict=True)]
    return {
        "inputs": dict(zip(box.keys, shown, strict=True)),
        "q": state.q.tolist(),
        "tip": state.tip.tolist(),
        "estimate": state.estimate,
        "doubtful": bool(state.doubtful),
        "rows": _rows(one, state),
        "seconds": perf_counter() - began,
    }


def _rows(one: Opened, state: ReducedState) -> list[tuple[str, str]]:
    """Words and texts of what costs no time to read off: bending angle, tip, volumes, contact forces."""
    rows, known = [], one.reduced.measures
    if one.angle is not None and "bending_angle" in known.names:
        near = known.nearest(state.inputs, one.reduced.inputs.high - one.reduced.inputs.low)
        error = float(known.mesh[near, known.names.index("bending_angle")])
        rows.append(("bending angle", with_error(float(one.angle.at(state)[0][0]), error, "deg")))
    if one.tip is not None:
        rows.append(("tip moved by", f"({', '.join(f'{1e3 * x + 0.0:.3f}' for x in state.tip.round(6))}) mm"))
    rows += [(f"volume of {face}", f"{1e6 * volume:.4g} mL") for face, volume in state.volumes.items()]
    for name, force in state.obstacle_forces.items():
        size = float(np.linalg.norm(force))
        rows.append((f"force on {name}", f"{size:.3g} N" if size > 0 else "no contact"))
    return rows
