"""Mesh of a job, and its settings at another size."""

from dataclasses import dataclass, field, replace
from functools import lru_cache

from turgor.core.geometry.geometry import Geometry
from turgor.core.meshing.exchange.mesh_file import MeshedShape
from turgor.core.meshing.mesh import Mesh
from turgor.core.meshing.settings import MeshSettings
from turgor.job.family_cache import is_cached, mesh_on_disk, save_family
from turgor.job.job import Actuator, Job


def mesh_of(job: Job, geometry: Geometry) -> Mesh:
    """Mesh a geometry with the settings of a job.

    Runs of one process whose actuators and settings are equal share a mesh, because a sweep of constants or a
    calibration would make the same one again and again. What `save_mesh_of` has saved is found by other processes, too.

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
    if not is_cached(job.actuator):  # a file, whose content may change
        return new_mesh_of(job, geometry)
    return _mesh_of_family(_Key(job.actuator, job.mesh, geometry))


def save_mesh_of(job: Job) -> None:
    """Save geometry and mesh of a job on disk for the next run, if its actuator is of a family.

    Runs and checks do so, but no studies: their designs are many, rarely return, and would push out the others.

    Parameters
    ----------
    job : Job
    """
    if is_cached(job.actuator):
        geometry = job.geometry()
        save_family(job.actuator, geometry, job.mesh, mesh_of(job, geometry))


def new_mesh_of(job: Job, geometry: Geometry) -> Mesh:
    """Mesh a geometry with the settings of a job, even where there is such a mesh.

    Parameters
    ----------
    job : Job
    geometry : Geometry

    Returns
    -------
    Mesh
    """
    if isinstance(geometry.shape, MeshedShape):
        return geometry.shape.mesh
    return _new_mesh(geometry, job.mesh)


@dataclass(frozen=True, slots=True)
class _Key:
    """An actuator that its dimensions describe and settings; the geometry follows from the dimensions."""

    actuator: Actuator
    settings: MeshSettings
    geometry: Geometry = field(compare=False)

    def __hash__(self) -> int:
        return hash((type(self.actuator), self.settings.size))  # settings hold a mapping, which has no hash


@lru_cache(maxsize=2)
def _mesh_of_family(key: _Key) -> Mesh:
    on_disk = mesh_on_disk(key.actuator, key.settings)
    return _new_mesh(key.geometry, key.settings) if on_disk is None else on_disk


def _new_mesh(geometry: Geometry, settings: MeshSettings) -> Mesh:
    from turgor.core.meshing.generate import mesh_with  # here: it loads all ways to mesh, and a mesh may be on disk

    return mesh_with(geometry, settings)


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
