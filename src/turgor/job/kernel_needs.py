"""Compile the kernels of a job while its mesh is made: which they are is known before."""

from turgor.core.engine.warmup.needs import Needs, in_stretches
from turgor.core.materials.material import Material
from turgor.core.meshing.cells import cell_type
from turgor.core.meshing.default_settings import chosen_cells
from turgor.core.meshing.exchange.mesh_file import MeshedShape
from turgor.core.model.sheets import Sheet
from turgor.job.job import Job


def kernel_needs(job: Job) -> Needs:
    """Return which kernels the model of a job will need.

    Whether walls can meet shows in the mesh, so they count as if they could.
    """
    geometry = job.geometry()
    if isinstance(geometry.shape, MeshedShape):
        kind = geometry.shape.mesh.cell_type
    else:
        kind = cell_type(10 if chosen_cells(geometry, job.mesh) == "tetrahedra" else 27)
    may_touch = job.contact.self_contact is not None or job.contact.obstacles or job.setup is not None
    materials = job.materials.values()
    return Needs(
        nodes=kind.nodes,
        sides=kind.side.nodes if may_touch else 0,
        stretches=in_stretches(each for each in materials if isinstance(each, Material)),
        sheets=any(isinstance(each, Sheet) for each in materials),
    )
