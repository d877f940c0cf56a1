"""Widths: how far an actuator has grown across its center line, which is what ballooning means."""

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.cells.reference import tables_at
from turgor.core.meshing.cells import six_node_triangles
from turgor.core.results.fields.state_fields import StateFields
from turgor.core.results.measures.shape.center_line import CenterLine, center_line
from turgor.core.results.measures.shape.screws import screw_path
from turgor.core.results.measures.shape.sections import images_across
from turgor.core.results.measures.shape.settings import SHAPE

Array = NDArray[np.float64]


def width_ratios(at: StateFields) -> Array:
    """Width now over width at rest, by piece of the actuator and direction across it, (p, 12).

    The surface is seen from the moving section, so that bending and twisting change no width. The width of a piece is
    that of its surface seen along the center line.

    Parameters
    ----------
    at : StateFields

    Returns
    -------
    (p, 12) array [-]
    """
    line, images = center_line(at), images_across(at.facts)
    sides = six_node_triangles(at.facts.surface)
    rest, now = (np.einsum("qa,fai->fqi", _LATTICE, points[sides]).reshape(-1, 3) for points in _both(at))
    borders = (line.rest[:-1, 0] + line.rest[1:, 0]) / 2
    piece = np.searchsorted(borders, rest[:, 0])
    turns, origins = _moving_sections(line, rest[:, 0])
    here = [np.einsum("kij,ki->kj", turns, image.of(now) - origins) for image in images]
    before = [image.of(rest) for image in images]
    piece = np.tile(piece, len(here))
    return _widths(np.concatenate(here), piece, len(line.rest)) / _widths(np.concatenate(before), piece, len(line.rest))


def _both(at: StateFields) -> tuple[Array, Array]:
    return at.mesh.points, at.points


def _moving_sections(line: CenterLine, x: Array) -> tuple[Array, Array]:
    """Rotations (k, 3, 3) and origins (k, 3) of the moving sections through places along x at rest (k,)."""
    stations = line.rest[:, 0]
    here = np.clip(np.searchsorted(stations, x) - 1, 0, len(line.turns) - 1)
    share = (x - stations[here]) / np.diff(stations)[here]
    turns, origins = np.empty((len(x), 3, 3)), np.empty((len(x), 3))
    for number in np.unique(here):
        own = here == number
        turn, way = screw_path(line.turns[number], line.ways[number], share[own])
        turns[own] = line.rotation[number] @ turn
        origins[own] = line.position[number] + way @ line.rotation[number].T
    return turns, origins


def _widths(places: Array, piece: NDArray[np.int64], count: int) -> Array:
    """Extent of the points (k, 3) of each piece in each direction across, (count, 12)."""
    directions = SHAPE.directions
    angles = np.pi * np.arange(directions) / directions
    across = places[:, 1:] @ np.stack([np.cos(angles), np.sin(angles)])
    low, high = np.full((count, directions), np.inf), np.full((count, directions), -np.inf)
    np.minimum.at(low, piece, across)
    np.maximum.at(high, piece, across)
    return np.asarray(high - low)


def _lattice() -> Array:
    """Shape functions (q, 6) at a lattice on a triangle, so that pieces shorter than a cell have points, too."""
    parts = SHAPE.parts_of_edge
    places = np.array([(i, j) for i in range(parts + 1) for j in range(parts + 1 - i)], dtype=np.float64) / parts
    return np.asarray(tables_at(6, places, np.ones(len(places))).N)


_LATTICE = _lattice()
