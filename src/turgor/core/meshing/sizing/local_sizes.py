"""Smaller sizes at the corners about which thin walls bend, which `turgor.core.geometry.thin_corners` finds.

Measured at the default size of twice the wall, error of the angle and unknowns without | with these sizes | with half
the size everywhere:

- omnidirectional actuator with ring sectors, neo-Hooke, 8 % below its largest pressure: 3.9 % (17,000) | 0.6 % (27,000)
  | 0.6 % (45,000);
- rectangular bender of 50 mm on a base 20 times stiffer: 3.3 % (7,000) | 1.3 % (13,000) | 1.8 % (27,000);
- three parallel bellows with sharp folds: 5.0 % (42,000) | 0.9 % (77,000) | 1.7 % (126,000, 0.63 of the size).
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.core.geometry.geometry import Geometry
from turgor.core.geometry.thin_corners import find_thin_corners
from turgor.core.meshing.sizing.settings import SIZING

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class LocalSizes:
    """Sizes of parts of a mesh that differ from its own.

    Parameters
    ----------
    faces : mapping of int to float [m]
        Sizes by the place of the CAD face in the list of the shape.
    lines : (k, 2, 3) array [m]
        Ends of straight lines with smaller cells along them.
    line_size : float [m]
        Size along these lines.
    """

    faces: Mapping[int, float]
    lines: Array
    line_size: float


def local_sizes(geometry: Geometry, size: float, face_sizes: Mapping[str, float]) -> LocalSizes:
    """Sizes that faces and corners get: given ones by name, the others where thin walls bend about corners.

    Parameters
    ----------
    geometry : Geometry
    size : float [m]
        Size of the whole mesh.
    face_sizes : mapping of str to float [m]
        Sizes that were given; a cavity that is named here gets no others.

    Returns
    -------
    LocalSizes

    Examples
    --------
    >>> from turgor.core.geometry.actuators.omnidirectional_actuator import OmnidirectionalActuator
    >>> part = OmnidirectionalActuator(chamber_shape="ring_sector", symmetric=True).build()
    >>> found = local_sizes(part, 4e-3, {})
    >>> len(found.faces), len(found.lines), round(found.line_size, 6)
    (3, 11, 0.001333)
    >>> len(local_sizes(part, 4e-3, {"cavity_2": 4e-3}).lines)
    4
    """
    corners = [corner for corner in find_thin_corners(geometry) if corner.name not in face_sizes]
    named = {i: face_sizes[face.name] for i, face in enumerate(geometry._cad.faces) if face.name in face_sizes}
    lines = [corner.lines for corner in corners]
    return LocalSizes(
        faces=named
        | {i: SIZING.curved * size for corner in corners for i in corner.curved}
        | {i: SIZING.folded * size for corner in corners for i in corner.folded},
        lines=np.concatenate(lines) if lines else np.zeros((0, 2, 3)),
        line_size=SIZING.short * size,
    )
