"""Command ``turgor robot``: arms of actuators in series, and grippers around an object."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from turgor.cli.exits import DONE, errors_as_sentences
from turgor.cli.options import Changes, Debug, Json, output_option

if TYPE_CHECKING:
    from turgor.systems.robots.mechanisms.mechanism import ArmState, Mechanism

#: What it writes.
FILES = ("robot.png", "robot.xml")


def robot_command(
    file: Annotated[Path, typer.Argument(metavar="FILE", help="File of a mechanism, in TOML.", show_default=False)],
    output: Annotated[Path | None, output_option("Folder of picture and MJCF; by default NAME-robot.")] = None,
    force: Annotated[bool, typer.Option("--force", help="Replace what the folder holds.")] = False,
    changes: Changes = None,
    as_json: Json = False,
    debug: Debug = False,
) -> None:
    """Find how arms of reduced models stand at their pressures, and how they press on an object."""
    with errors_as_sentences(debug, as_json) as answer:
        from turgor.cli.answers.systems import robot_result
        from turgor.job.output.folder import claimed
        from turgor.job.text.overrides import parse_changes
        from turgor.systems.robots.mechanisms.mechanism_file import read_mechanism

        given = read_mechanism(file, parse_changes(changes or ()))
        folder = output if output is not None else Path(f"{given.name}-robot")
        with claimed(folder, force, files=FILES) as place:
            states = given.mechanism.solve()
            _write(place, given.name, given.mechanism, states)
        for name, text in given.errors.items():
            typer.echo(f"{name}: {text}.")
        for state in states.values():
            place_text = ", ".join(f"{value:z.2f}" for value in state.tip * 1e3)
            force_text = ", ".join(f"{value:z.4f}" for value in state.force)
            pushes = f"; force on the object ({force_text}) N" if given.mechanism.object is not None else ""
            typer.echo(f"{state.name}: tip at ({place_text}) mm{pushes}")
        answer.give(lambda: robot_result(given.name, states, given.errors, folder))
        typer.echo(f"Picture and MJCF in {folder}.")
        raise typer.Exit(DONE)


def _write(folder: Path, name: str, mechanism: "Mechanism", states: "dict[str, ArmState]") -> None:
    from turgor.job.output.manifest import list_files
    from turgor.systems.robots.chains.mjcf import write_mechanism
    from turgor.views.plots.systems.mechanism_plot import write_mechanism_plot

    list_files(folder, FILES)
    lines = {arm: state.line for arm, state in states.items()}
    radii = {arm: state.chain.capsules[:, 6] for arm, state in states.items()}
    write_mechanism_plot(folder / FILES[0], lines, radii, mechanism.object, title=name)
    write_mechanism({arm: state.chain for arm, state in states.items()}, mechanism.object, folder / FILES[1], name=name)
