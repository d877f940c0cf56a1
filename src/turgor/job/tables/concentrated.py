"""Forces of a job file at points and along lines of the surface."""

from collections.abc import Sequence
from functools import partial
from typing import Any

from turgor.errors import unknown
from turgor.geometry import Geometry
from turgor.job.tables.forces import history_of
from turgor.job.text.problems import Problems
from turgor.job.text.quantities import LineForceTable, PointForceTable
from turgor.model.history import RAMP
from turgor.model.loads import LineForce, Load, PointForce
from turgor.units import format_quantity


def concentrated(
    points: Sequence[PointForceTable],
    lines: Sequence[LineForceTable],
    geometry: Geometry | None,
    duration: float | None,
    problems: Problems,
) -> list[PointForce | LineForce]:
    """Forces of ``[[loads.point_forces]]`` and ``[[loads.line_forces]]``."""
    found: list[PointForce | LineForce] = []
    for table in points:
        made = problems.attempt(("loads", "point_forces"), partial(_point, table, duration))
        found += [] if made is None else [made]
    for line in lines:
        key = ("loads", "line_forces")
        missing = [] if geometry is None else [name for name in line.faces if name not in geometry.faces]
        for name in missing:
            assert geometry is not None
            problems.add(key, str(unknown("face", name, geometry.faces)))
        if not missing:
            drawn = problems.attempt(key, partial(_line, line, duration))
            found += [] if drawn is None else [drawn]
    return found


def _point(table: PointForceTable, duration: float | None) -> PointForce:
    x, y, z = table.at
    return PointForce((x, y, z), table.force, history_of(table, "point force", duration))


def _line(table: LineForceTable, duration: float | None) -> LineForce:
    first, second = table.faces
    return LineForce((first, second), table.force_per_length, history_of(table, "line force", duration))


def concentrated_tables(loads: Sequence[Load]) -> dict[str, Any]:
    """Write them as keys of ``[loads]``."""
    points = [
        {
            "at": [format_quantity(value, "mm") for value in load.at],
            "force": [format_quantity(part, "N") for part in load.vector],
        }
        | _history(load)
        for load in loads
        if isinstance(load, PointForce)
    ]
    lines = [
        {"faces": list(load.faces), "force_per_length": [format_quantity(part, "N/m") for part in load.vector]}
        | _history(load)
        for load in loads
        if isinstance(load, LineForce)
    ]
    return ({"point_forces": points} if points else {}) | ({"line_forces": lines} if lines else {})


def _history(load: PointForce | LineForce) -> dict[str, Any]:
    if load.history == RAMP:
        return {}
    return {"history": load.history if isinstance(load.history, str) else [list(point) for point in load.history]}
