"""Command ``turgor import``: a deck of Abaqus or CalculiX as a job, with a table of what was understood."""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from turgor.cli.exits import errors_as_sentences
from turgor.cli.options import Debug, Json, output_option

if TYPE_CHECKING:
    from turgor.job.decks.account import DeckRow


def import_command(
    deck: Annotated[Path, typer.Argument(metavar="DECK", help="An .inp or .feb file.", show_default=False)],
    units: Annotated[
        str | None,
        typer.Option(
            help="Units of length, force and stress of its numbers; those that it states, or 'mm, N, MPa', by default.",
            show_default=False,
        ),
    ] = None,
    output: Annotated[Path | None, output_option("Folder of the job; by default this one.")] = None,
    partial: Annotated[
        bool, typer.Option("--partial", help="Write a job without what it cannot express, which is another model.")
    ] = False,
    force: Annotated[bool, typer.Option("--force", help="Replace files that are there already.")] = False,
    as_json: Json = False,
    debug: Debug = False,
) -> None:
    """Make a job of a deck of Abaqus, CalculiX or FEBio, and list what was understood as what, and what was not."""
    with errors_as_sentences(debug, as_json) as answer:
        from turgor.cli.answers.file_results import ImportResult
        from turgor.job.decks.febio.reading import stated_units
        from turgor.job.decks.importing import import_deck
        from turgor.job.decks.units import USUAL

        read = import_deck(deck, units=units, partial=partial)
        file = read.write(Path() if output is None else output, force=force)
        answer.give(lambda: ImportResult(job=file, rows=read.rows))
        for line in _lines(read.rows):
            typer.echo(line)
        if units is None and stated_units(deck) is None:
            typer.echo(
                f"A deck states no units; its numbers were taken to be in {USUAL} and seconds. --units says more."
            )
        typer.echo(f"Job in {file}. Look at it with 'turgor check {file}', run it with 'turgor run {file}'.")


def _lines(rows: Sequence["DeckRow"]) -> list[str]:
    """A line for each keyword: where it stands, what it is, what became of it."""
    places = [f"{row.file.name}:{row.line}" for row in rows]
    wide = max(map(len, places), default=0)
    long = min(40, max((len(row.title) for row in rows), default=0))
    return [
        f"{place:{wide}}  {row.title:{long}}  {row.verdict:10}  {row.text}"
        for place, row in zip(places, rows, strict=True)
    ]
