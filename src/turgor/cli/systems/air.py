"""Command ``turgor air``: supplies, valves, tubes and chambers over time."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from turgor.cli.exits import DONE, errors_as_sentences
from turgor.cli.options import Changes, Debug, Json, output_option

if TYPE_CHECKING:
    from turgor.systems.air.history import History

#: What it writes.
FILES = ("air.csv", "air.png")


def air_command(
    file: Annotated[Path, typer.Argument(metavar="FILE", help="File of a network, in TOML.", show_default=False)],
    output: Annotated[Path | None, output_option("Folder of table and plot; by default NAME-air.")] = None,
    force: Annotated[bool, typer.Option("--force", help="Replace what the folder holds.")] = False,
    changes: Changes = None,
    as_json: Json = False,
    debug: Debug = False,
) -> None:
    """Follow a network of supplies, valves, tubes and chambers over time, and say how fast an actuator is."""
    with errors_as_sentences(debug, as_json) as answer:
        import numpy as np

        from turgor.cli.answers.air import air_result
        from turgor.job.output.folder import claimed
        from turgor.job.text.overrides import parse_changes
        from turgor.systems.air.file.read import read_air
        from turgor.systems.air.performance import performance
        from turgor.systems.air.simulate import simulate

        given = read_air(file, parse_changes(changes or ()))
        times = np.linspace(0.0, given.duration, given.samples + 1)
        folder = output if output is not None else Path(f"{given.name}-air")
        with claimed(folder, force, files=FILES) as place:
            run = simulate(given.network, given.duration, times=times)
            result = None if given.performance is None else performance(given.network, **given.performance)
            _write(place, given.name, run)
        for node in given.network.nodes:
            typer.echo(f"{node}: {run.pressure(node)[-1] / 1e3:.5g} kPa at {given.duration:g} s")
        if result is not None:
            typer.echo(result.text)
        answer.give(lambda: air_result(given.name, run, result, folder))
        typer.echo(f"Table and plot in {folder}.")
        raise typer.Exit(DONE)


def _write(folder: Path, name: str, run: "History") -> None:
    from turgor.job.output.manifest import list_files
    from turgor.views.plots.systems.air_plot import write_air_plot

    list_files(folder, FILES)
    response = run.response(name)
    response.to_csv(folder / FILES[0])
    write_air_plot(folder / FILES[1], response, title=f"{name}: {run.equations.around.fluid.name}")
