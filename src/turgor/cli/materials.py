"""Commands ``turgor materials list | show | plot``: thin calls of public functions."""

from pathlib import Path
from typing import Annotated

import typer

from turgor.cli.exits import errors_as_sentences
from turgor.cli.options import Debug, Json, output_option

materials_app = typer.Typer(
    rich_markup_mode=None,
    help="List, show and plot the materials of the library, or of a file of your own that ends in .toml.",
)

Name = Annotated[str, typer.Argument(metavar="NAME", help="Material, or a TOML file of your own.", show_default=False)]
RecordName = Annotated[str | None, typer.Option(help="One record; by default all.", show_default=False)]


@materials_app.callback(invoke_without_command=True)
def _materials(context: typer.Context) -> None:
    """List the materials where no other command is given."""
    if context.invoked_subcommand is None:
        _list()


@materials_app.command("list")
def _list(as_json: Json = False, debug: Debug = False) -> None:
    """List the library materials and their records, with the codes of their warnings."""
    with errors_as_sentences(debug, as_json) as answer:
        from turgor.cli.answers.file_results import materials_result
        from turgor.core.materials.library.doubts import find_doubts
        from turgor.core.materials.library.record_files import library, records
        from turgor.foundation.finding import Severity

        lines = []
        for name in library():
            lines.append(name)
            for record in records(name):
                codes = sorted({doubt.code for doubt in find_doubts(record) if doubt.severity is Severity.WARNING})
                marks = f" [{', '.join(codes)}]" if codes else ""
                lines.append(f"  {record.name}: {record.law}, {record.printed}; {record.source}{marks}")
        typer.echo("\n".join(lines))
        answer.give(lambda: materials_result(library()))


@materials_app.command("show")
def _show(name: Name, record: RecordName = None, as_json: Json = False, debug: Debug = False) -> None:
    """Show a material: printed constants, converted constants, sources and doubts."""
    with errors_as_sentences(debug, as_json) as answer:
        from turgor.cli.answers.file_results import materials_result
        from turgor.core.materials.library.record_text import describe_material

        typer.echo(describe_material(name, record))
        answer.give(lambda: materials_result([name], record))


@materials_app.command("plot")
def _plot(
    name: Name,
    record: RecordName = None,
    against: Annotated[
        Path | None, typer.Option(help="A measured test to compare with, such as a CSV file.", show_default=False)
    ] = None,
    mode: Annotated[
        str | None,
        typer.Option(help="uniaxial, equibiaxial or planar, where the test does not say.", show_default=False),
    ] = None,
    stress: Annotated[
        str | None, typer.Option(help="nominal or cauchy, where the test does not say.", show_default=False)
    ] = None,
    within: Annotated[
        str | None,
        typer.Option("--range", metavar="LOW:HIGH", help="Stretches to show; by default up to 4.", show_default=False),
    ] = None,
    output: Annotated[Path | None, output_option("PNG or SVG; by default NAME.png here.")] = None,
    debug: Debug = False,
) -> None:
    """Plot the stress-stretch curves of all records of a material, against a measured test if one is given."""
    with errors_as_sentences(debug):
        from turgor.core.materials.library.record_files import records
        from turgor.views.plots.materials import write_material_plot

        records(name)  # a wrong name is reported before heavy imports
        path = output if output is not None else Path(f"{Path(name).stem}.png")
        tests = []
        if against is not None:
            from turgor.core.materials.experiments.read_tests import read_test

            tests = [read_test(against, mode=mode, stress_measure=stress)]
        stretch = None if within is None else _range(within)
        write_material_plot(path, name, record=record, tests=tests, stretch=stretch)
        typer.echo(f"Plot in {path}.")


def _range(text: str) -> tuple[float, float]:
    """Read ``"1:4"`` as the smallest and the largest stretch."""
    from turgor.foundation.errors import TurgorError

    try:
        low, high = (float(part) for part in text.split(":"))
    except ValueError:
        raise TurgorError(f"--range is '{text}'; write the smallest and the largest stretch, such as 1:4.") from None
    return low, high
