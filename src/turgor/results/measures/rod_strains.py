"""Strains of a rod: curvature, twist and stretch of a whole actuator along its center line, between two stations.

The part between the stations is divided into pieces along x. The map nearest to the displacement of a piece, affine
across it and turning along x, weighted by volume, gives the rotation and the center of its cross-section. Between
neighbors the rotation vector over the distance at rest is the curvature, seen from the section: what `turgor.Section`
calls so.
"""

from functools import partial
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from turgor.engine.cells import kernels_geometry
from turgor.engine.cells.reference import CELL_QUADRATURE_DEGREE, reference_cell
from turgor.errors import TurgorError
from turgor.meshing.mesh import Mesh
from turgor.results.fields.state_fields import StateFields
from turgor.results.measures.reading import Measure

Array = NDArray[np.float64]
Ints = NDArray[np.int64]

#: Pieces between two stations, and integration points that each must have for its map to be known.
PIECES, FEWEST_POINTS = 5, 40

#: Stations of the ready-made measures, as shares of the length.
MIDDLE = (0.4, 0.6)

#: Strains that a rod has, with their units and what they are.
STRAINS = {
    "curvature_y": ("1/m", "rotation about y, positive towards the base,"),
    "curvature_z": ("1/m", "rotation about z"),
    "twist": ("1/m", "rotation about the axis, positive counterclockwise seen from the tip,"),
    "stretch": ("", "change of the length of the line through the centers of the cross-sections"),
}


class _Pieces(NamedTuple):
    """Integration points between the stations: cells and shape values, places and weights, number of the piece."""

    cells: Ints
    N: Array
    places: Array
    weights: Array
    piece: Ints


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
    made = [
        Measure(
            name=f"{name}_{strain}",
            unit=unit,
            function=partial(_strain, low, high, i),
            definition=f"{what} for each length at rest, between {low:.0%} and {high:.0%} of the actuator",
        )
        for i, (strain, (unit, what)) in enumerate(STRAINS.items())
    ]
    return made[0], made[1], made[2], made[3]


def _strain(low: float, high: float, which: int, at: StateFields) -> float:
    pieces = at.facts.once(("rod strains", low, high), partial(_pieces, at.mesh, low, high))
    rotations, centers, places = _sections(at, pieces)
    turned, length = np.zeros(3), 0.0
    for i in range(PIECES - 1):
        vector = _rotation_vector(rotations[i].T @ rotations[i + 1])
        turned += vector
        length += float(np.linalg.norm(centers[i + 1] - centers[i])) / _chord(vector)
    span = float(places[-1] - places[0])
    return length / span if which == 3 else float(turned[[1, 2, 0][which]] / span)


def _pieces(mesh: Mesh, low: float, high: float) -> _Pieces:
    """Find the integration points between the stations."""
    start, length = float(mesh.points[:, 0].min()), float(np.ptp(mesh.points[:, 0]))
    table = reference_cell(mesh.cells.shape[1], CELL_QUADRATURE_DEGREE)
    shape = (0,) * mesh.cells.shape[1]
    _, volumes = kernels_geometry.reference_geometry(shape, mesh.points, mesh.cells, table.dN, table.weights)
    places = np.einsum("qa,cai->cqi", table.N, mesh.points[mesh.cells])
    share = (places[..., 0] - start) / length
    cell, point = np.nonzero((share >= low) & (share < high))
    piece = np.minimum(((share[cell, point] - low) / (high - low) * PIECES).astype(np.int64), PIECES - 1)
    if np.bincount(piece, minlength=PIECES).min() < FEWEST_POINTS:
        raise TurgorError(
            f"the part between {low:.0%} and {high:.0%} of the length has too few cells along x for its curvature; "
            "take stations farther apart or a finer mesh."
        )
    return _Pieces(mesh.cells[cell], table.N[point], places[cell, point], volumes[cell, point], piece)


def _sections(at: StateFields, pieces: _Pieces) -> tuple[Array, Array, Array]:
    """Rotation (p, 3, 3) and center (p, 3) of each piece, and where it is at rest along x (p,)."""
    now = pieces.places + np.einsum("ka,kai->ki", pieces.N, at.displacement[pieces.cells])
    rotations, centers, places = [], [], []
    for number in range(PIECES):
        own = pieces.piece == number
        rest, moved, weight = pieces.places[own], now[own], pieces.weights[own]
        for plane in at.facts.mirrors:
            image = np.ones(3)
            image[plane.axis] = -1
            shift = 2 * plane.position * (1 - image) / 2
            rest = np.concatenate([rest, rest * image + shift])
            moved = np.concatenate([moved, moved * image + shift])
            weight = np.concatenate([weight, weight])
        middle = weight @ rest / weight.sum()
        (x, y, z), root = (rest - middle).T, np.sqrt(weight)[:, None]
        # what a helix makes of a section: affine across it, and turning along x
        basis = np.stack([np.ones_like(x), x, y, z, x * x, x * y, x * z], axis=1)
        fitted = np.linalg.lstsq(root * basis, root * moved, rcond=None)[0]
        left, _, right = np.linalg.svd(fitted[1:4].T)
        rotations.append(left @ np.diag([1.0, 1.0, np.linalg.det(left @ right)]) @ right)
        centers.append(fitted[0])
        places.append(middle[0])
    return np.array(rotations), np.array(centers), np.array(places)


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


def _rotation_vector(rotation: Array) -> Array:
    """Axis times angle of a rotation (3, 3) by less than half a turn.

    Examples
    --------
    >>> c, s = np.cos(0.3), np.sin(0.3)
    >>> _rotation_vector(np.array([[1, 0, 0], [0, c, -s], [0, s, c]])).round(9).tolist()
    [0.3, 0.0, 0.0]
    """
    axis = np.array([rotation[2, 1] - rotation[1, 2], rotation[0, 2] - rotation[2, 0], rotation[1, 0] - rotation[0, 1]])
    sine = float(np.linalg.norm(axis)) / 2
    angle = np.arctan2(sine, (np.trace(rotation) - 1) / 2)
    return np.asarray(axis / 2 * (angle / sine if sine > 1e-12 else 1.0))


middle_curvature_y, middle_curvature_z, middle_twist, middle_stretch = rod_strains(*MIDDLE, "middle")
