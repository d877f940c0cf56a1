"""Chord angle: the turn of the line from the base to the tip, as a camera with two markers sees it."""

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.faces import surfaces
from turgor.core.results.fields.state_fields import StateFields
from turgor.core.results.measures.measure import Measure
from turgor.core.results.measures.shape.settings import SHAPE
from turgor.foundation.errors import TurgorError

Array = NDArray[np.float64]


def _middle(at: StateFields, face: str, points: Array) -> Array:
    """Center of a face of the whole actuator, weighted by reference area, (3,) [m]."""
    weights = surfaces.nodal_weights(at.mesh.points, at.mesh.face(face))
    return np.asarray(at.facts.of_whole(weights @ points / weights.sum()))


def _direction(at: StateFields, points: Array) -> float:
    """Direction from the face fixed to the face tip in the x-z plane [rad], counted from +x towards −z."""
    line = _middle(at, "tip", points) - _middle(at, "fixed", points)
    if np.hypot(line[0], line[2]) < SHAPE.no_direction * np.ptp(at.mesh.points, axis=0).max():
        raise TurgorError("the line from the face fixed to the face tip has no length in the x-z plane.")
    return float(np.arctan2(-line[2], line[0]))


def _chord_angle(at: StateFields) -> float:
    turned = _direction(at, at.points) - _direction(at, at.mesh.points)
    return float(np.arctan2(np.sin(turned), np.cos(turned)))


chord_angle = Measure(
    name="chord_angle", unit="deg", function=_chord_angle, unwrap=True, faces=("fixed", "tip"),
    definition="rotation of the line from the center of the face fixed to the center of the face tip in the x-z plane, "
    "positive towards the base; half the bending angle where the center line is an arc",
)  # fmt: skip
