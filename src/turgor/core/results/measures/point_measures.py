"""Measures of reference points: displacement, rotation, and the reactions of their supports."""

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.points.motion import PointMotion
from turgor.core.model.model import Model
from turgor.core.results.fields.state_fields import StateFields
from turgor.core.results.measures.measure import Measure
from turgor.core.results.measures.rotations import twist
from turgor.foundation.errors import unknown

Array = NDArray[np.float64]

#: What can be read of a reference point along x, y and z: its unit, and its definition.
VECTORS: Mapping[str, tuple[str, str]] = {
    "displacement": ("mm", "displacement of the reference point {point} along {axis}"),
    "rotation": (
        "deg",
        "{axis} component of the rotation vector of the reference point {point}: its direction is the axis of the "
        "rotation from rest, its length the angle, up to half a turn",
    ),
    "twist": (
        "deg",
        "part of the rotation of the reference point {point} that turns about {axis} before the rest tilts this axis, "
        "continued past half a turn",
    ),
    "reaction": ("N", "{axis} component of the force of supports and springs on the reference point {point}, whole "
                 "actuator"),
    "reaction_moment": (
        "Nm",
        "{axis} component of the moment of supports and springs about the reference point {point}, whole actuator",
    ),
}  # fmt: skip


def of_point(point: str, what: str, axis: str) -> Measure:
    """Make a measure of a reference point.

    Parameters
    ----------
    point : str
        Name of the point.
    what : str
        ``"displacement"``, ``"rotation"`` (vector), ``"twist"``, ``"reaction"`` or ``"reaction_moment"``.
    axis : str
        ``"x"``, ``"y"`` or ``"z"``.

    Returns
    -------
    Measure

    Examples
    --------
    >>> of_point("plate", "rotation", "z").name
    'plate_rotation_z'
    """
    if what not in VECTORS:
        raise unknown("measure of a reference point", what, VECTORS)
    if axis not in ("x", "y", "z"):
        raise unknown("axis", axis, "xyz")
    unit, definition = VECTORS[what]
    return Measure(
        name=f"{point}_{what}_{axis}",
        unit=unit,
        function=lambda at: float(_read(at, point, what)["xyz".index(axis)]),
        definition=definition.format(point=point, axis=axis),
        unwrap=what == "twist",
    )


def point_measure(name: str) -> Measure | None:
    """Return the measure of a reference point of a name such as ``plate_rotation_z``; None if it is no such name.

    Examples
    --------
    >>> point_measure("plate_reaction_moment_x").unit
    'Nm'
    """
    head, _, axis = name.rpartition("_")
    for what in sorted(VECTORS, key=len, reverse=True):
        if axis in ("x", "y", "z") and head.endswith(f"_{what}"):
            return of_point(head.removesuffix(f"_{what}"), what, axis)
    return None


def point_measures_of(model: Model) -> tuple[Measure, ...]:
    """Return the measures that a response has by itself: motions of all points, reactions of those that are supported.

    Parameters
    ----------
    model : Model

    Returns
    -------
    tuple of Measure
    """
    chosen: list[Measure] = []
    for name, point in model.points.items():
        what = ["displacement", "rotation"]
        if any(point.stiffness) or any(support.prescribed[0] == name for support in model.supports):
            what.append("reaction")
        turned = any(support.turned_point == name for support in model.supports)
        if turned or point.rotational_spring:
            what.append("reaction_moment")
        chosen += [of_point(name, each, axis) for each in what for axis in "xyz"]
    return tuple(chosen)


def fixed_points_force(at: StateFields) -> Array:
    """Sum of the forces of supports on reference points that are `Fixed`, along these directions, (3,) [N]."""
    total = np.zeros(3)
    for support in at.model.supports:
        point, directions = support.prescribed
        if not support.moves and point in at.state.points:
            axes = ["xyz".index(letter) for letter in directions]
            total[axes] += at.state.points[point].force[axes]
    return total


def _read(at: StateFields, point: str, what: str) -> Array:
    if point not in at.model.points:
        raise unknown("reference point", point, at.model.points)
    motion: PointMotion | None = at.state.points.get(point)
    if motion is None:  # the undeformed state before the solve
        return np.zeros(3)
    match what:
        case "displacement":
            return motion.displacement
        case "rotation":
            from scipy.spatial.transform import Rotation as Turn  # slow to load, and few jobs ask for it

            return np.asarray(Turn.from_matrix(motion.rotation).as_rotvec())
        case "twist":
            return np.array([_twist(motion.rotation, axis) for axis in range(3)])
        case "reaction":
            return motion.force
        case _:
            return motion.moment


def _twist(rotation: Array, axis: int) -> float:
    """Twist about an axis, by that about x in a frame whose first axis it is."""
    order = np.roll(np.arange(3), -axis)
    return twist(rotation[np.ix_(order, order)])
