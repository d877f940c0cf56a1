"""Strains of a rod: curvature, twist and stretch of a whole actuator along its center line, between two stations.

Between neighboring cross-sections (`turgor.core.results.measures.shape.sections`) the rotation vector over the
distance at rest is the curvature, seen from the section: what `turgor.Section` calls so.
"""

from functools import partial

import numpy as np
from numpy.typing import NDArray

from turgor.core.geometry.directions import rotation_vector
from turgor.core.results.fields.state_fields import MeshFacts, StateFields
from turgor.core.results.measures.measure import Measure
from turgor.core.results.measures.shape.sections import Pieces, cell_length, sections_of, windows_of
from turgor.core.results.measures.shape.settings import SHAPE
from turgor.foundation.errors import TurgorError
from turgor.units import mm

Array = NDArray[np.float64]

#: Strains that a rod has, with their units and what they are.
STRAINS = {
    "curvature_y": ("1/m", "rotation about y, positive towards the base,"),
    "curvature_z": ("1/m", "rotation about z"),
    "twist": ("1/m", "rotation about the axis, positive counterclockwise seen from the tip,"),
    "stretch": ("", "change of the length of the line through the centers of the cross-sections"),
}


def rod_strains(low: float, high: float, name: str) -> tuple[Measure, Measure, Measure, Measure]:
    """Measure the strains of an actuator along x between two stations, as those of a rod.

    Parameters
    ----------
    low, high : float
        Stations as shares of the length along x, 0 to 1.
    name : str
        The measures are ``NAME_curvature_y``, ``NAME_curvature_z``, ``NAME_twist`` and ``NAME_stretch``. They are means
        between the stations for each length at rest; `turgor.Section` has columns of the same names.

    Raises
    ------
    TurgorError
        If the stations are not in order within 0 and 1.

    Examples
    --------
    >>> [each.name for each in rod_strains(0.2, 0.4, "root")]
    ['root_curvature_y', 'root_curvature_z', 'root_twist', 'root_stretch']
    """
    if not 0 <= low < high <= 1:
        raise TurgorError(
            f"stations are {low:g} and {high:g} of the length; give two shares in order, such as 0.4, 0.6."
        )
    measures = [
        Measure(
            name=f"{name}_{strain}",
            unit=unit,
            function=partial(_strain, low, high, i),
            definition=f"{what} for each length at rest, between {low:.0%} and {high:.0%} of the actuator",
        )
        for i, (strain, (unit, what)) in enumerate(STRAINS.items())
    ]
    return measures[0], measures[1], measures[2], measures[3]


def _strain(low: float, high: float, which: int, at: StateFields) -> float:
    pieces = at.facts.once(("rod strains", low, high), partial(_pieces, at.facts, low, high))
    rotations, centers, rest = sections_of(at, pieces)
    turned, length = np.zeros(3), 0.0
    for i in range(len(rotations) - 1):
        vector = rotation_vector(rotations[i].T @ rotations[i + 1])
        turned += vector
        length += float(np.linalg.norm(centers[i + 1] - centers[i])) / _chord(vector)
    span = float(rest[-1, 0] - rest[0, 0])
    return length / span if which == 3 else float(turned[[1, 2, 0][which]] / span)


def _pieces(facts: MeshFacts, low: float, high: float) -> Pieces:
    """Find the integration points between the stations; within a cell the sections say nothing of their own."""
    length, long = float(np.ptp(facts.mesh.points[:, 0])), cell_length(facts, low, high)
    if long > (high - low) * length:
        raise TurgorError(
            f"the part between {low:.0%} and {high:.0%} of the length has too few cells along x for its curvature: it "
            f"is {(high - low) * length / mm:.4g} mm long, its cells {long / mm:.4g} mm; take stations farther apart "
            "or a finer mesh."
        )
    return windows_of(facts, low, high, SHAPE.strain_sections)


def _chord(vector: Array) -> float:
    """Chord over arc of a helix whose tangent, x at first, turns by a rotation vector on its way.

    Examples
    --------
    >>> round(_chord(np.array([0.0, np.pi, 0.0])) * np.pi, 9)  # half a circle
    2.0
    >>> _chord(np.array([1.0, 0.0, 0.0]))  # a twist
    1.0
    """
    angle = float(np.linalg.norm(vector))
    if angle < 1e-9:
        return 1.0
    axis = vector / angle
    along, across = axis[0], np.hypot(axis[1], axis[2])
    return float(np.hypot(along, across * 2 * np.sin(angle / 2) / angle))


middle_curvature_y, middle_curvature_z, middle_twist, middle_stretch = rod_strains(0.4, 0.6, "middle")
