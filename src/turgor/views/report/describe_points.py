"""Reference points in words: what ties them and holds them."""

import numpy as np

from turgor.core.model.points import RIGID, Hinge, ReferencePoint, Rotation
from turgor.units import deg, mm


def point_text(support: ReferencePoint | Rotation | Hinge) -> str:
    """A reference point, or what prescribes its rotation, in a sentence.

    Examples
    --------
    >>> point_text(Rotation("plate", 0.5 * np.pi))
    'plate turned by 90 deg about (1, 0, 0).'
    """
    match support:
        case ReferencePoint():
            return _point(support)
        case Rotation(point, angle, axis, _, True):
            return f"{point} turned by {angle / deg:g} deg about ({_listed(axis)}), free to tilt."
        case Rotation(point, angle, axis):
            if not angle:
                return f"{point} kept from turning."
            return f"{point} turned by {angle / deg:g} deg about ({_listed(axis)})."
        case Hinge(point, axis):
            about = axis if isinstance(axis, str) else f"({_listed(axis)})"
            return f"{point} may turn about {about} only."


def _point(point: ReferencePoint) -> str:
    how = "moves rigidly with" if point.coupling == RIGID else "moves on average with"
    said = [f"{point.face} {how} the reference point {point.name}"]
    if point.at is not None:
        said.append(f"at ({_listed([value / mm for value in point.at])}) mm")
    if point.mass:
        said.append(f"of mass {point.mass:g} kg")
    if any(point.stiffness):
        said.append(f"held by springs of ({_listed(point.stiffness)}) N/m")
    if point.rotational_spring:
        said.append(f"turned back by a spring of {point.rotational_spring:g} N m/rad")
    return f"{', '.join(said)}."


def _listed(values: object) -> str:
    return ", ".join(f"{value:g}" for value in np.asarray(values))
