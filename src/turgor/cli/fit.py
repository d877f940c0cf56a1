"""``turgor fit``: read tests, fit laws to them, print the table that ranks them, write plot and constants."""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from turgor.cli.exits import errors_as_sentences
from turgor.errors import TurgorError

if TYPE_CHECKING:
    from rich.console import Console
    from rich.table import Table

    from turgor.materials.experiments.material_test import MaterialTest
    from turgor.materials.experiments.read_tests import Specimen
    from turgor.materials.fitting.ranking import Ranking
    from turgor.materials.fitting.result import Fit

#: Laws that are fitted when none is named: from stiff and simple to free.
DEFAULT_LAWS = "neo-hooke,mooney-rivlin,yeoh,ogden-3,gent"

Files = Annotated[
    list[Path], typer.Argument(metavar="FILES...", help="Tables of tests of one material.", show_default=False)
]


def fit_command(
    files: Files,
    mode: Annotated[
        str, typer.Option(help="uniaxial, equibiaxial, planar, simple_shear or biaxial; one, or one for each file.")
    ] = "",
    laws: Annotated[str, typer.Option(help="Laws, such as yeoh,ogden-3,rivlin-2,arruda-boyce.")] = DEFAULT_LAWS,
    range_: Annotated[str, typer.Option("--range", help="Stretches wanted, such as 1:4; by default all.")] = "",
    stress: Annotated[str, typer.Option(help="nominal or cauchy, where a file does not say.")] = "",
    weights: Annotated[str, typer.Option(help="relative or absolute.")] = "relative",
    specimen: Annotated[
        str, typer.Option(help="Length, width and thickness for files of force, such as '33 mm, 6 mm, 3 mm'.")
    ] = "",
    cycle: Annotated[
        int | None, typer.Option(help="Loading curve of cyclic tests: 1 the first, -1 the last.", show_default=False)
    ] = None,
    preload: Annotated[str, typer.Option(help="Nominal stress at which it is taut, such as '0.7 kPa'.")] = "",
    keep_tail: Annotated[bool, typer.Option("--keep-tail", help="Keep what comes after the break.")] = False,
    points: Annotated[int, typer.Option(help="Points a curve is thinned to; 0 keeps all.")] = 60,
    each: Annotated[bool, typer.Option("--each", help="Every file is a material of its own.")] = False,
    starts: Annotated[int, typer.Option(min=1, help="Starts of the search.")] = 20,
    seed: Annotated[int, typer.Option(help="Seed of the starts.")] = 0,
    relaxation: Annotated[
        int, typer.Option(min=0, help="Terms of a Prony series, fitted over time after the law; 0 for none.")
    ] = 0,
    softening: Annotated[bool, typer.Option("--softening", help="Fit stress softening to cycles, too.")] = False,
    output: Annotated[Path | None, typer.Option(help="Folder for plots and constants.", show_default=False)] = None,
    debug: Annotated[bool, typer.Option("--debug", help="Show where an error was raised.")] = False,
) -> None:
    """Fit laws to material tests, all files together, and rank them."""
    with errors_as_sentences(debug):
        from turgor.materials.fitting.ranking import rank

        wanted, names = _range(range_), [law.strip() for law in laws.split(",") if law.strip()]
        modes, dimensions = _modes(mode, len(files)), _specimen(specimen)
        rest = _preload(preload)
        if relaxation or softening:
            whole = [_whole(f, m, stress, dimensions, rest) for f, m in zip(files, modes, strict=True)]
            _fit_over_time(whole, names, relaxation, softening, (_common_name(files), output))
            return
        tests = []
        for file, known in zip(files, modes, strict=True):
            read = _read(file, known, stress, dimensions, cycle)
            test = _thinned(_handled(read, cycle, rest, keep_tail), wanted, points)
            typer.echo(f"{file.name}: {test!r}")
            for step in test.steps:
                typer.echo(f"  {step.text}")
            tests.append(test)
        groups = [(test.name, [test]) for test in tests] if each else [(_common_name(files), tests)]
        rankings = []
        for name, group in groups:
            ranking = rank(names, group, stretch=wanted, weights=weights, starts=starts, seed=seed)
            rankings.append((name, ranking))
            if not each:
                _show(ranking)
        if each:
            _show_each(rankings, names)
        if output is not None:
            _write(output, rankings)


def _whole(
    file: Path, mode: str | None, stress: str, specimen: "Specimen | None", preload: float | None
) -> "MaterialTest":
    """A test with all its cycles, at rest where it is slack."""
    from turgor.materials.experiments.handling import rest_below
    from turgor.materials.experiments.read_tests import read_test

    test = read_test(file, mode=mode, stress_measure=stress or None, specimen=specimen, cyclic=True)
    test = test if preload is None else rest_below(test, preload)
    typer.echo(f"{file.name}: {test!r}")
    for step in test.steps:
        typer.echo(f"  {step.text}")
    return test


def _fit_over_time(
    tests: "list[MaterialTest]", laws: list[str], terms: int, softening: bool, goal: tuple[str, Path | None]
) -> None:
    from turgor.cli.fit_history import fit_over_time, write_history_fit

    name, output = goal
    found = fit_over_time(tests, laws, terms=terms, softening=softening, name=name)
    if output is not None:
        write_history_fit(output, found, tests)


def _read(file: Path, mode: str | None, stress: str, specimen: "Specimen | None", cycle: int | None) -> "MaterialTest":
    from turgor.materials.experiments.read_tests import read_test

    return read_test(file, mode=mode, stress_measure=stress or None, specimen=specimen, cyclic=cycle is not None)


def _handled(test: "MaterialTest", cycle: int | None, preload: float | None, keep_tail: bool) -> "MaterialTest":
    from turgor.materials.experiments.handling import remove_slack, remove_tail, select_cycle

    if cycle is not None:
        if cycle == 0:
            raise TurgorError("--cycle counts from 1; 1 is the first and -1 the last.")
        test = select_cycle(test, cycle - 1 if cycle > 0 else cycle)
    if not keep_tail and test.mode != "biaxial":
        test = remove_tail(test)
    if preload is not None:
        test = remove_slack(test, preload)
    return test


def _thinned(test: "MaterialTest", wanted: tuple[float, float] | None, points: int) -> "MaterialTest":
    from turgor.materials.experiments.handling import crop, thin

    if test.mode in ("biaxial", "simple_shear"):
        return test
    if wanted is not None:
        test = crop(test, *wanted)
    return thin(test, points) if points else test


def _show(ranking: "Ranking") -> None:
    """Print the table of laws and what it means."""
    console, table = _table("law", "parameters", "AIC")
    for test in ranking.best.quality:
        table.add_column(f"{test.name} [%]", justify="right", overflow="fold")
        table.add_column("R²", justify="right")
    for fit in ranking.fits:
        cells = [cell for test in fit.quality for cell in (f"{100 * test.relative:.1f}", f"{test.r2:.4f}")]
        parameters = "\n".join(fit.parameter(name) for name in fit.spec.names)
        table.add_row(fit.spec.name, parameters, f"{fit.aic:.1f}", *cells)
    console.print(table)
    for text in (*ranking.words, *ranking.failed):
        typer.echo(text)


def _show_each(rankings: "Sequence[tuple[str, Ranking]]", laws: Sequence[str]) -> None:
    """Print one row a material: the relative error of every law, the best marked."""
    from turgor.materials.fitting.law_specs import law_spec

    names = [law_spec(law).name for law in laws]
    console, table = _table("material", "stretch")
    for name in names:
        table.add_column(f"{name} [%]", justify="right")
    for material, ranking in rankings:
        found = {fit.spec.name: fit for fit in ranking.fits}
        cells = [_cell(found.get(name), ranking) for name in names]
        low, high = ranking.best.stretch_range
        table.add_row(material, f"{low:.3g} to {high:.3g}", *cells)
    console.print(table)
    typer.echo("Root mean square of the relative error; * marks the smallest AIC.")
    for text in dict.fromkeys(text for _, ranking in rankings for text in ranking.failed):
        typer.echo(text)
    _tell_findings(rankings)


def _tell_findings(rankings: "Sequence[tuple[str, Ranking]]") -> None:
    """Say what all materials have in common once, and which of them end before the range that is wanted."""
    fits = [fit for _, ranking in rankings for fit in ranking.fits]
    common = dict.fromkeys(str(found) for fit in fits for found in fit.findings if found.code != "M01")
    for text in common:
        typer.echo(text)
    short = [
        f"{material} ({ranking.best.stretch_range[1]:.3g})"
        for material, ranking in rankings
        if any(found.code == "M01" for found in ranking.best.findings)
    ]
    if short:
        typer.echo(f"M01 warning: tests end before the stretch that is wanted: {', '.join(short)}.")


def _cell(fit: "Fit | None", ranking: "Ranking") -> str:
    if fit is None:
        return "-"
    return f"{100 * fit.relative:.1f}{'*' if fit is ranking.best else ''}"


def _table(*columns: str) -> "tuple[Console, Table]":
    from rich.console import Console
    from rich.table import Table

    console = Console(highlight=False, markup=False)
    # a pipe has no width, and a table cut to 80 letters would lose numbers
    if not console.is_terminal:
        console = Console(highlight=False, markup=False, width=160)
    table = Table(box=None, pad_edge=False, header_style="")
    for column in columns:
        table.add_column(column)
    return console, table


def _write(folder: Path, rankings: "Sequence[tuple[str, Ranking]]") -> None:
    from turgor.materials.fitting.save import can_be_saved, save_fits
    from turgor.results.plots.fits import fit_figure, write_fit_plot

    folder.mkdir(parents=True, exist_ok=True)
    left: dict[str, None] = {}
    for name, ranking in rankings:
        stem = "-".join(name.lower().split())
        write_fit_plot(folder / f"{stem}.png", fit_figure(ranking.fits, title=name))
        saved = [fit for fit in ranking.fits if can_be_saved(fit)]
        if saved:
            save_fits(folder / f"{stem}.toml", name, saved)
        left |= {fit.spec.name: None for fit in ranking.fits if fit not in saved}
    if left:
        typer.echo(f"Files of constants have no form for {', '.join(left)} yet; see the plots.")
    typer.echo(f"Plots and constants in {folder}.")


def _range(text: str) -> tuple[float, float] | None:
    if not text:
        return None
    try:
        low, high = (float(part) for part in text.split(":"))
    except ValueError:
        raise TurgorError(f"--range is '{text}'; write smallest and largest stretch, for example 1:4.") from None
    return low, high


def _modes(text: str, count: int) -> list[str | None]:
    given: list[str | None] = [part.strip() or None for part in text.split(",")]
    if len(given) == 1:
        return given * count
    if len(given) != count:
        raise TurgorError(f"--mode names {len(given)} modes for {count} files; give one, or one for each file.")
    return given


def _specimen(text: str) -> "Specimen | None":
    from turgor.materials.experiments.read_tests import Specimen
    from turgor.units import parse_quantity

    if not text:
        return None
    sizes = [parse_quantity(part.strip(), "length") for part in text.split(",")]
    if len(sizes) != 3:
        raise TurgorError(
            f"--specimen is '{text}'; write length, width and thickness, for example '33 mm, 6 mm, 3 mm'."
        )
    return Specimen(length=sizes[0], width=sizes[1], thickness=sizes[2])


def _preload(text: str) -> float | None:
    from turgor.units import parse_quantity

    return parse_quantity(text, "pressure") if text else None


def _common_name(files: Sequence[Path]) -> str:
    """Name of the only file, or of the folder that all share."""
    folder = files[0].resolve().parent.name
    return files[0].stem if len(files) == 1 else folder or "fit"
