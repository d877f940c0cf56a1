"""Uncertainty of jobs: inputs with a spread, and the propagation to the response of the job."""

from dataclasses import dataclass

from turgor.studies.runs.evaluations import Evaluations
from turgor.studies.runs.jobs.job_function import JobFunction
from turgor.studies.uncertainty.band import Uncertainty
from turgor.studies.uncertainty.propagate import propagate
from turgor.studies.uncertainty.spread import Input


@dataclass(frozen=True, slots=True, kw_only=True)
class UncertaintyPlan:
    """What an uncertainty analysis of a job propagates.

    Parameters
    ----------
    inputs : tuple of Spread or Alternatives
    method : str
    at : float or None [Pa]
        Pressure at which values are reported.
    mesh_error : bool
        Whether the mesh error of the nominal run is estimated.
    """

    inputs: tuple[Input, ...]
    method: str = "linear"
    at: float | None = None
    mesh_error: bool = True


def propagate_job(plan: UncertaintyPlan, job: JobFunction, evaluations: Evaluations) -> Uncertainty:
    """Propagate spreads to the response of a job.

    Parameters
    ----------
    plan : UncertaintyPlan
    job : JobFunction
    evaluations : Evaluations

    Returns
    -------
    Uncertainty
    """
    computation = job.computation(mesh_error="nominal" if plan.mesh_error else "none")
    return propagate(computation, plan.inputs, method=plan.method, evaluations=evaluations)
