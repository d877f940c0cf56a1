"""Job files: read, run, exported, and solved on several meshes."""

from typing import TYPE_CHECKING

from turgor.foundation.lazy_names import public

if TYPE_CHECKING:
    from turgor.core.meshing.settings import MeshSettings as MeshSettings
    from turgor.core.meshing.sizing.default_size import default_size as default_size
    from turgor.core.results.convergence.study import Convergence as Convergence
    from turgor.job.convergence import convergence as convergence
    from turgor.job.export import Exported as Exported
    from turgor.job.export import InpOptions as InpOptions
    from turgor.job.export import export_job as export_job
    from turgor.job.job import ACTUATORS as ACTUATORS
    from turgor.job.job import Job as Job
    from turgor.job.prepare import prepare as prepare
    from turgor.job.read import read_job as read_job
    from turgor.job.reference.sections import section_tables as section_tables
    from turgor.job.reference.starters import example_job as example_job
    from turgor.job.reference.starters import starter as starter
    from turgor.job.reference.tables import JobKey as JobKey
    from turgor.job.reference.tables import JobTable as JobTable
    from turgor.job.reference.tables import family_table as family_table
    from turgor.job.run import run_job as run_job
else:
    __getattr__, __dir__, __all__ = public(__file__, globals())
