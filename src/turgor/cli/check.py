"""Command ``turgor check``: read, build, mesh and check a job without solving it."""

import typer

from turgor.cli.exits import DONE, FOUND_ERROR, errors_as_sentences, warn
from turgor.cli.options import Changes, Debug, JobFile, asked_job


def check_command(job: JobFile, changes: Changes = None, debug: Debug = False) -> None:
    """Read, build, mesh and check a job without solving it."""
    with errors_as_sentences(debug):
        from turgor.adaptivity.findings import ONLY_WITH_ERROR
        from turgor.finding import Severity
        from turgor.job.run import prepare
        from turgor.results.report.describe import contact
        from turgor.results.report.describe_procedure import procedure
        from turgor.solvers.procedures.stages import Stages

        asked = asked_job(job, changes)
        model, findings = prepare(asked)
        mesh = model.mesh
        typer.echo(f"{job} is a valid job: {mesh.name}; {len(mesh.cells)} cells, {mesh.unknown_count} unknowns.")
        for sentence in contact(model):
            typer.echo(sentence)
        if isinstance(asked.procedure, Stages):
            for name, acts in procedure(asked.procedure):
                typer.echo(f"Stage '{name}': {acts}.")
        warn([found for found in findings if found.code != ONLY_WITH_ERROR])
        raise typer.Exit(FOUND_ERROR if any(found.severity is Severity.ERROR for found in findings) else DONE)
