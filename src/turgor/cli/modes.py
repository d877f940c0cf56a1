"""Commands ``turgor modes`` and ``turgor buckling``: how an actuator vibrates, and at what loads it buckles."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from turgor.cli.exits import DONE, errors_as_sentences
from turgor.cli.options import Changes, Debug, JobFile, Json, job_without_stages, output_option, requested_job
from turgor.foundation.errors import TurgorError

if TYPE_CHECKING:
    from turgor.core.model.model import Model
    from turgor.core.solvers.buckling.buckling_modes import BucklingModes
    from turgor.core.solvers.dynamics.modes import Modes
    from turgor.core.solvers.solution import State

Shapes = Annotated[Path | None, output_option("Write the mode shapes for ParaView into this new folder.")]


def modes_command(
    job: JobFile,
    count: Annotated[int, typer.Option(help="Number of modes, from the lowest.")] = 6,
    loaded: Annotated[bool, typer.Option("--loaded", help="About the state under full load, not at rest.")] = False,
    output: Shapes = None,
    changes: Changes = None,
    as_json: Json = False,
    debug: Debug = False,
) -> None:
    """List natural frequencies; every material of the job needs a density."""
    with errors_as_sentences(debug, as_json) as answer:
        from turgor.cli.answers.results import modes_result

        _check_new(output)
        from turgor.core.solvers.dynamics.modes import natural_frequencies
        from turgor.core.solvers.solve import solve
        from turgor.job.prepare import prepare

        parsed = requested_job(job, changes)
        model, findings = prepare(parsed)
        state = solve(model, parsed.procedure, progress=False).states[-1] if loaded else None
        modes = natural_frequencies(model if state is None else state.model, state, count)
        _show(modes)
        answer.give(lambda: modes_result(modes))
        _write(output, modes)
        answer.warn(findings)
        raise typer.Exit(DONE)


def buckling_command(
    job: JobFile,
    count: Annotated[int, typer.Option(help="Number of modes, from the lowest load.")] = 4,
    at: Annotated[
        float, typer.Option(help="Load factor of the state that it starts from, below the lowest; 0 is at rest.")
    ] = 0.0,
    output: Shapes = None,
    changes: Changes = None,
    as_json: Json = False,
    debug: Debug = False,
) -> None:
    """List the loads at which the actuator buckles, all loads growing in proportion."""
    with errors_as_sentences(debug, as_json) as answer:
        from turgor.cli.answers.results import buckling_result

        _check_new(output)
        if not 0 <= at < 1:
            raise TurgorError(f"--at is {at:g}; allowed is 0 up to less than 1, a share of the full load.")
        from turgor.core.model.continued_model import starting_loads
        from turgor.core.solvers.buckling.buckling_modes import buckling_modes
        from turgor.job.prepare import prepare

        model, findings = prepare(job_without_stages(job, changes, "a buckling load"))
        modes = buckling_modes(model, _state_at(model, at) if at or starting_loads(model) else None, count)
        typer.echo("mode  load factor [-]")
        for number, factor in enumerate(modes.load_factors, start=1):
            typer.echo(f"{number:4d}  {factor:15.5g}")
        typer.echo(modes.message)
        _say_symmetry(modes)
        answer.give(lambda: buckling_result(modes))
        _write(output, modes)
        answer.warn(findings)
        raise typer.Exit(DONE)


def _state_at(model: "Model", load_factor: float) -> "State":
    from turgor.core.solvers.procedures.static import Static
    from turgor.core.solvers.solve import solve

    def enough(state: "State") -> str | None:
        return "the load factor of --at" if state.load_factor >= load_factor * (1 - 1e-9) else None

    steps = Static(at=(load_factor,)) if load_factor else Static()
    solution = solve(model, steps, stop=enough, throw=False, progress=False)
    if not load_factor:
        return solution.states[0]  # the equilibrium of what is there from the start
    if enough(solution.states[-1]) is None:
        raise TurgorError(f"--at is {load_factor:g}, which was not reached. {solution.message}")
    return solution.states[-1]


def _check_new(output: Path | None) -> None:
    if output is not None and output.exists():
        raise TurgorError(f"--output is '{output}', which exists; name a new folder.")


def _write(output: Path | None, modes: "Modes | BucklingModes") -> None:
    if output is None:
        return
    from turgor.core.results.files.modes_vtu import write_modes

    output.mkdir(parents=True)
    typer.echo(f"Mode shapes in {write_modes(output, modes)}.")


def _show(modes: "Modes") -> None:
    typer.echo("mode  frequency [Hz]  modal mass [g]")
    for number, (frequency, mass) in enumerate(zip(modes.frequencies, modes.modal_mass, strict=True), start=1):
        typer.echo(f"{number:4d}  {frequency:14.5g}  {mass * 1e3:14.4g}")
    typer.echo(modes.message)
    _say_symmetry(modes)


def _say_symmetry(modes: "Modes | BucklingModes") -> None:
    if modes.model.mesh.symmetry_factor > 1:
        kind = "the same in all sectors" if modes.model.mesh.wedge else "symmetric about its mirror planes"
        typer.echo(f"Only a part is modeled: these are the modes that are {kind}.")
