"""Mesh of a job, and its settings at another size."""

from dataclasses import replace

from turgor.geometry import Geometry
from turgor.job.job import Job
from turgor.meshing.exchange.mesh_file import MeshedShape
from turgor.meshing.generate import mesh_with
from turgor.meshing.mesh import Mesh
from turgor.meshing.settings import MeshSettings


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


def settings_at(job: Job, size: float) -> MeshSettings:
    """Settings of the mesh of a job at another size: the sizes of faces change alike.

    Parameters
    ----------
    job : Job
    size : float [m]

    Returns
    -------
    MeshSettings
    """
    share = size / job.mesh_size
    faces = {name: length * share for name, length in job.mesh.face_sizes.items()}
    limit = job.mesh.ignore_features_below
    limit = None if limit is None else min(limit, size)  # no mesh allows more than its size
    return replace(job.mesh_settings, size=size, face_sizes=faces, ignore_features_below=limit)
