"""mesh_of: the mesh that a job asks for."""

from turgor.geometry import Geometry
from turgor.job.job import Job
from turgor.meshing.exchange.mesh_file import MeshedShape
from turgor.meshing.generate import mesh_with
from turgor.meshing.mesh import Mesh


def mesh_of(job: Job, geometry: Geometry) -> Mesh:
    """Mesh a geometry as a job says.

    Parameters
    ----------
    job : Job
        Its settings of the mesh.
    geometry : Geometry
        What its actuator builds.

    Returns
    -------
    Mesh
    """
    if isinstance(geometry._shape, MeshedShape):
        return geometry._shape.mesh
    return mesh_with(geometry, job.mesh)
