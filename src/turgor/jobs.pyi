"""Job files: read, run, exported, and solved on several meshes."""

from turgor.job.convergence import convergence as convergence
from turgor.job.export import export_job as export_job
from turgor.job.job import Job as Job
from turgor.job.read import read_job as read_job
from turgor.job.run import run_job as run_job
from turgor.meshing.settings import MeshSettings as MeshSettings
from turgor.meshing.sizing.default_size import default_size as default_size
from turgor.results.convergence.study import Convergence as Convergence
