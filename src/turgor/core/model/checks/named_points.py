"""Reference points in a model: which names there are, and what may hold them."""

from collections.abc import Sequence

from turgor.core.meshing.mesh import Mesh
from turgor.core.model.points import ReferencePoint
from turgor.core.model.supports import Support
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


def check_points(mesh: Mesh, supports: Sequence[Support]) -> None:
    """Refuse reference points that share a name, and supports of one that are unknown or given twice.

    Parameters
    ----------
    mesh : Mesh
    supports : sequence of Support

    Raises
    ------
    TurgorError
        If a name is unknown or given twice, or two supports prescribe one rotation.
    """
    points, names = points_of(supports), set[str]()
    for each in supports:
        if isinstance(each, ReferencePoint):
            if each.name in mesh.faces:
                raise TurgorError(f"reference point '{each.name}': a face has this name; give the point another one.")
            if each.name in names:
                raise TurgorError(f"two reference points are called '{each.name}'; names must differ.")
            names.add(each.name)
    turned = [each.turned_point for each in supports if each.turned_point]
    for name in turned:
        if name not in points:
            raise unknown("reference point", name, points)
        if turned.count(name) > 1:
            raise TurgorError(f"the rotation of '{name}' is prescribed twice; keep one Rotation or Hinge.")
    moved = [each.prescribed for each in supports if each.prescribed[0] in points]
    for name in {point for point, _ in moved}:
        letters = "".join(directions for point, directions in moved if point == name)
        if any(letters.count(letter) > 1 for letter in letters):
            raise TurgorError(f"two supports prescribe one direction of the reference point '{name}'; keep one.")
