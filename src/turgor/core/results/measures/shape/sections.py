"""Sections: where the cross-sections of an actuator along x are in a state, and how they are turned.

The part between two stations is divided into pieces along x. The map nearest to the displacement of a piece, affine
across it and turning along x, weighted by volume, gives the rotation and the center of its cross-section.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.cells import kernels_geometry
from turgor.core.engine.cells.reference import CELL_QUADRATURE_DEGREE, product_rule, reference_cell
from turgor.core.geometry.cad.symmetry.whole import Image
from turgor.core.results.fields.state_fields import MeshFacts, StateFields
from turgor.core.results.measures.shape.settings import SHAPE

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


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
    table = reference_cell(mesh.carrying_cells.shape[1], CELL_QUADRATURE_DEGREE)
    shape = (0,) * mesh.carrying_cells.shape[1]
    _, volumes = kernels_geometry.reference_geometry(shape, mesh.points, mesh.carrying_cells, table.dN, table.weights)
    places = np.einsum("qa,cai->cqi", table.N, mesh.points[mesh.carrying_cells])
    share = (places[..., 0] - start) / length
    cell, point = np.nonzero((share >= low) & (share <= high))
    piece = ((share[cell, point] - low) / (high - low) * count).astype(np.int64)
    piece = np.minimum(piece, count - 1)
    if np.bincount(piece, minlength=count).min() < SHAPE.fewest_points:
        return None
    place, weight = places[cell, point], volumes[cell, point]
    middles = np.tile(_centroid(facts, place, weight), (count, 1))
    middles[:, 0] = start + length * (low + (high - low) * (np.arange(count) + 0.5) / count)
    return Pieces(mesh.carrying_cells[cell], table.N[point], place, weight, piece, middles)


def windows_of(facts: MeshFacts, low: float, high: float, count: int) -> Pieces:
    """Lay overlapping windows on the part of a mesh between two stations, equally far apart along x.

    The weight of a window falls smoothly to zero at its two ends, a distance of windows from its middle. So what is
    integrated hardly depends on where cells end and where their integration points lie, even in cells that are longer
    than a window.

    Parameters
    ----------
    facts : MeshFacts
    low, high : float
        Stations as shares of the length; the windows lie within.
    count : int
        How many windows.

    Returns
    -------
    Pieces
        A point within two windows is in there twice.
    """
    mesh = facts.mesh
    start, length = float(mesh.points[:, 0].min()), float(np.ptp(mesh.points[:, 0]))
    apart = (high - low) / (count + 1)
    centers = low + apart * (1 + np.arange(count))
    cells = _cells_between(facts, low, high)
    long = float(np.ptp(mesh.points[mesh.carrying_cells[cells], 0], axis=1).max()) / length
    along = max(2, int(np.ceil(SHAPE.points_apart * long / apart)))  # two give the slope within a cell
    table = product_rule(mesh.carrying_cells.shape[1], 2 * along - 1)
    shape = (0,) * mesh.carrying_cells.shape[1]
    _, volumes = kernels_geometry.reference_geometry(
        shape, mesh.points, mesh.carrying_cells[cells], table.dN, table.weights
    )
    places = np.einsum("qa,cai->cqi", table.N, mesh.points[mesh.carrying_cells[cells]])
    aside = ((places[..., 0] - start) / length - centers[:, None, None]) / apart
    piece, cell, point = np.nonzero(np.abs(aside) < 1)
    place = places[cell, point]
    weight = volumes[cell, point] * (1 - aside[piece, cell, point] ** 2) ** 2
    middles = np.tile(_centroid(facts, place, weight), (count, 1))
    middles[:, 0] = start + length * centers
    return Pieces(mesh.carrying_cells[cells[cell]], table.N[point], place, weight, piece, middles)


def cell_length(facts: MeshFacts, low: float, high: float) -> float:
    """Mean extent along x of the cells that reach into the part between two stations [m]."""
    cells = facts.mesh.carrying_cells[_cells_between(facts, low, high)]
    return float(np.ptp(facts.mesh.points[cells, 0], axis=1).mean())


def _cells_between(facts: MeshFacts, low: float, high: float) -> Ints:
    """Cells that reach into the part between two stations."""
    x = facts.mesh.points[facts.mesh.cells, 0]
    share = (x - facts.mesh.points[:, 0].min()) / np.ptp(facts.mesh.points[:, 0])
    return np.flatnonzero((share.max(axis=1) > low) & (share.min(axis=1) < high))


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
