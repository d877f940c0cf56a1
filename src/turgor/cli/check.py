"""Command ``turgor check``: read, build, mesh and check a job without solving it."""

import typer

from turgor.cli.exits import DONE, FOUND_ERROR, errors_as_sentences
from turgor.cli.options import Changes, Debug, JobFile, Json, requested_job


def check_command(job: JobFile, changes: Changes = None, as_json: Json = False, debug: Debug = False) -> None:
    """Read, build, mesh and check a job without solving it."""
    with errors_as_sentences(debug, as_json) as answer:
        from turgor.accuracy.adaptivity.findings import ONLY_WITH_ERROR
        from turgor.cli.answers.results import CheckResult
        from turgor.foundation.finding import Severity
        from turgor.foundation.processors import processors
        from turgor.job.expected import expected_of
        from turgor.job.meshes import save_mesh_of
        from turgor.job.prepare import prepare
        from turgor.views.report.describe import contact
        from turgor.views.report.describe_procedure import procedure

        parsed = requested_job(job, changes)
        model, findings = prepare(parsed)
        save_mesh_of(parsed)
        mesh = model.mesh
        typer.echo(f"{job} is a valid job: {mesh.name}; {len(mesh.cells)} cells, {mesh.unknown_count} unknowns.")
        for sentence in contact(model):
            typer.echo(sentence)
        stages = dict(procedure(parsed.procedure)) if parsed.procedure.stages else {}
        for name, acts in stages.items():
            typer.echo(f"Stage '{name}': {acts}.")
        expected = expected_of(parsed, model, parsed.threads or processors())
        typer.echo(f"Expected: {expected}.")
        answer.give(
            lambda: CheckResult(
                name=parsed.name,
                mesh=mesh.name,
                cells=len(mesh.cells),
                unknowns=mesh.unknown_count,
                expected_s=expected.seconds,
                expected_bytes=expected.memory,
                contact=contact(model),
                stages=stages,
            )
        )
        answer.warn([each for each in findings if each.code != ONLY_WITH_ERROR])
        raise typer.Exit(FOUND_ERROR if any(each.severity is Severity.ERROR for each in findings) else DONE)
