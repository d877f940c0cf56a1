"""Forces of a job file: on a face, or of what hangs from it; at points and along lines of the surface."""

from collections.abc import Mapping, Sequence
from functools import partial
from typing import Any, Protocol

from turgor.core.geometry.directions import DIRECTIONS
from turgor.core.geometry.geometry import Geometry
from turgor.core.model.history import RAMP, over_time
from turgor.core.model.loads import STANDARD_GRAVITY, Force, LineForce, Load, PointForce
from turgor.foundation.errors import TurgorError, unknown
from turgor.job.text.load_tables import ForceTable, GravityTable, LineForceTable, PointForceTable
from turgor.job.text.problems import Problems
from turgor.job.text.quantities import read_table
from turgor.units import format_quantity


class Timed(Protocol):
    """A table with a history."""

    @property
    def history(self) -> Any:
        """Over the load factor."""

    @property
    def history_over_time(self) -> Any:
        """Over the time."""


def is_force(name: str, value: object, cavities: tuple[str, ...]) -> bool:
    """Whether a table of ``[loads]`` states a force on a face."""
    return isinstance(value, Mapping) and name not in cavities and bool({"force", "hangs"} & set(value))


def on_faces(
    stated: Mapping[str, Any],
    geometry: Geometry | None,
    gravity: GravityTable | None,
    duration: float | None,
    problems: Problems,
) -> list[Force]:
    """Forces of tables such as ``[loads.tip]``."""
    found = []
    for name, values in stated.items():
        key = ("loads", name)
        if geometry is not None and name not in geometry.faces:
            problems.add(key, str(unknown("face", name, geometry.faces)))
            continue
        table = read_table(ForceTable, values, key, problems)
        if table is None:
            continue
        made = problems.attempt(
            key, partial(_force, name, table, gravity, duration), fields=("force", "hangs", "history")
        )
        if made is not None:
            found.append(made)
            _check_mirror(made, geometry, problems)
    return found


def _force(face: str, table: ForceTable, gravity: GravityTable | None, duration: float | None) -> Force:
    if (table.force is None) == (table.hangs is None):
        raise TurgorError("force: give either force, such as [0, 0, '-0.5 N'], or hangs, such as '50 g'.")
    vector = table.force
    if table.hangs is not None:
        weight = table.hangs * (STANDARD_GRAVITY if gravity is None else gravity.acceleration)
        x, y, z = (weight * part for part in DIRECTIONS["-z" if gravity is None else gravity.direction])
        vector = (x, y, z)
    return Force(face, vector, history_of(table, f"force on '{face}'", duration))


def _check_mirror(load: Force, geometry: Geometry | None, problems: Problems) -> None:
    for axis, part in zip("xyz", load.vector, strict=True):
        if geometry is not None and part and f"symmetry_{axis}" in geometry.faces:
            problems.add(
                ("loads", load.face),
                f"the force along {axis} points across the mirror plane of a half model; "
                "set actuator.symmetric = false.",
            )
        wedge = None if geometry is None else geometry.wedge
        if wedge is not None and part and axis != wedge.axis:
            problems.add(
                ("loads", load.face),
                f"the force along {axis} is not the same in all sectors of the wedge about {wedge.axis}; set "
                'actuator.symmetry = "none".',
            )


def history_of(table: Timed, what: str, duration: float | None) -> Any:
    """History of a table, over the load factor or, with a duration, over the time in seconds."""
    if table.history_over_time is None:
        return RAMP if table.history is None else table.history
    if table.history is not None:
        raise TurgorError(f"{what}: history and history_over_time are both given; one says it.")
    if duration is None:
        raise TurgorError(f"{what}: history_over_time needs a procedure with a duration; give history instead.")
    return over_time(table.history_over_time, duration)


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
        made = problems.attempt(("loads", "point_forces"), partial(_at_point, table, duration))
        found += [] if made is None else [made]
    for line in lines:
        key = ("loads", "line_forces")
        missing = [] if geometry is None else [name for name in line.faces if name not in geometry.faces]
        for name in missing:
            assert geometry is not None
            problems.add(key, str(unknown("face", name, geometry.faces)))
        if not missing:
            drawn = problems.attempt(key, partial(_along_line, line, duration))
            found += [] if drawn is None else [drawn]
    return found


def _at_point(table: PointForceTable, duration: float | None) -> PointForce:
    x, y, z = table.at
    return PointForce((x, y, z), table.force, history_of(table, "point force", duration))


def _along_line(table: LineForceTable, duration: float | None) -> LineForce:
    first, second = table.faces
    return LineForce((first, second), table.force_per_length, history_of(table, "line force", duration))


def concentrated_tables(loads: Sequence[Load]) -> dict[str, Any]:
    """Write them as keys of ``[loads]``."""
    points = [
        {
            "at": [format_quantity(value, "mm") for value in load.at],
            "force": [format_quantity(part, "N") for part in load.vector],
        }
        | _written(load)
        for load in loads
        if isinstance(load, PointForce)
    ]
    lines = [
        {"faces": list(load.faces), "force_per_length": [format_quantity(part, "N/m") for part in load.vector]}
        | _written(load)
        for load in loads
        if isinstance(load, LineForce)
    ]
    return ({"point_forces": points} if points else {}) | ({"line_forces": lines} if lines else {})


def _written(load: PointForce | LineForce) -> dict[str, Any]:
    if load.history == RAMP:
        return {}
    return {"history": load.history if isinstance(load.history, str) else [list(point) for point in load.history]}
