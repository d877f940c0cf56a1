"""Command ``turgor init``: a commented job for an actuator family, or for a part from a file."""

from pathlib import Path
from typing import Annotated

import typer

from turgor.cli.exits import errors_as_sentences
from turgor.cli.options import Debug, output_option
from turgor.foundation.errors import TurgorError


def init_command(
    family: Annotated[
        str | None,
        typer.Argument(
            metavar="FAMILY",
            help="Actuator family, or a CAD or mesh file; lists the families if left out.",
            show_default=False,
        ),
    ] = None,
    output: Annotated[Path | None, output_option("The file; by default FAMILY.toml here.")] = None,
    unit: Annotated[
        str | None, typer.Option(help="Unit of the numbers in a CAD or mesh file, such as mm.", show_default=False)
    ] = None,
    force: Annotated[bool, typer.Option("--force", help="Replace the file if it exists.")] = False,
    debug: Debug = False,
) -> None:
    """Write a commented job for an actuator family or a part, with every key; without FAMILY, list the families."""
    with errors_as_sentences(debug):
        if family is None:
            from turgor.cli.families.actuators import list_families

            list_families()
            return
        part = _checked(family)
        file = output if output is not None else Path(f"{part.stem}.toml")
        if file.exists() and not force:
            raise TurgorError(f"'{file}' exists; name another file with --output, or replace it with --force.")
        file.write_text(_job(family, file.parent, unit), encoding="utf-8")
        typer.echo(f"Job in {file}. Look at it with 'turgor check {file}', run it with 'turgor run {file}'.")


def _checked(family: str) -> Path:
    """Refuse what is neither a family nor a file that may hold a part."""
    from turgor.foundation.errors import unknown
    from turgor.job.job import ACTUATORS
    from turgor.job.reference.part_starters import PART_ENDINGS, is_part
    from turgor.job.tables.cad import CAD_FILE
    from turgor.job.tables.mesh_files import MESH_FILE

    if family in (CAD_FILE, MESH_FILE):
        example = "part.step" if family == CAD_FILE else "part.msh"
        raise TurgorError(f"{family} takes its shape from a file; name that file, as in 'turgor init {example}'.")
    if not is_part(family) and Path(family).is_file():
        raise TurgorError(f"'{family}' is no CAD file and no mesh file; allowed are {', '.join(PART_ENDINGS)}.")
    if not is_part(family) and family not in ACTUATORS:
        raise unknown("actuator family", family, ACTUATORS)
    return Path(family)


def _job(family: str, folder: Path, unit: str | None) -> str:
    """Write the job of a family, or of a part from a file."""
    from turgor.job.reference.part_starters import is_part, part_starter
    from turgor.job.reference.starters import starter

    return part_starter(Path(family), folder, unit) if is_part(family) else starter(family)
