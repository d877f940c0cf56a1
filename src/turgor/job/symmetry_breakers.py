"""Keys of a job file that break the symmetry of a CAD part, for ``symmetry = "automatic"``.

A reason comes with the axes across which it forbids mirror planes, and those about which it forbids wedges.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any

from turgor.core.geometry.cad.cad_file import CadFile
from turgor.core.geometry.cad.symmetry.requested import AXES, RequestedSymmetry
from turgor.core.model.fibers import DISCRETE
from turgor.job.text.listed_loads import listed_kinds

#: Axes across which it breaks mirror planes, axes about which it breaks wedges, and the words for it.
Reason = tuple[str, str, str]

#: Keys of a procedure or setup that are a direction.
_DIRECTIONS = ("direction", "pull")

#: Keys that pick nodes by their place; an edge is that of two faces, each of which has an image.
_PLACES = ("near", "box", "node_set")


def with_broken_planes(actuator: Any, content: Mapping[str, Any]) -> Any:
    """Tell a CAD part which mirror planes and wedges its loads forbid.

    Parameters
    ----------
    actuator : Actuator or None
        Returned as it is, unless it is a `CadFile` whose symmetry is automatic.
    content : mapping
        Sections of the job file. What is malformed in them is passed over; their readers report it.
    """
    if not isinstance(actuator, CadFile) or not actuator.requested_symmetry.automatic:
        return actuator
    planes: dict[str, str] = {}
    turns: dict[str, str] = {}
    for across, about, reason in _reasons(content):
        for axis in across:
            planes.setdefault(axis, reason)
        for axis in about:
            turns.setdefault(axis, reason)
    return replace(actuator, symmetry=RequestedSymmetry(actuator.requested_symmetry.planes, planes, turns))


def _reasons(content: Mapping[str, Any]) -> Iterator[Reason]:
    """Broken mirror planes and turns, with the reason."""
    stages = content.get("stages")
    for stage in (content, *(stages if isinstance(stages, list) else ())):
        if isinstance(stage, Mapping):
            yield from _of_loads(_table(stage, "loads"))
            yield from _of_procedure(_table(stage, "procedure"))
            yield from _of_supports(_table(stage, "displacements"))
    yield from _of_supports(_table(content, "supports"))
    for name in _table(content, "points"):
        yield AXES, AXES, f"point '{name}' is not known to stay in the plane or on the axis"
    for name in _table(content, "obstacles"):
        yield AXES, AXES, f"obstacle '{name}' is not known to be the same on both sides"
    for name in _table(content, "fibers"):
        yield from _of_fibers(name, _table(_table(content, "fibers"), name))
    for name in _table(content, "bonds"):
        yield from _of_limits(
            f"the flaw of the bond '{name}'", _table(_table(_table(content, "bonds"), name), "unbonded")
        )


def _of_fibers(name: str, fibers: Mapping[str, Any]) -> Iterator[Reason]:
    if "through" in fibers:
        yield AXES, AXES, f"threads '{name}' run through points, which are not known to be the same on both sides"
        return
    hand = fibers.get("hand")
    if isinstance(hand, str) and hand.lower() in ("right", "left"):
        yield AXES, "", f"fibers on '{name}' wind in one hand"
    if fibers.get("form") == DISCRETE:
        yield "", AXES, f"single threads on '{name}' do not end as they begin"
    yield from _of_limits(f"the winding '{name}'", _table(fibers, "within"))


def _of_limits(what: str, limits: Mapping[str, Any]) -> Iterator[Reason]:
    """Break the mirror planes across the axes along which a box is limited, and the turns that move it."""
    for axis in AXES:
        if f"{axis}_from" in limits or f"{axis}_to" in limits:
            yield axis, AXES.replace(axis, ""), f"{what} has limits along {axis}"


def _along(axes: Sequence[str], reason: str) -> Iterator[Reason]:
    """Symmetry that a vector breaks: mirror planes across its components, and wedges about the other axes."""
    for axis in axes:
        yield axis, AXES.replace(axis, ""), reason.format(axis)


def _of_supports(supports: Mapping[str, Any]) -> Iterator[Reason]:
    for name, stated in supports.items():
        support = {"displacement": stated} if isinstance(stated, list) else stated  # the latter in stages
        if not isinstance(support, Mapping):
            continue
        moved, along = support.get("displacement"), support.get("directions")
        if isinstance(moved, list) and len(moved) == 3:
            going = [axis for axis, part in zip(AXES, moved, strict=True) if part]
            yield from _along(going, f"the face '{name}' is moved along {{}}")
        if "terms" in support:
            yield AXES, AXES, f"the equation '{name}' is not known to be the same on both sides"
        if isinstance(along, list) and len(along) == 3 and sum(map(bool, along)) > 1:
            axes = "".join(axis for axis, part in zip(AXES, along, strict=True) if part)
            yield axes, AXES, f"the support '{name}' acts along ({', '.join(map(str, along))})"
        yield from _of_place(f"the support '{name}'", support)


def _of_place(what: str, stated: Mapping[str, Any]) -> Iterator[Reason]:
    """Break everything where nodes are picked by a point or a box, which the other side need not have."""
    for key in _PLACES:
        if key in stated:
            yield AXES, AXES, f"{what} acts on nodes by {key}, which are not known to be the same on both sides"


def _of_loads(loads: Mapping[str, Any]) -> Iterator[Reason]:
    for key in listed_kinds():
        if loads.get(key):
            yield AXES, AXES, f"loads.{key} is not known to be the same on both sides"
    gravity = loads.get("gravity")
    down = gravity.get("direction") if isinstance(gravity, Mapping) else gravity
    if isinstance(down, str):
        yield from _along([axis for axis in AXES if axis in down], "gravity acts along {}")
    for name, load in loads.items():
        if not isinstance(load, Mapping) or name == "gravity":
            continue
        if "hangs" in load:
            along = down if isinstance(down, str) else "-z"
            yield from _along([axis for axis in AXES if axis in along], f"a weight on '{name}' acts along {{}}")
        for key in ("force", "traction"):
            vector = load.get(key)
            if isinstance(vector, list) and len(vector) == 3:
                acting = [axis for axis, part in zip(AXES, vector, strict=True) if part]
                yield from _along(acting, f"a {key} on '{name}' acts along {{}}")
        yield from _of_place(f"the load '{name}'", load)


def _of_procedure(procedure: Mapping[str, Any]) -> Iterator[Reason]:
    for key in _DIRECTIONS:
        value = procedure.get(key)
        if isinstance(value, str):
            yield from _along([axis for axis in AXES if axis in value], f"procedure.{key} is along {{}}")


def _table(content: Mapping[str, Any], key: str) -> Mapping[str, Any]:
    value = content.get(key)
    return value if isinstance(value, Mapping) else {}
