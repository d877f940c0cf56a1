"""Rotations: the rotation of a face as a whole, and its twist about x."""

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.faces import surfaces
from turgor.core.results.fields.state_fields import StateFields

Array = NDArray[np.float64]


def face_rotation(at: StateFields, face: str) -> Array:
    """Rotation that brings a face from rest nearest to where it is, weighted by area at rest, (3, 3).

    Parameters
    ----------
    at : StateFields
    face : str
        Name of the face.
    """
    weights = surfaces.nodal_weights(at.mesh.points, at.mesh.face(face))
    rest, now = at.mesh.points, at.points
    if at.mesh.wedge is not None:  # one sector leans on the axis, and the whole turns about it
        weights = np.tile(weights, at.mesh.wedge.fold)
        rest, now = (np.concatenate([image.of(points) for image in at.facts.images]) for points in (rest, now))
    rest, now = (points - weights @ points / weights.sum() for points in (rest, now))
    left, _, right = np.linalg.svd((now * weights[:, None]).T @ rest)
    mend = np.diag([1.0, 1.0, np.linalg.det(left @ right)])  # a rotation, never a mirror image
    return np.asarray(left @ mend @ right, dtype=np.float64)


def twist(rotation: Array) -> float:
    """Part of a rotation that turns about the x axis before the rest tilts that axis, within half a turn [rad].

    Examples
    --------
    >>> c, s = np.cos(0.3), np.sin(0.3)
    >>> about_x = np.array([[1, 0, 0], [0, c, -s], [0, s, c]])
    >>> about_y = np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]])
    >>> round(twist(about_y @ about_x), 9), round(twist(about_y), 9)
    (0.3, 0.0)
    """
    # of the rotation's quaternion (cos half the angle, axis times its sine) the parts w and x, both times 4w
    w, x = 1 + np.trace(rotation), rotation[2, 1] - rotation[1, 2]
    return float(2 * np.arctan2(x, w))
