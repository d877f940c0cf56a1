"""Reference points in a model: which names there are, and what may act on them."""

from collections.abc import Sequence

from turgor.core.meshing.mesh import Mesh
from turgor.core.model.loads import Force, Hanging, Load, Moment
from turgor.core.model.points import Hinge, ReferencePoint, Rotation
from turgor.core.model.supports import Displacement, Fixed, Support
from turgor.foundation.errors import TurgorError, unknown


def points_of(supports: Sequence[Support]) -> dict[str, ReferencePoint]:
    """Return the reference points among supports by their names.

    Parameters
    ----------
    supports : sequence of Support

    Returns
    -------
    dict of str to ReferencePoint
    """
    return {each.name: each for each in supports if isinstance(each, ReferencePoint)}


def check_points(mesh: Mesh, supports: Sequence[Support], loads: Sequence[Load]) -> None:
    """Refuse reference points that share a name, and what acts on none or across a mirror plane.

    Parameters
    ----------
    mesh : Mesh
    supports : sequence of Support
    loads : sequence of Load

    Raises
    ------
    TurgorError
        If a name is unknown or given twice, two supports prescribe one rotation, or a load has no mirror image.
    """
    points, seen = points_of(supports), set[str]()
    for each in supports:
        if isinstance(each, ReferencePoint):
            if each.name in mesh.faces:
                raise TurgorError(f"reference point '{each.name}': a face has this name; give the point another one.")
            if each.name in seen:
                raise TurgorError(f"two reference points are called '{each.name}'; names must differ.")
            seen.add(each.name)
    turned = [each.point for each in supports if isinstance(each, Rotation | Hinge)]
    for name in turned:
        if name not in points:
            raise unknown("reference point", name, points)
        if turned.count(name) > 1:
            raise TurgorError(f"the rotation of '{name}' is prescribed twice; keep one Rotation or Hinge.")
    moved = [each for each in supports if isinstance(each, Fixed | Displacement) and each.face in points]
    for name in {each.face for each in moved}:
        letters = "".join(each.directions for each in moved if each.face == name)
        if any(letters.count(letter) > 1 for letter in letters):
            raise TurgorError(f"two supports prescribe one direction of the reference point '{name}'; keep one.")
    _check_loads(mesh, loads, points)


def _check_loads(mesh: Mesh, loads: Sequence[Load], points: dict[str, ReferencePoint]) -> None:
    for load in loads:
        if isinstance(load, Moment | Hanging) and load.point not in points:
            raise unknown(f"reference point of a {type(load).__name__.lower()} load", load.point, points)
        if isinstance(load, Force) and load.follower and load.face not in points:
            raise TurgorError(
                f"force on '{load.face}': only a force on a reference point can follow its rotation; tie the face to "
                "a ReferencePoint, or take a Pressure."
            )
        for plane, (axis, _) in zip(mesh.symmetry_faces, mesh.mirror_planes, strict=True):
            where = f"mirror plane '{plane}'; model the whole actuator (symmetric = false)."
            if isinstance(load, Moment) and any(load.vector[k] for k in range(3) if k != axis):
                raise TurgorError(
                    f"moment on '{load.point}': {load.vector} N m has no mirror image, for only a moment about "
                    f"{'xyz'[axis]} is symmetric to the {where}"
                )
            if isinstance(load, Hanging) and load.force[axis]:
                raise TurgorError(f"weight on '{load.point}': it pulls across the {where}")
