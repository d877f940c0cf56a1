"""Names of the faces of actuators along x, from the position of the faces."""

from typing import Any

from turgor.core.geometry.cad_unit import METERS_PER_CAD_UNIT
from turgor.core.geometry.names import INTERFACE
from turgor.core.geometry.shapes.solids import name_plane, name_rest
from turgor.core.geometry.shapes.tolerances import TOLERANCE


def name_faces(shape: Any, *, end: float, clamp: float = 0.0, mirrors: str = "") -> None:
    """Name the faces of a finished shape; walls of cavities have names already.

    Parameters
    ----------
    shape : netgen.occ shape
        All regions.
    end : float [m]
        Position of the plane of the face ``tip``.
    clamp : float [m]
        Length of the clamped block: its sides up to there belong to ``fixed``, as the plane x = 0 does.
    mirrors : str
        Mirror planes that cut the modeled part: ``""``, ``"y"`` or ``"yz"``.

    Examples
    --------
    >>> from turgor.core.geometry.shapes.solids import box, face_names
    >>> part = box((0, 1e-3), (0, 1e-3), (0, 1e-3))
    >>> name_faces(part, end=1e-3, mirrors="y")
    >>> face_names(part)
    ('fixed', 'outside', 'symmetry_y', 'tip')
    """
    name_plane(shape, 0, 0.0, "fixed")
    name_plane(shape, 0, end, "tip")
    for mirror in mirrors:
        name_plane(shape, "xyz".index(mirror), 0.0, f"symmetry_{mirror}")
    shared = [face for solid in shape.solids for face in solid.faces]
    for face in shape.faces:
        if face.name:
            continue
        if shared.count(face) > 1:
            face.name = INTERFACE
        elif face.bounding_box[1][0] <= clamp / METERS_PER_CAD_UNIT + TOLERANCE.length:
            face.name = "fixed"
    name_rest(shape, "outside")
