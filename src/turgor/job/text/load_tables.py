"""Load tables: what stands below ``[loads]`` in a job file."""

from collections.abc import Mapping
from functools import partial
from typing import Annotated, Any

from pydantic import AfterValidator, BeforeValidator, Field

from turgor.core.geometry.directions import DIRECTIONS
from turgor.core.model.loads import STANDARD_GRAVITY
from turgor.foundation.errors import TurgorError, unknown
from turgor.job.text.quantities import Acceleration, Coordinate, Pressure, Says, Table, shown
from turgor.units import parse_quantity


def _direction(text: str) -> str:
    if text not in DIRECTIONS:
        raise unknown("direction", text, DIRECTIONS)
    return text


def _history(value: object) -> object:
    """Points or an expression of a history; `turgor.core.model.loads` checks them."""
    if not isinstance(value, str | list):
        raise TurgorError(f"{shown(value)} is not a list in square brackets, nor an expression in quotes.")
    return value


Points = Annotated[
    Any, BeforeValidator(_history), Says("list of points or expression in quotes", "[[0, 0], [0.5, 1], [1, 0]]")
]


class GravityTable(Table):
    """``[loads.gravity]``: weight, where more than its direction is stated.

    Keys
    ----
    direction : str
        Direction in which things fall: ``"-z"``, ``"+x"`` and the like.
    acceleration : float [m/s²]
        Acceleration of gravity.
    history : list or str, optional
        Share of the weight over the load factor: points [load factor, share] with straight lines between them,
        or an expression in t. By default it rises with the load factor.
    history_over_time : list or str, optional
        The same over time in seconds, where the procedure has a duration.
    """

    direction: Annotated[str, AfterValidator(_direction), Says("direction", '"-z"')]
    acceleration: Acceleration = STANDARD_GRAVITY
    history: Points = None
    history_over_time: Points = None


def _gravity(value: object) -> object:
    """A direction, or a table with one."""
    if isinstance(value, str):
        return GravityTable(direction=_direction(value))
    if isinstance(value, Mapping):
        return dict(value)
    raise TurgorError(f"{shown(value)} is neither a direction such as '-z' nor a table with one.")


def _forces(value: object) -> tuple[float, float, float]:
    if not isinstance(value, list) or len(value) != 3:
        raise TurgorError(f"{shown(value)} is not three forces along x, y and z, such as [0, 0, '-0.5 N'].")
    x, y, z = (0.0 if part == 0 and not isinstance(part, bool) else parse_quantity(part, "force") for part in value)
    return x, y, z


Forces = Annotated[Any, BeforeValidator(_forces), Says("three forces", '[0, 0, "-0.5 N"]', "force")]
Mass = Annotated[float, BeforeValidator(partial(parse_quantity, dimension="mass")), Field(gt=0)]


def _line(value: object) -> tuple[float, float, float]:
    if not isinstance(value, list) or len(value) != 3:
        raise TurgorError(f"{shown(value)} is not three forces per length along x, y and z, such as [0, 0, '-2 N/m'].")
    x, y, z = (
        0.0 if part == 0 and not isinstance(part, bool) else parse_quantity(part, "force per length") for part in value
    )
    return x, y, z


LineForces = Annotated[
    Any, BeforeValidator(_line), Says("three forces per length", '[0, 0, "-2 N/m"]', "force per length")
]


class PointForceTable(Table):
    """``[[loads.point_forces]]``: a force at a point of the surface, fixed in direction.

    Keys
    ----
    at : (3,) floats [m]
        Where it acts at rest.
    force : (3,) floats [N]
        Force at this point; the mirror image of the point carries the mirror image of the force.
    history : list or str, optional
        Share of the force over the load factor: points [load factor, share] with straight lines between them, or an
        expression in s. By default it rises with the load factor.
    history_over_time : list or str, optional
        The same over time in seconds, where the procedure has a duration.
    """

    at: list[Coordinate] = Field(min_length=3, max_length=3, examples=['["20 mm", 0, "15 mm"]'])
    force: Annotated[Any, BeforeValidator(_forces), Says("three forces", '[0, 0, "-0.5 N"]', "force")]
    history: Points = None
    history_over_time: Points = None


class LineForceTable(Table):
    """``[[loads.line_forces]]``: a force per length along the edge between two faces, fixed in direction.

    Keys
    ----
    faces : list of two str
        Faces that meet along the line.
    force_per_length : (3,) floats [N/m]
        Force per length at rest.
    history : list or str, optional
        Share of the force over the load factor: points [load factor, share] with straight lines between them, or an
        expression in s. By default it rises with the load factor.
    history_over_time : list or str, optional
        The same over time in seconds, where the procedure has a duration.
    """

    faces: list[str] = Field(min_length=2, max_length=2, examples=['["tip", "outside"]'])
    force_per_length: LineForces
    history: Points = None
    history_over_time: Points = None


class LoadsTable(Table):
    """``[loads]``: what drives the actuator.

    Keys
    ----
    pressure : float [Pa], gauge
        Gauge pressure in every cavity that has no table of its own.
    gravity : str or table
        Direction of the weight, such as ``"-z"``, or a table with more. Every material needs a density.
    point_forces : list of tables
        Forces at points of the surface.
    line_forces : list of tables
        Forces per length along edges.
    """

    pressure: Pressure | None = None
    point_forces: list[PointForceTable] = Field(
        default=[], examples=['[{ at = ["20 mm", 0, "15 mm"], force = [0, 0, "-0.5 N"] }]']
    )
    line_forces: list[LineForceTable] = Field(
        default=[], examples=['[{ faces = ["tip", "outside"], force_per_length = [0, 0, "-2 N/m"] }]']
    )
    gravity: Annotated[GravityTable, BeforeValidator(_gravity), Says("direction or table", '"-z"')] | None = None


class CavityTable(Table):
    """``[loads.cavity_1]``: pressure in one cavity or on another face, and its history. The name is that of the face.

    Keys
    ----
    pressure : float [Pa], gauge
        Gauge pressure that the history is a share of.
    history : list or str, optional
        Share of the pressure over the load factor: points [load factor, share] with straight lines between
        them, or an expression in t. By default it rises with the load factor.
    history_over_time : list or str, optional
        The same over time in seconds, where the procedure has a duration.
    """

    pressure: Pressure
    history: Points = None
    history_over_time: Points = None


class ForceTable(Table):
    """``[loads.FACE]``: a force on a face, or what hangs from it. The name is that of the face.

    Keys
    ----
    force : (3,) floats [N], optional
        Total force on the face of the whole actuator, spread over it and fixed in direction.
    hangs : float [kg], optional
        Mass whose weight pulls at the face in the direction of gravity, which is ``"-z"`` where none is stated.
    history : list or str, optional
        Share of the force over the load factor: points [load factor, share] with straight lines between them, or an
        expression in t. By default it rises with the load factor.
    history_over_time : list or str, optional
        The same over time in seconds, where the procedure has a duration.
    """

    force: Forces = None
    hangs: Mass | None = None
    history: Points = None
    history_over_time: Points = None
