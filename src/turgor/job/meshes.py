"""mesh_of: the mesh that a job asks for."""

from turgor.geometry import Geometry
from turgor.job.job import Job
from turgor.meshing.exchange.mesh_file import MeshedShape
from turgor.meshing.generate import mesh
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
    return mesh(
        geometry,
        size=job.mesh_size,
        grading=job.mesh_grading,
        face_sizes=job.mesh_face_sizes,
        wall_cells=job.mesh_wall_cells,
        cells=job.mesh_cells,
    )
