"""Load tables: what stands below ``[loads]`` in a job file."""

from collections.abc import Mapping
from functools import partial
from typing import Annotated, Any

from pydantic import AfterValidator, BeforeValidator, Field

from turgor.core.geometry.directions import DIRECTIONS
from turgor.core.model.loads import STANDARD_GRAVITY
from turgor.foundation.errors import TurgorError, unknown
from turgor.job.text.load_values import Points, says_three, three
from turgor.job.text.place_table import PlaceTable
from turgor.job.text.quantities import Acceleration, Pressure, Says, Table, shown
from turgor.units import parse_quantity


def _direction(text: str) -> str:
    if text not in DIRECTIONS:
        raise unknown("direction", text, DIRECTIONS)
    return text


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
        or an expression in t, or "constant" from the start. By default it rises with the load factor.
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


_FORCES = '[0, 0, "-0.5 N"]'
Forces = Annotated[Any, three("force", _FORCES), says_three("force", _FORCES)]
_TRACTION = '[0, 0, "2 kPa"]'
Tractions = Annotated[Any, three("pressure", _TRACTION), says_three("pressure", _TRACTION)]
Mass = Annotated[float, BeforeValidator(partial(parse_quantity, dimension="mass")), Field(gt=0)]


class LoadsTable(Table):
    """``[loads]``: what drives the actuator.

    Keys
    ----
    pressure : float [Pa], gauge
        Gauge pressure in every cavity that has no table of its own.
    gravity : str or table
        Direction of the weight, such as ``"-z"``, or a table with more. Every material needs a density.
    """

    pressure: Pressure | None = None
    gravity: Annotated[GravityTable, BeforeValidator(_gravity), Says("direction or table", '"-z"')] | None = None


class CavityTable(Table):
    """``[loads.cavity_1]``: pressure in one cavity or on another face, and its history. The name is that of the face.

    Keys
    ----
    pressure : float [Pa], gauge
        Gauge pressure that the history is a share of.
    history : list or str, optional
        Share of the pressure over the load factor: points [load factor, share] with straight lines between
        them, or an expression in t, or "constant" from the start. By default it rises with the load factor.
    history_over_time : list or str, optional
        The same over time in seconds, where the procedure has a duration.
    """

    pressure: Pressure
    history: Points = None
    history_over_time: Points = None


class ForceTable(PlaceTable):
    """``[loads.NAME]``: a force on a face, an edge, a node or a box, or what hangs from there.

    One of ``edge``, ``near``, ``box`` and ``node_set`` says where the nodes are, and NAME is any name. Without them it
    is that of a face or of a node set.

    Keys
    ----
    force : (3,) floats [N], optional
        Total force on the whole actuator, spread over the face, or over the nodes, and fixed in direction.
    traction : (3,) floats [Pa], optional
        Force per area at rest on a face, fixed in direction.
    hangs : float [kg], optional
        Mass whose weight pulls there in the direction of gravity, which is ``"-z"`` where none is stated.
    history : list or str, optional
        Share of the force over the load factor: points [load factor, share] with straight lines between them, or an
        expression in t, or "constant" from the start. By default it rises with the load factor.
    history_over_time : list or str, optional
        The same over time in seconds, where the procedure has a duration.
    """

    force: Forces = None
    traction: Tractions = None
    hangs: Mass | None = None
    history: Points = None
    history_over_time: Points = None
