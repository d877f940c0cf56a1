"""Command ``turgor modes``: natural frequencies of the actuator of a job, at rest or under its full load."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from turgor.cli.exits import DONE, errors_as_sentences
from turgor.cli.options import Changes, Debug, JobFile, Json, output_option, requested_job
from turgor.foundation.errors import TurgorError

if TYPE_CHECKING:
    from turgor.core.solvers.dynamics.modes import Modes


def modes_command(
    job: JobFile,
    count: Annotated[int, typer.Option(help="Number of modes, from the lowest.")] = 6,
    loaded: Annotated[bool, typer.Option("--loaded", help="About the state under full load, not at rest.")] = False,
    output: Annotated[
        Path | None,
        output_option("Write the mode shapes for ParaView into this new folder."),
    ] = None,
    changes: Changes = None,
    as_json: Json = False,
    debug: Debug = False,
) -> None:
    """List natural frequencies; every material of the job needs a density."""
    with errors_as_sentences(debug, as_json) as answer:
        from turgor.cli.answers.results import modes_result

        if output is not None and output.exists():
            raise TurgorError(f"--output is '{output}', which exists; name a new folder.")
        from turgor.core.solvers.dynamics.modes import natural_frequencies
        from turgor.core.solvers.solve import solve
        from turgor.job.prepare import prepare

        parsed = requested_job(job, changes)
        model, findings = prepare(parsed)
        state = solve(model, parsed.procedure, progress=False).states[-1] if loaded else None
        modes = natural_frequencies(model if state is None else state.model, state, count)
        _show(modes)
        answer.give(lambda: modes_result(modes))
        if output is not None:
            from turgor.core.results.files.modes_vtu import write_modes

            output.mkdir(parents=True)
            typer.echo(f"Mode shapes in {write_modes(output, modes)}.")
        answer.warn(findings)
        raise typer.Exit(DONE)


def _show(modes: "Modes") -> None:
    typer.echo("mode  frequency [Hz]  modal mass [g]")
    for number, (frequency, mass) in enumerate(zip(modes.frequencies, modes.modal_mass, strict=True), start=1):
        typer.echo(f"{number:4d}  {frequency:14.5g}  {mass * 1e3:14.4g}")
    typer.echo(modes.message)
    if modes.model.mesh.symmetry_factor > 1:
        kind = "the same in all sectors" if modes.model.mesh.wedge else "symmetric about its mirror planes"
        typer.echo(f"Only a part is modeled: these are the modes that are {kind}.")
