"""A mesh as a VTU file for ParaView."""

from pathlib import Path

from turgor.meshing.mesh import Mesh
from turgor.meshing.quality.cell_quality import cell_shapes, jacobian_ratios
from turgor.results.files.vtu import grid_text
from turgor.results.files.vtu_xml import VtuArray


def write_mesh_vtu(path: str | Path, mesh: Mesh) -> None:
    """Write a mesh with its curved cells, the region, the shape and the Jacobian ratio of each.

    Parameters
    ----------
    path : str or Path
        File to write, ending in ``.vtu``; lengths in meters.
    mesh : Mesh
        The modeled part, not mirrored.
    """
    shapes = VtuArray("shape", cell_shapes(mesh).astype("f4"))
    ratios = VtuArray("jacobian_ratio", jacobian_ratios(mesh).astype("f4"))
    Path(path).write_text(grid_text(mesh, [], [shapes, ratios], []), encoding="utf-8")
