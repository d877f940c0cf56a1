"""A mesh as a VTU file for ParaView."""

from pathlib import Path

import numpy as np

from turgor.core.meshing.mesh import Mesh
from turgor.core.meshing.quality.cell_quality import cell_shapes, jacobian_ratios
from turgor.core.results.files.vtu import grid_text
from turgor.core.results.files.vtu_xml import VtuArray, numbered


def write_mesh_vtu(path: str | Path, mesh: Mesh) -> None:
    """Write a mesh with its curved cells, the region, the shape and the Jacobian ratio of each, and its named faces.

    Field data hold what `turgor.files.read_mesh` needs to give the same mesh back: the numbers of the regions and faces
    as ``region:NAME`` and ``face:NAME``, the corners of the sides of all faces, one after the other, as
    ``face_corners`` (-1 in the last place of triangles), and where each face ends among them as ``face_ends``.

    Parameters
    ----------
    path : str or Path
        File to write, ending in ``.vtu``; lengths in meters.
    mesh : Mesh
        The modeled part, not mirrored.
    """
    shapes = VtuArray("shape", cell_shapes(mesh).astype("f4"))
    ratios = VtuArray("jacobian_ratio", jacobian_ratios(mesh).astype("f4"))
    Path(path).write_text(grid_text(mesh, [], [shapes, ratios], _faces(mesh)), encoding="utf-8")


def _faces(mesh: Mesh) -> list[VtuArray]:
    """Arrays and names of the faces."""
    if not mesh.faces:
        return []
    corners = mesh.cell_type.side.corners
    sides = np.full((sum(map(len, mesh.faces.values())), 4), -1, dtype="i4")
    sides[:, :corners] = np.concatenate([face[:, :corners] for face in mesh.faces.values()])
    ends = np.cumsum([len(face) for face in mesh.faces.values()]).astype("i4")
    return [VtuArray("face_corners", sides), VtuArray("face_ends", ends), *numbered("face", list(mesh.faces))]
