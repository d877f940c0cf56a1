"""Reference points of a job file: what ties, holds, moves and loads each of them."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import partial
from typing import Annotated, Any

from pydantic import BeforeValidator, Field

from turgor.core.geometry.geometry import Geometry
from turgor.core.model.history import RAMP
from turgor.core.model.loads import Force, Gravity, Hanging, Load, Moment
from turgor.core.model.points import RIGID, Hinge, ReferencePoint, Rotation
from turgor.core.model.supports import Displacement, Fixed, Shift, Support
from turgor.foundation.errors import TurgorError, unknown
from turgor.job.tables.obstacles import Direction, Lengths, SpringStiffness
from turgor.job.text.listed_loads import fits
from turgor.job.text.load_tables import Forces, Mass
from turgor.job.text.load_values import Points, history_of, history_values, says_three, three
from turgor.job.text.problems import Problems
from turgor.job.text.quantities import Angle, Says, Table, read_table, shown
from turgor.units import format_quantity, parse_quantity

#: Keys that drive an actuator by themselves.
DRIVING = frozenset({"force", "moment", "hangs", "displacement", "rotation"})


_MOMENT, _INERTIA = '[0, "20 N mm", 0]', '["2 kg mm²", "1 kg mm²", "1 kg mm²"]'
_SPRINGS = '["20 N/m", 0, 0]'
Moments = Annotated[Any, three("moment", _MOMENT), says_three("moment", _MOMENT)]
Inertia = Annotated[Any, three("inertia", _INERTIA), Says("three moments of inertia", _INERTIA, "inertia")]
Springs = Annotated[Any, three("spring stiffness", _SPRINGS), says_three("spring stiffness", _SPRINGS)]
Turning = Annotated[float, BeforeValidator(partial(parse_quantity, dimension="rotational stiffness"))]


class PointTable(Table):
    """``[points.NAME]``: a point tied to a face, on which a rig acts. The name is that of the point.

    Keys
    ----
    face : str
        The face that is tied to the point.
    spring : float [N/m], optional
        Stiffness of a spring between the point and its place at rest, in all directions, or a list of three along x, y
        and z.
    rotational_spring : float [N m/rad], optional
        Moment per angle of a spring that turns the point back.
    force : (3,) floats [N], optional
        Force on the point, of the whole actuator.
    moment : (3,) floats [N m], optional
        Moment on the point, of the whole actuator.
    follower : bool
        Whether force and moment turn with the point; they are fixed in space otherwise.
    hangs : float [kg], optional
        Mass that hangs from the point: its weight pulls in the direction of gravity, ``"-z"`` where none is stated.
    prescribed : str
        Directions in which the point is fixed, or moved by its displacement: some of x, y and z.
    displacement : (3,) floats [m], optional
        How far the point is moved at the end along these directions.
    rotation : float [rad], optional
        Angle by which the point is turned at the end; 0 keeps it from turning.
    axis : direction
        Axis of this rotation.
    tilts : bool
        Whether the rotation leaves the point free to tilt: then only its twist about the axis is prescribed.
    hinge : direction, optional
        Axis about which alone the point may turn: x, y, z or three numbers.
    history : list or str, optional
        Share of force, moment, weight, displacement and rotation over the load factor: points [load factor, share] with
        straight lines between them, or an expression in s. By default it rises with the load factor.
    history_over_time : list or str, optional
        The same over time in seconds, where the procedure has a duration.
    """

    face: str = Field(examples=['"tip"'])
    at: Lengths | None = None
    coupling: str = RIGID
    mass: Mass | None = None
    center: Lengths | None = None
    inertia: Inertia = None
    spring: SpringStiffness | Springs | None = None
    rotational_spring: Turning | None = None
    force: Forces = None
    moment: Moments = None
    follower: bool = False
    hangs: Mass | None = None
    prescribed: str = Field(default="", examples=['"yz"'])
    displacement: Lengths | None = None
    rotation: Angle | None = None
    axis: Direction = (1.0, 0.0, 0.0)
    tilts: bool = False
    hinge: Direction | None = None
    history: Points = None
    history_over_time: Points = None


@dataclass(frozen=True, slots=True, kw_only=True)
class Rig:
    """A reference point of a job, with what holds it and acts on it.

    Parameters
    ----------
    point : ReferencePoint
    holds : tuple of Fixed, Displacement, Rotation or Hinge
    loads : tuple of Force, Moment or Hanging
    """

    point: ReferencePoint
    holds: tuple[Support, ...] = ()
    loads: tuple[Load, ...] = ()


def read_points(
    values: Any, geometry: Geometry | None, loads: tuple[Load, ...], duration: float | None, problems: Problems
) -> dict[str, Rig]:
    """Read ``[points]``, a table for each reference point.

    Parameters
    ----------
    values : object
    geometry : Geometry or None
    loads : tuple of Load
        The other loads, which say where gravity pulls.
    duration : float or None [s]
    problems : Problems

    Returns
    -------
    dict of str to Rig
    """
    if not isinstance(values, Mapping):
        problems.add(("points",), f"{shown(values)} is not a table; write [points.plate] and its keys below it.")
        return {}
    gravity = next((load for load in loads if isinstance(load, Gravity)), Gravity())
    rigs = {}
    for name, entry in values.items():
        key = ("points", name)
        table = read_table(PointTable, entry, key, problems)
        if table is None:
            continue
        if geometry is not None and name in geometry.faces:
            problems.add(key, f"a face is called '{name}' too; give the point another name.")
            continue
        if geometry is not None and table.face not in geometry.faces:
            problems.add((*key, "face"), str(unknown("face", table.face, geometry.faces)))
            continue
        motions = "prescribed", "displacement", "rotation", "hinge", "axis"
        fields = ("coupling", "inertia", *motions, "history")
        rig = problems.attempt(key, partial(_rig, name, table, gravity, duration), fields=fields)
        if rig is not None:
            rigs[name] = rig
            for load in rig.loads:
                fits(load, geometry, key, problems, points=[name])
    return rigs


def _rig(name: str, table: PointTable, gravity: Gravity, duration: float | None) -> Rig:
    history = history_of(table, f"reference point '{name}'", duration)
    point = ReferencePoint(
        name, table.face, table.at, table.coupling, table.mass or 0.0, table.center, table.inertia or (0.0, 0.0, 0.0),
        table.spring or 0.0, table.rotational_spring or 0.0,
    )  # fmt: skip
    loads: list[Load] = []
    if table.force is not None:
        loads.append(Force(name, table.force, history, table.follower))
    if table.moment is not None:
        loads.append(Moment(name, table.moment, history, table.follower))
    if table.hangs is not None:
        loads.append(Hanging(name, table.hangs, gravity.direction, gravity.acceleration, history))
    return Rig(point=point, holds=_holds(name, table, history), loads=tuple(loads))


def _holds(name: str, table: PointTable, history: Any) -> tuple[Support, ...]:
    holds: list[Support] = []
    directions = table.prescribed
    if not set(directions) <= set("xyz"):
        raise TurgorError(f"prescribed is '{directions}'; allowed are the letters x, y and z.")
    if table.displacement is not None:
        if not directions:
            raise TurgorError("displacement: name its directions with prescribed, such as prescribed = 'z'.")
        holds.append(Displacement(name, Shift(table.displacement, history), directions))
    elif directions:
        holds.append(Fixed(name, directions))
    if table.rotation is not None and table.hinge is not None:
        raise TurgorError("rotation and hinge are both given; one of them says how the point may turn.")
    if table.rotation is not None:
        holds.append(Rotation(name, table.rotation, table.axis, history, table.tilts))
    elif table.tilts:
        raise TurgorError("tilts: the point has no rotation; give one, or leave tilts out: a point may tilt anyway.")
    if table.hinge is not None:
        holds.append(Hinge(name, table.hinge))
    return tuple(holds)


def points_tables(rigs: Mapping[str, Rig]) -> dict[str, dict[str, Any]]:
    """Write reference points as the tables of a job file; `read_points` gives the same back.

    Parameters
    ----------
    rigs : mapping of str to Rig

    Returns
    -------
    dict
    """
    return {name: _point_values(rig.point) | _load_values(rig) | _support_values(rig) for name, rig in rigs.items()}


def _point_values(point: ReferencePoint) -> dict[str, Any]:
    values: dict[str, Any] = {"face": point.face, "coupling": point.coupling}
    for key in ("at", "center"):
        if getattr(point, key) is not None:
            values[key] = [format_quantity(part, "mm") for part in getattr(point, key)]
    if any(point.inertia):
        values["inertia"] = [format_quantity(part, "kg mm²") for part in point.inertia]
    for key, value, unit in (
        ("mass", point.mass, "g"),
        ("rotational_spring", point.rotational_spring, "N m/rad"),
    ):
        if value:
            values[key] = format_quantity(value, unit)
    if any(point.stiffness):
        along = [format_quantity(part, "N/m") for part in point.stiffness]
        values["spring"] = along[0] if len(set(along)) == 1 else along
    return values


def _load_values(rig: Rig) -> dict[str, Any]:
    values: dict[str, Any] = {}
    for load in rig.loads:
        match load:
            case Force(_, vector, _, follower):
                values |= {"force": [format_quantity(part, "N") for part in vector], "follower": follower}
            case Moment(_, vector, _, follower):
                values |= {"moment": [format_quantity(part, "N m") for part in vector], "follower": follower}
            case Hanging(_, mass):
                values["hangs"] = format_quantity(mass, "g")
    ways = [each.way for each in rig.holds if each.way is not None]
    histories = [*(load.history for load in rig.loads), *ways]
    return values | history_values(histories[0] if histories else RAMP)


def _support_values(rig: Rig) -> dict[str, Any]:
    values: dict[str, Any] = {}
    for each in rig.holds:
        match each:
            case Fixed(_, directions):
                values["prescribed"] = directions
            case Displacement(_, Shift(vector), directions):
                values["prescribed"] = directions
                values["displacement"] = [format_quantity(part, "mm") for part in vector]
            case Rotation(_, angle, axis, _, tilts):
                values |= {"rotation": format_quantity(angle, "deg"), "axis": list(axis)}
                values |= {"tilts": True} if tilts else {}
            case Hinge():
                values["hinge"] = list(each.direction)
    return values
