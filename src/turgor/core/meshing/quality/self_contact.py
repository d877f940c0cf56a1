"""Whether walls of a mesh may meet as it deforms."""

from turgor.core.meshing.bodies.bodies import find_bodies
from turgor.core.meshing.mesh import Mesh
from turgor.core.meshing.quality.mirror_gap import faces_its_image
from turgor.core.meshing.quality.proximity import find_facing_walls
from turgor.core.meshing.quality.quality_cache import once_per_mesh


@once_per_mesh  # by every check, and by the engine
def may_meet(mesh: Mesh) -> bool:
    """Whether a mesh consists of films or several bodies, or has walls that face each other or their image.

    Parameters
    ----------
    mesh : Mesh

    Returns
    -------
    bool
        False for 20-node hexahedra, which have no contact.
    """
    if not mesh.cell_type.side.triangles:
        return False
    if not len(mesh.cells):
        return True
    return len(find_bodies(mesh)) > 1 or len(find_facing_walls(mesh).pairs) > 0 or faces_its_image(mesh)
