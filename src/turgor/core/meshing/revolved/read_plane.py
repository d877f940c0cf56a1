"""read_plane_mesh: plane strain and bodies of revolution from a plane mesh of a file."""

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

from turgor.core.geometry.directions import FileAxes
from turgor.core.meshing.exchange.names import Wishes
from turgor.core.meshing.exchange.read import named_mesh, read_in, with_unit_checked
from turgor.core.meshing.exchange.selectors import Choice
from turgor.core.meshing.mesh import Mesh
from turgor.core.meshing.revolved.plane_files import spread
from turgor.core.meshing.revolved.plane_state import PlaneState
from turgor.foundation.finding import Finding, Severity


def read_plane_mesh(
    path: str | Path,
    state: PlaneState,
    *,
    unit: str | float | None = None,
    regions: Mapping[str, Choice] | None = None,
    faces: Mapping[str, Choice] | None = None,
    axes: FileAxes = ("x", "y", "z"),
) -> Mesh:
    """Read a plane mesh for plane strain or axisymmetric states: triangles and quadrilaterals, linear or quadratic.

    Named edges of the file become faces: physical curves, surfaces and node sets. Quadrilaterals become hexahedra:
    one layer of them for plane strain, two around a quarter for axisymmetric states, whose rings of nodes move alike.
    With a triangle among them, triangles are cut into three, and quadrilaterals into four.

    Parameters
    ----------
    path : str or Path
        The file, as for `read_mesh`; its cells lie in a plane across x, y or z.
    state : PlaneStrain or Axisymmetric
        What the plane stands for.
    unit, regions, faces, axes : optional
        As for `read_mesh`. Boxes and normals mean the hexahedra.

    Returns
    -------
    Mesh
        In plane strain, four mirror images make the whole thickness; an axisymmetric one is ``revolved``.

    Raises
    ------
    TurgorError
        If the file has solid cells, its cells lie in no such plane or on both sides of the axis, or as for `read_mesh`.
    """
    file = Path(path)
    raw, frame = read_in(file, unit, axes)
    stated = bool(unit or raw.unit)
    raw, what = spread(raw, state, frame)
    mesh = named_mesh(raw, Wishes(regions=regions or {}, faces=faces or {}, frame=frame))
    done = Finding(
        code="G20",
        severity=Severity.NOTE,
        message=f"'{file.name}' is a plane mesh: its {what}.",
        advice="Nothing is to be done where this is what you expect.",
    )
    return with_unit_checked(replace(mesh, findings=(done, *mesh.findings)), file, stated=stated)
