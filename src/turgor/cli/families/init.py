"""Command ``turgor init``: a commented job for an actuator family."""

from pathlib import Path
from typing import Annotated

import typer

from turgor.cli.exits import errors_as_sentences
from turgor.cli.options import Debug, output_option
from turgor.errors import TurgorError


def init_command(
    family: Annotated[
        str | None, typer.Argument(metavar="FAMILY", help="Actuator family; lists all if left out.", show_default=False)
    ] = None,
    output: Annotated[Path | None, output_option("The file; by default FAMILY.toml here.")] = None,
    force: Annotated[bool, typer.Option("--force", help="Replace the file if it exists.")] = False,
    debug: Debug = False,
) -> None:
    """Write a commented job for an actuator family, ready to run, with every key; without FAMILY, list the families."""
    with errors_as_sentences(debug):
        from turgor.job.reference.starters import starter

        if family is None:
            from turgor.cli.families.actuators import list_families

            list_families()
            return
        text = starter(family)
        file = output if output is not None else Path(f"{family}.toml")
        if file.exists() and not force:
            raise TurgorError(f"'{file}' exists; name another file with --output, or replace it with --force.")
        file.write_text(text, encoding="utf-8")
        typer.echo(f"Job in {file}. Look at it with 'turgor check {file}', run it with 'turgor run {file}'.")
