"""prepare: build, mesh and check a job without solving it."""

from collections.abc import Callable

from turgor.core.meshing.mesh import Mesh
from turgor.core.meshing.quality.checks import check_mesh
from turgor.core.model.model import Model
from turgor.core.results.measures.measures import check_measures, find_measure
from turgor.core.setups.with_setup import with_setup
from turgor.core.solvers.checks.early_findings import check_before_solve
from turgor.core.solvers.stage_sequence import questions
from turgor.foundation.errors import TurgorError
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
        If the job cannot be meshed, supported or measured.
    """
    say = notify or silent
    say("building the actuator")
    geometry = job.geometry()
    say("meshing")
    mesh = mesh_of(job, geometry)
    say(f"mesh: {len(mesh.cells)} cells, {mesh.unknown_count} unknowns")
    model = model_of(job, mesh)
    model_to_solve = with_setup(model, job.setup, say)
    early = check_before_solve(model_to_solve, job.procedure)
    measures = [find_measure(name) for name in job.output.measures]
    for each in measures:
        if each.moving and not all(part.has_energies for part in job.procedure.parts()):
            raise TurgorError(f"output.measures: '{each.name}' needs a motion; take the procedure dynamic.")
    check_measures(questions(model_to_solve, job.procedure)[0], measures)
    if job.output.markers:
        from turgor.core.results.measures.markers import check_markers  # here: it loads the engine

        check_markers(mesh, job.output.markers)
    findings = (*check_mesh(mesh), *meridian_would_do(model, geometry), *early)
    return model_to_solve, by_weight((*geometry.findings, *findings))


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
    model = Model(
        mesh,
        materials=job.materials,
        supports=job.all_supports,
        loads=job.all_loads,
        reinforcements=tuple(job.fibers.values()),
        contact=job.contact,
        bonds=tuple(job.bonds.values()),
    )
    if not job.imperfection:
        return model
    from turgor.core.solvers.buckling.imperfection import imperfect  # here: few jobs need it

    try:
        return imperfect(model, job.imperfection)
    except TurgorError as error:
        raise TurgorError(f"mesh.imperfection: {error}") from error


def silent(_: str) -> None:
    """Ignore a notice."""
