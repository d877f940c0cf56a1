"""Turn CAD shapes and facets."""

from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from turgor.core.geometry import occ
from turgor.core.geometry.cad.surface.shape import SurfaceShape

Array = NDArray[np.float64]


def turned_shape(shape: Any, rotation: Array) -> Any:
    """Return a shape in axes that are the rows of a rotation (3, 3), about the origin of its file.

    Parameters
    ----------
    shape : CAD shape or SurfaceShape
    rotation : (3, 3) array

    Returns
    -------
    CAD shape or SurfaceShape
        With the names and colors of its faces.
    """
    if isinstance(shape, SurfaceShape):
        return replace(shape, points=shape.points @ rotation.T)
    angle = float(np.arccos(np.clip((np.trace(rotation) - 1) / 2, -1.0, 1.0)))
    if angle < 1e-12:
        return shape
    # the axis is what the rotation leaves: the eigenvector of 1, with the sign of the skew part where there is one
    values, vectors = np.linalg.eigh((rotation + rotation.T) / 2)
    axis = vectors[:, int(values.argmax())]
    skew = np.array([rotation[2, 1] - rotation[1, 2], rotation[0, 2] - rotation[2, 0], rotation[1, 0] - rotation[0, 1]])
    sign = -1.0 if float(skew @ axis) < 0 else 1.0
    return shape.Rotate(occ.Axis(occ.Pnt(0, 0, 0), occ.Dir(*map(float, sign * axis))), float(np.degrees(angle)))
