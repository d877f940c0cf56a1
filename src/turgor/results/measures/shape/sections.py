"""Sections: where the cross-sections of an actuator along x are in a state, and how they are turned.

The part between two stations is divided into pieces along x. The map nearest to the displacement of a piece, affine
across it and turning along x, weighted by volume, gives the rotation and the center of its cross-section.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from turgor.engine.cells import kernels_geometry
from turgor.engine.cells.reference import CELL_QUADRATURE_DEGREE, reference_cell
from turgor.results.fields.state_fields import Image, MeshFacts, StateFields

Array = NDArray[np.float64]
Ints = NDArray[np.int64]

#: Integration points that each piece must have for its map to be known.
FEWEST_POINTS = 40


class Pieces(NamedTuple):
    """Integration points between the stations: cells and shape values, places and weights, number of the piece.

    ``middles`` (p, 3) [m] are the middles of the pieces at rest, on the line along x through the centroid of them all.
    """

    cells: Ints
    N: Array
    places: Array
    weights: Array
    piece: Ints
    middles: Array


class Sections(NamedTuple):
    """Cross-sections: rotations (p, 3, 3), centers (p, 3) [m], and where the centers are at rest, (p, 3) [m]."""

    rotations: Array
    centers: Array
    rest: Array


def pieces_of(facts: MeshFacts, low: float, high: float, count: int) -> Pieces | None:
    """Divide the part of a mesh between two stations into pieces along x.

    Parameters
    ----------
    facts : MeshFacts
        Of the mesh.
    low, high : float
        Stations as shares of the length.
    count : int
        How many pieces.

    Returns
    -------
    Pieces or None
        None where a piece has too few integration points.
    """
    mesh = facts.mesh
    start, length = float(mesh.points[:, 0].min()), float(np.ptp(mesh.points[:, 0]))
    table = reference_cell(mesh.cells.shape[1], CELL_QUADRATURE_DEGREE)
    shape = (0,) * mesh.cells.shape[1]
    _, volumes = kernels_geometry.reference_geometry(shape, mesh.points, mesh.cells, table.dN, table.weights)
    places = np.einsum("qa,cai->cqi", table.N, mesh.points[mesh.cells])
    share = (places[..., 0] - start) / length
    cell, point = np.nonzero((share >= low) & (share <= high))
    piece = ((share[cell, point] - low) / (high - low) * count).astype(np.int64)
    piece = np.minimum(piece, count - 1)
    if np.bincount(piece, minlength=count).min() < FEWEST_POINTS:
        return None
    place, weight = places[cell, point], volumes[cell, point]
    middles = np.tile(_centroid(facts, place, weight), (count, 1))
    middles[:, 0] = start + length * (low + (high - low) * (np.arange(count) + 0.5) / count)
    return Pieces(mesh.cells[cell], table.N[point], place, weight, piece, middles)


def images_across(facts: MeshFacts) -> list[Image]:
    """Images of the modeled part that complete its cross-sections, those in planes across x left out."""
    return [image for image in facts.images if image.turn[0, 0] > 0]


def _centroid(facts: MeshFacts, places: Array, weights: Array) -> Array:
    """Centroid of the images of places (k, 3) together, (3,) [m]."""
    middle = weights @ places / weights.sum()
    return np.asarray(np.mean([image.of(middle) for image in images_across(facts)], axis=0))


def sections_of(at: StateFields, pieces: Pieces) -> Sections:
    """Find the cross-section of each piece in a state of the whole actuator.

    Parameters
    ----------
    at : StateFields
    pieces : Pieces

    Returns
    -------
    Sections
    """
    images = images_across(at.facts)
    now = pieces.places + np.einsum("ka,kai->ki", pieces.N, at.displacement[pieces.cells])
    rotations, centers = [], []
    for number, middle in enumerate(pieces.middles):
        own = pieces.piece == number
        rest, moved = (np.concatenate([image.of(points[own]) for image in images]) for points in (pieces.places, now))
        (x, y, z), root = (rest - middle).T, np.sqrt(np.tile(pieces.weights[own], len(images)))[:, None]
        # what a helix makes of a section: affine across it, and turning along x
        basis = np.stack([np.ones_like(x), x, y, z, x * x, x * y, x * z], axis=1)
        fitted = np.linalg.lstsq(root * basis, root * moved, rcond=None)[0]
        left, _, right = np.linalg.svd(fitted[1:4].T)
        rotations.append(left @ np.diag([1.0, 1.0, np.linalg.det(left @ right)]) @ right)
        centers.append(fitted[0])
    return Sections(np.array(rotations), np.array(centers), pieces.middles)
