"""Mesh of a job."""

from turgor.geometry import Geometry
from turgor.job.job import Job
from turgor.meshing.exchange.mesh_file import MeshedShape
from turgor.meshing.generate import mesh_with
from turgor.meshing.mesh import Mesh


def mesh_of(job: Job, geometry: Geometry) -> Mesh:
    """Mesh a geometry with the settings of a job.

    Parameters
    ----------
    job : Job
        Job with the settings of the mesh.
    geometry : Geometry
        Geometry of its actuator.

    Returns
    -------
    Mesh
    """
    if isinstance(geometry._shape, MeshedShape):
        return geometry._shape.mesh
    return mesh_with(geometry, job.mesh)
