"""Tables of ``turgor fit``: the laws of one material, or a row for each of several materials."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import typer

if TYPE_CHECKING:
    from rich.console import Console
    from rich.table import Table

    from turgor.core.materials.fitting.ranking import Ranking
    from turgor.core.materials.fitting.result import Fit


#: Tests that have a column each; more do not fit onto a screen.
MOST_TESTS = 4


def show(ranking: "Ranking") -> None:
    """Print the table of laws and the sentences about it."""
    console, table = _table("law", "parameters", "AIC")
    single = len(ranking.best.quality) <= MOST_TESTS
    for test in ranking.best.quality if single else ():
        table.add_column(f"{test.name} [%]", justify="right", overflow="fold")
        table.add_column("R²", justify="right")
    if not single:
        table.add_column(f"{len(ranking.best.quality)} tests [%]", justify="right")
        table.add_column("the worst [%]", justify="right")
    for fit in ranking.fits:
        cells = [cell for test in fit.quality for cell in (f"{100 * test.relative:.1f}", f"{test.r2:.4f}")]
        if not single:
            worst = max(fit.quality, key=lambda test: test.relative)
            cells = [f"{100 * fit.relative:.1f}", f"{100 * worst.relative:.1f} ({worst.name})"]
        parameters = "\n".join(fit.parameter(name) for name in fit.spec.names)
        table.add_row(fit.spec.name, parameters, f"{fit.aic:.1f}", *cells)
    console.print(table)
    for text in (*ranking.words, *ranking.failed):
        typer.echo(text)


def show_each(rankings: "Sequence[tuple[str, Ranking]]", laws: Sequence[str]) -> None:
    """Print one row for each material: the relative error of every law, with the best one marked."""
    from turgor.core.materials.fitting.law_specs import law_spec

    names = [law_spec(law).name for law in laws]
    console, table = _table("material", "stretch")
    for name in names:
        table.add_column(f"{name} [%]", justify="right")
    for material, ranking in rankings:
        by_law = {fit.spec.name: fit for fit in ranking.fits}
        cells = [_cell(by_law.get(name), ranking) for name in names]
        low, high = ranking.best.stretch_range
        table.add_row(material, f"{low:.3g} to {high:.3g}", *cells)
    console.print(table)
    typer.echo("Root mean square of the relative error; * marks the smallest AIC.")
    for text in dict.fromkeys(text for _, ranking in rankings for text in ranking.failed):
        typer.echo(text)
    _tell_findings(rankings)


def _tell_findings(rankings: "Sequence[tuple[str, Ranking]]") -> None:
    """Print common findings once, and the materials whose tests end before the requested range."""
    fits = [fit for _, ranking in rankings for fit in ranking.fits]
    common = dict.fromkeys(str(each) for fit in fits for each in fit.findings if each.code != "M01")
    for text in common:
        typer.echo(text)
    short = [
        f"{material} ({ranking.best.stretch_range[1]:.3g})"
        for material, ranking in rankings
        if any(each.code == "M01" for each in ranking.best.findings)
    ]
    if short:
        typer.echo(f"M01 warning: tests end before the requested stretch: {', '.join(short)}.")


def _cell(fit: "Fit | None", ranking: "Ranking") -> str:
    if fit is None:
        return "-"
    return f"{100 * fit.relative:.1f}{'*' if fit is ranking.best else ''}"


def _table(*columns: str) -> "tuple[Console, Table]":
    from rich.console import Console
    from rich.table import Table

    console = Console(highlight=False, markup=False)
    # a pipe has no width; a table of 80 letters would lose numbers
    if not console.is_terminal:
        console = Console(highlight=False, markup=False, width=160)
    table = Table(box=None, pad_edge=False, header_style="")
    for column in columns:
        table.add_column(column)
    return console, table
