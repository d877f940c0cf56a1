"""Corners of a section where solids fill more than a straight angle: stresses have no bound there."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from turgor.core.geometry.extrusion import Layer
from turgor.core.meshing.coinciding_points import same_places
from turgor.core.meshing.sweeping.section import is_solid, names_at
from turgor.fast_models.section.shapes.settings import SECTION_MESH

Array = NDArray[np.float64]


def sharp_corners(layer: Layer, mirrors: Sequence[int] = ()) -> Array:
    """Find the corners of the outlines of a section that cut into its solids.

    Parameters
    ----------
    layer : Layer
    mirrors : sequence of int
        Axes (1 for y, 2 for z) whose mirror planes through the origin cut the section.

    Returns
    -------
    (k, 2) array [m]

    Examples
    --------
    >>> from turgor.core.geometry.shapes.sections import disc, rectangle
    >>> areas = (("body", disc(9.0)), ("cavity", rectangle((-2.0, 2.0), (-1.0, 1.0))))
    >>> sharp_corners(Layer(start=0.0, end=1.0, fill=areas)).tolist()
    [[-2.0, -1.0], [2.0, -1.0], [2.0, 1.0], [-2.0, 1.0]]
    """
    corners = np.array([corner for _, outline in layer.fill for corner in outline.corners])
    corners = corners[same_places(corners)[1]]
    turn = 2 * np.pi * (np.arange(SECTION_MESH.directions) + 0.5) / SECTION_MESH.directions
    around = SECTION_MESH.near * np.ptp(corners, axis=0).max() * np.stack([np.cos(turn), np.sin(turn)], axis=1)
    points = (corners[:, None] + around).reshape(-1, 2)
    for axis in mirrors:
        points[:, axis - 1] = np.abs(points[:, axis - 1])
    solid = np.array([is_solid(name) for name in names_at([layer], points)[0]]).reshape(len(corners), -1).mean(axis=1)
    return np.asarray(corners[(solid >= SECTION_MESH.sharp_angle) & (solid < 1)])
