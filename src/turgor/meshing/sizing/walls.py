"""More cells through walls than the generator puts there."""

from turgor.meshing.mesh import Mesh
from turgor.meshing.quality.checks import crossings
from turgor.meshing.refining.split import split_edges


def refine_walls(mesh: Mesh, wall_cells: int) -> Mesh:
    """Put two cells through every wall that one cell reaches through, by cutting those cells in the middle of the wall.

    Cells along the wall stay as long as they are: that is where the unknowns are saved against a smaller mesh size.

    Parameters
    ----------
    mesh : Mesh
    wall_cells : int
        1 leaves the mesh as it is, 2 cuts.

    Returns
    -------
    Mesh

    Examples
    --------
    >>> from turgor.geometry import FastPneuNet
    >>> from turgor.meshing.quality.checks import check_mesh
    >>> from turgor.meshing.generate import mesh
    >>> coarse = mesh(FastPneuNet(chambers=2, length=20e-3).build(), size=4e-3)
    >>> [found.code for found in check_mesh(coarse)], check_mesh(refine_walls(coarse, 2))
    (['G01'], ())
    """
    if wall_cells < 2:
        return mesh
    edges, _ = crossings(mesh)
    return split_edges(mesh, edges)
