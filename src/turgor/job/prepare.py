"""prepare: build, mesh and check a job without solving it."""

from collections.abc import Callable

from turgor.core.meshing.mesh import Mesh
from turgor.core.meshing.quality.checks import check_mesh
from turgor.core.model.model import Model
from turgor.core.results.measures.measures import check_measures, find_measure
from turgor.core.setups.with_setup import with_setup
from turgor.core.solvers.checks.early_findings import early_findings
from turgor.core.solvers.checks.supports import check_supports
from turgor.core.solvers.methods import may_be_free, method_of
from turgor.core.solvers.procedures.stages import Stages
from turgor.core.solvers.solution import Procedure
from turgor.core.solvers.stage_sequence import questions
from turgor.foundation.finding import Finding, by_weight
from turgor.job.job import Job
from turgor.job.meshes import mesh_of
from turgor.job.round_parts import meridian_would_do

Notify = Callable[[str], None]


def prepare(job: Job, notify: Notify | None = None) -> tuple[Model, tuple[Finding, ...]]:
    """Build, mesh and check a job without solving it.

    Parameters
    ----------
    job : Job
        The job.
    notify : callable, optional
        ``notify(text)``, called with each activity.

    Returns
    -------
    model : Model
        Model, ready to be solved.
    findings : tuple of Finding
        Findings of the checks.

    Raises
    ------
    TurgorError
        If the job cannot be meshed, held or measured.
    """
    say = notify or silent
    say("building the actuator")
    geometry = job.geometry()
    say("meshing")
    made = mesh_of(job, geometry)
    say(f"mesh: {len(made.cells)} cells, {made.unknown_count} unknowns")
    model = model_of(job, made)
    asked = with_setup(model, job.setup, say)
    first = _checked(asked, job.procedure)
    check_measures(first, [find_measure(name) for name in job.output.measures])
    if job.output.markers:
        from turgor.core.results.measures.markers import check_markers  # here: it loads the engine

        check_markers(made, job.output.markers)
    found = (*check_mesh(made), *meridian_would_do(model, geometry), *early_findings(asked, job.procedure))
    return asked, by_weight((*geometry.findings, *found))


def model_of(job: Job, mesh: Mesh) -> Model:
    """Return the model of a job on a mesh, without what its setup adds.

    Parameters
    ----------
    job : Job
    mesh : Mesh

    Returns
    -------
    Model
    """
    return Model(
        mesh,
        materials=job.materials,
        supports=job.all_supports,
        loads=job.all_loads,
        reinforcements=tuple(job.fibers.values()),
        contact=job.contact,
    )


def _checked(model: Model, procedure: Procedure) -> Model:
    """Raise an error for a model that cannot be solved; return it, or that of the first stage."""
    if not isinstance(procedure, Stages):
        check_supports(model, inertia=may_be_free(model, procedure))
        method_of(procedure).controlled(model, procedure)
        return model
    asked = questions(model, procedure)
    for question, stage in zip(asked, procedure.stages, strict=True):
        check_supports(question, inertia=may_be_free(question, stage.procedure))
    return asked[0]


def silent(_: str) -> None:
    """Ignore what is going on."""
