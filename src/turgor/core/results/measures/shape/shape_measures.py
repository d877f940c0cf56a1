"""Measures of the shape: curvature, bending plane, arc and helix of the center line, and ballooning."""

import numpy as np
from numpy.typing import NDArray

from turgor.core.results.fields.state_fields import StateFields
from turgor.core.results.measures.measure import Measure
from turgor.core.results.measures.shape.arcs import distance_from_arc
from turgor.core.results.measures.shape.center_line import center_line
from turgor.core.results.measures.shape.settings import SHAPE
from turgor.core.results.measures.shape.widths import width_ratios
from turgor.foundation.round_off import ROUND_OFF

Array = NDArray[np.float64]


def _mean(at: StateFields) -> tuple[Array, Array]:
    return at.once("mean screw", lambda: center_line(at).mean)


def _curvature(at: StateFields) -> float:
    turn, way = _mean(at)
    return float(np.linalg.norm(np.cross(turn, way)) / (way @ way))


def _bending_radius(at: StateFields) -> float:
    turn, way = _mean(at)
    bend = float(np.linalg.norm(np.cross(turn, way)))
    return float("nan") if bend < SHAPE.no_direction * np.linalg.norm(way) else float(way @ way) / bend


def _bending_plane(at: StateFields) -> float:
    turn, way = _mean(at)
    towards = np.cross(turn, way)
    if np.linalg.norm(towards) < SHAPE.no_direction * np.linalg.norm(way):
        return float("nan")
    towards = np.where(np.abs(towards) < ROUND_OFF.same * np.linalg.norm(towards), 0.0, towards)
    return float(np.arctan2(towards[1], 0.0 - towards[2]))


def _helix_radius(at: StateFields) -> float:
    turn, way = _mean(at)
    square = float(turn @ turn)
    return float("nan") if square < SHAPE.no_direction**2 else float(np.linalg.norm(np.cross(turn, way))) / square


def _helix_pitch(at: StateFields) -> float:
    turn, way = _mean(at)
    square = float(turn @ turn)
    if square < SHAPE.no_direction**2:
        return float("nan")
    along = float(turn @ way)
    return (
        2 * np.pi * along / square if abs(along) > ROUND_OFF.same * np.linalg.norm(turn) * np.linalg.norm(way) else 0.0
    )


def _arc_deviation(at: StateFields) -> float:
    line = center_line(at)
    return distance_from_arc(line.position) / line.length


def _ballooning(at: StateFields) -> float:
    return float(width_ratios(at).max())


curvature = Measure(
    name="curvature", unit="1/m", function=_curvature,
    definition="curvature of the center line, mean over its length: that of the arc or helix along which the mean "
    "motion from one cross-section to the next goes",
)  # fmt: skip
bending_radius = Measure(
    name="bending_radius", unit="mm", function=_bending_radius,
    definition="radius of the center line: one over its mean curvature; none where it is straight",
)  # fmt: skip
bending_plane = Measure(
    name="bending_plane", unit="deg", function=_bending_plane,
    definition="direction in which the center line bends, about x: 0 towards the base (−z), 90° towards +y; none where "
    "it is straight",
)  # fmt: skip
center_line_length = Measure(
    name="center_line_length", unit="mm", function=lambda at: center_line(at).length,
    definition="current length of the center line between the centers of the first and the last piece",
)  # fmt: skip
helix_radius = Measure(
    name="helix_radius", unit="mm", function=_helix_radius,
    definition="radius of the helix along which the mean motion from one cross-section to the next goes: that of the "
    "bending where there is no torsion; none where the actuator does not turn",
)  # fmt: skip
helix_pitch = Measure(
    name="helix_pitch", unit="mm", function=_helix_pitch,
    definition="way along the axis of this helix for each turn, positive for a right-handed one and zero for an arc; "
    "none where the actuator does not turn",
)  # fmt: skip
arc_deviation = Measure(
    name="arc_deviation", unit="", function=_arc_deviation,
    definition="root mean square distance of the center line from the circular arc that is nearest to it, over its "
    "length: 0 is an arc or straight",
)  # fmt: skip
ballooning = Measure(
    name="ballooning", unit="", function=_ballooning,
    definition="largest ratio of a width of the actuator across its center line to that width at rest, over pieces of "
    "its length and directions",
)  # fmt: skip
