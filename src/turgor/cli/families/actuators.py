"""Command ``turgor actuators``: the families, or one of them with its keys."""

from textwrap import indent, wrap
from typing import TYPE_CHECKING, Annotated

import typer

from turgor.cli.exits import errors_as_sentences
from turgor.cli.options import Debug, Json

if TYPE_CHECKING:
    from turgor.job.reference.tables import JobKey


def actuators_command(
    name: Annotated[
        str | None, typer.Argument(metavar="NAME", help="Family to show; lists all if left out.", show_default=False)
    ] = None,
    as_json: Json = False,
    debug: Debug = False,
) -> None:
    """List the actuator families, or show one: what it is, its source, and its keys with ranges and defaults."""
    with errors_as_sentences(debug, as_json) as answer:
        from turgor.cli.answers.file_results import families_result

        if name is None:
            list_families()
        else:
            _show(name)
        answer.give(lambda: families_result(name))


def list_families() -> None:
    """Print a line for each family."""
    from turgor.job.job import ACTUATORS

    width = max(map(len, ACTUATORS))
    for name, family in ACTUATORS.items():
        typer.echo(f"{name:{width}}  {summary(family)}")
    typer.echo(f"{'cad_file':{width}}  An actuator from a CAD file; `turgor inspect` shows what it holds.")
    typer.echo(f"{'mesh_file':{width}}  An actuator that is meshed already.")
    typer.echo(
        "'turgor actuators NAME' shows the keys of a family, 'turgor init NAME' writes a job, and so does "
        "'turgor init part.step' for a part of yours, from a CAD file or a mesh file."
    )


def summary(family: type) -> str:
    """Return the first sentence on a family."""
    from turgor.job.reference.meanings import markdown

    return markdown((family.__doc__ or "").splitlines()[0])


def _show(name: str) -> None:
    from inspect import getdoc

    from turgor.foundation.errors import unknown
    from turgor.job.job import ACTUATORS
    from turgor.job.reference.meanings import markdown
    from turgor.job.reference.sections import file_tables
    from turgor.job.reference.tables import family_table

    files = file_tables()
    if name not in ACTUATORS and name not in files:
        raise unknown("actuator family", name, [*ACTUATORS, *files])
    table = files[name] if name in files else family_table(name)
    words = table.words if name in files else markdown((getdoc(ACTUATORS[name]) or "").partition("Parameters\n")[0])
    typer.echo(f'{words.strip()}\n\nKeys of [actuator] with type = "{name}":')
    for key in table.keys:
        typer.echo(f"\n{key.name} = {key.default}\n{indent(_facts(key), '    ')}")


def _facts(key: "JobKey") -> str:
    """Write type, range and meaning of a key."""
    allowed = f"; allowed: {key.allowed}" if key.allowed else ""
    return "\n".join(wrap(f"{key.meaning} ({key.kind}{allowed})", width=110))
