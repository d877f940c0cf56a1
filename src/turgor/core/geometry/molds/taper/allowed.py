"""The largest draft that a part allows: with more, its narrowest end closes."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from math import floor
from typing import Any

import numpy as np
from numpy.typing import NDArray

from turgor.core.geometry.cad.facets import find_facets
from turgor.core.geometry.molds.taper.pull import Pull
from turgor.core.geometry.molds.taper.tapered import tapered
from turgor.core.geometry.molds.taper.walls import FlatFace, known_faces
from turgor.foundation.errors import TurgorError
from turgor.units import deg

Array = NDArray[np.float64]

#: Halvings of the range in which the largest draft is looked for.
HALVINGS = 7

#: An end of a part remains if it is at the same height to this length [CAD units].
SAME = 1e-5


def with_draft(what: str, shape: Any, pull: Pull, upright: Sequence[Array] = ()) -> Any:
    """Return a part with draft, as `tapered`, if all of its ends remain.

    Parameters
    ----------
    what : str
        The part, for the message.
    shape : CAD shape
    pull : Pull
    upright : sequence of (3,) arrays [CAD units]
        Points of plane walls that stay.

    Raises
    ------
    TurgorError
        If the draft closes an end of the part, with the largest draft that does not.

    Examples
    --------
    >>> from turgor.core.geometry.shapes.solids import box
    >>> web = box((0, 20e-3), (0, 1e-3), (0, 10e-3))
    >>> with_draft("part", web, Pull(axis=2, side=1, height=0.0, draft=4 * deg))
    Traceback (most recent call last):
    turgor.TurgorError: draft is 4 deg; allowed for this part is 0 deg to 2.8 deg: with more, its end around \
(10, 0.5, 10) mm closes.
    """
    made = tapered(shape, pull, upright)
    closed = _closed_end(shape, made, pull)
    if closed is None:
        return made

    def remains(draft: float) -> bool:
        trial = replace(pull, draft=draft)
        return _closed_end(shape, tapered(shape, trial, upright), trial) is None

    x, y, z = (round(float(each), 2) + 0.0 for each in closed)
    raise TurgorError(
        f"draft is {pull.draft / deg:.4g} deg; allowed for this {what} is {allowed(remains, pull.draft)}: with more, "
        f"its end around ({x:g}, {y:g}, {z:g}) mm closes."
    )


def allowed(fits: Callable[[float], bool], draft: float) -> str:
    """Write the range of drafts that fit.

    Parameters
    ----------
    fits : function
        Whether a draft [rad] fits.
    draft : float [rad]
        One that does not.

    Examples
    --------
    >>> allowed(lambda draft: draft < 3 * deg, 10 * deg)
    '0 deg to 2.9 deg'
    """
    low, high = 0.0, draft
    for _ in range(HALVINGS):
        middle = (low + high) / 2
        low, high = (middle, high) if fits(middle) else (low, middle)
    return f"0 deg to {floor(10 * low / deg) / 10:g} deg"


def _closed_end(before: Any, after: Any, pull: Pull) -> Array | None:
    """Middle of an end of a part, plane and across the pull, of which nothing is left."""
    faces = list(dict.fromkeys(before.faces))
    facets = find_facets(before, faces)
    left = [face for face in after.faces if np.ptp([corner[pull.axis] for corner in face.bounding_box]) < SAME]
    for number, known in enumerate(known_faces(faces, facets, pull)):
        if isinstance(known, FlatFace) and known.normal @ pull.along > 1 - SAME:
            at = known.point[pull.axis]
            level = [face for face in left if abs(face.bounding_box[0][pull.axis] - at) < SAME]
            if not any(face.Distance(faces[number]) < SAME for face in level):
                corners = facets.corners(np.array([number])).reshape(-1, 3)
                return np.asarray((corners.min(axis=0) + corners.max(axis=0)) / 2)
    return None
