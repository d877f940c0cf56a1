"""What a job file says that breaks the symmetry of a CAD part, for ``symmetry = "automatic"``."""

from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import Any

from turgor.geometry.cad.cad_file import CadFile
from turgor.geometry.cad.symmetry.wanted import WantedSymmetry

#: Keys of a procedure or setup that hold a direction.
_DIRECTIONS = ("direction", "pull")


def with_broken_planes(actuator: Any, content: Mapping[str, Any]) -> Any:
    """Tell a CAD part which mirror planes its loads forbid.

    Parameters
    ----------
    actuator : Actuator or None
        Returned as it is, unless it is a `CadFile` whose symmetry is automatic.
    content : mapping
        Sections of the job file. What is malformed in them is passed over; their readers report it.
    """
    if not isinstance(actuator, CadFile) or not actuator.wanted_symmetry.automatic:
        return actuator
    broken: dict[str, str] = {}
    for axis, reason in _reasons(content):
        broken.setdefault(axis, reason)
    return replace(actuator, symmetry=WantedSymmetry(actuator.wanted_symmetry.planes, broken))


def _reasons(content: Mapping[str, Any]) -> Iterator[tuple[str, str]]:
    """Axes across which no plane may be used, with the reason."""
    stages = content.get("stages")
    for stage in (content, *(stages if isinstance(stages, list) else ())):
        if isinstance(stage, Mapping):
            yield from _of_loads(_table(stage, "loads"))
            yield from _of_procedure(_table(stage, "procedure"))
    for name in _table(content, "points"):
        yield from ((axis, f"point '{name}' is not known to stay in the plane") for axis in "xyz")
    for name in _table(content, "obstacles"):
        yield from ((axis, f"obstacle '{name}' is not known to be the same on both sides") for axis in "xyz")
    for name, fibers in _table(content, "fibers").items():
        hand = fibers.get("hand") if isinstance(fibers, Mapping) else None
        if isinstance(hand, str) and hand.lower() in ("right", "left"):
            yield from ((axis, f"fibers on '{name}' wind in one hand") for axis in "xyz")


def _of_loads(loads: Mapping[str, Any]) -> Iterator[tuple[str, str]]:
    for key, where in (("point_forces", "at a point"), ("line_forces", "along an edge")):
        if loads.get(key):
            yield from ((axis, f"a force acts {where}") for axis in "xyz")
    gravity = loads.get("gravity")
    down = gravity.get("direction") if isinstance(gravity, Mapping) else gravity
    if isinstance(down, str):
        yield from ((axis, f"gravity acts along {axis}") for axis in "xyz" if axis in down)
    for name, load in loads.items():
        if not isinstance(load, Mapping) or name == "gravity":
            continue
        if "hangs" in load:
            along = down if isinstance(down, str) else "-z"
            yield from ((axis, f"a weight on '{name}' acts along {axis}") for axis in "xyz" if axis in along)
        force = load.get("force")
        if isinstance(force, list) and len(force) == 3:
            yield from (
                (axis, f"a force on '{name}' acts along {axis}")
                for axis, part in zip("xyz", force, strict=True)
                if part
            )


def _of_procedure(procedure: Mapping[str, Any]) -> Iterator[tuple[str, str]]:
    for key in _DIRECTIONS:
        value = procedure.get(key)
        if isinstance(value, str):
            yield from ((axis, f"procedure.{key} is along {axis}") for axis in "xyz" if axis in value)


def _table(content: Mapping[str, Any], key: str) -> Mapping[str, Any]:
    value = content.get(key)
    return value if isinstance(value, Mapping) else {}
