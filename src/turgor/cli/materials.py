"""Commands ``turgor materials list | choose | show | plot``: thin calls of public functions."""

from collections.abc import Sequence
from math import inf
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from turgor.cli.exits import errors_as_sentences
from turgor.cli.options import Debug, Json, option_quantity, output_option

if TYPE_CHECKING:
    from turgor.core.materials.library.choose import MaterialRow

materials_app = typer.Typer(
    rich_markup_mode=None,
    help="List, choose, show and plot the materials of the library, or of a file of your own that ends in .toml.",
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
    """List the library materials, softest first: hardness, modulus, tested range, ultimate stretch, record to take."""
    with errors_as_sentences(debug, as_json) as answer:
        from turgor.cli.answers.file_results import materials_result
        from turgor.core.materials.library.choose import material_rows
        from turgor.core.materials.library.record import KINDS
        from turgor.core.materials.library.record_files import library

        head = ("material", "kind", "Shore", "E", "of sets", "stretch", "breaks at", "sets", "record to take")
        rows = [
            (
                each.name,
                each.kind,
                each.hardness or "–",
                _modulus(each.modulus),
                _spread(each.spread),
                _stretches(each.stretch_range),
                _stretch(each.ultimate),
                str(each.records),
                each.record or "–",
            )
            for each in sorted(material_rows(), key=lambda row: (KINDS.index(row.kind), row.modulus or inf))
        ]
        typer.echo(_aligned([head, *rows]))
        typer.echo("E is the initial Young's modulus of the record to take, and of all sets without a warning.")
        typer.echo("'turgor materials show NAME' prints sets, sources, caveats; 'choose' finds a rubber by a modulus.")
        answer.give(lambda: materials_result(library()))


@materials_app.command("choose")
def _choose(
    modulus: Annotated[
        str | None, typer.Option(help="Stress over strain in tension, such as '100 kPa'.", show_default=False)
    ] = None,
    stretch: Annotated[float, typer.Option(help="Stretch at which it is wanted; 2 is the 100 % modulus.")] = 2.0,
    hardness: Annotated[
        str, typer.Option(help="Shore hardness, such as '10 A' or '00-30'; up to 10 points off.", show_default=False)
    ] = "",
    reach: Annotated[
        str,
        typer.Option(
            "--for",
            help="What the actuator sees: its largest stretch, 'stretch 1:2.5', or the folder of a run. Rubbers that "
            "break below are left out.",
            metavar="STRETCH",
            show_default=False,
        ),
    ] = "",
    count: Annotated[int, typer.Option(min=1, help="Number of rubbers to print.")] = 5,
    as_json: Json = False,
    debug: Debug = False,
) -> None:
    """Find rubbers whose modulus at a stretch, or whose hardness, is near a wanted one."""
    with errors_as_sentences(debug, as_json) as answer:
        from turgor.cli.answers.file_results import choice_result
        from turgor.core.materials.library.choose import choose

        wanted = None if modulus is None else option_quantity("--modulus", modulus, "pressure")
        largest = _largest(reach)
        near = choose(wanted, stretch, hardness=hardness, reach=largest)[:count]
        _print_choice(near, stretch, max(stretch, largest or stretch))
        answer.give(lambda: choice_result(near, stretch))


def _largest(reach: str) -> float | None:
    """Largest stretch of ``--for``; None where it is not stated."""
    from turgor.cli.fitting.fit_texts import working_range

    try:
        return float(reach) if reach else None
    except ValueError:
        seen = working_range("", reach)
        return None if seen is None else seen[1]


def _print_choice(near: "Sequence[tuple[MaterialRow, float]]", stretch: float, end: float) -> None:
    """Print a table of rubbers, why these records, and the spread of the first."""
    from turgor.core.materials.library.choose import reaches
    from turgor.core.materials.library.spread import spread_of

    head = ("material", "Shore", f"at stretch {stretch:g}", "tested stretch", "breaks at", "record")
    rows = [(row.name, row.hardness or "–", _modulus(value), _stretches(row.stretch_range), _stretch(row.ultimate),
             row.record) for row, value in near]  # fmt: skip
    typer.echo(_aligned([head, *rows]))
    for row, _ in near:
        if row.why:
            typer.echo(f"{row.name}: {row.why}")
    short = [row.name for row, _ in near if not reaches(row.stretch_range, end)]
    if short:
        typer.echo(f"Not tested up to stretch {end:g}: {', '.join(short)}. Beyond its tests a law is a guess (M01).")
    typer.echo(f"Spread of {spread_of(near[0][0].name)}.")


def _modulus(value: float | None) -> str:
    if value is None:
        return "–"
    factor, unit = next((each for each in ((1e9, "GPa"), (1e6, "MPa")) if value >= each[0]), (1e3, "kPa"))
    return f"{value / factor:.3g} {unit}"


def _spread(values: tuple[float, float] | None) -> str:
    if values is None or values[0] == values[1]:
        return "–"
    return f"{_modulus(values[0])} to {_modulus(values[1])}"


def _stretch(value: float | None) -> str:
    return "–" if value is None else f"{value:.3g}"


def _stretches(values: tuple[float, float] | None) -> str:
    return "–" if values is None else f"{values[0]:g} to {values[1]:g}"


def _aligned(rows: Sequence[Sequence[str]]) -> str:
    """Lay out rows of texts in columns."""
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    lines = ("  ".join(text.ljust(width) for text, width in zip(row, widths, strict=True)).rstrip() for row in rows)
    return "\n".join(lines)


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
