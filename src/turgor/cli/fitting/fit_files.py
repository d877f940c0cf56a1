"""Files of ``turgor fit``: a plot of each material, and its constants."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import typer

if TYPE_CHECKING:
    from turgor.core.materials.fitting.ranking import Ranking
    from turgor.core.materials.library.fit_spread import FitSpread


def write_fits(folder: Path, rankings: "Sequence[tuple[str, Ranking]]", spreads: "Mapping[str, FitSpread]") -> None:
    """Write the plot of each material and the constants of the laws that files have a form for.

    Parameters
    ----------
    folder : Path
        Created if there is none.
    rankings : sequence of (str, Ranking)
        By the name of the material.
    spreads : mapping of str to FitSpread
        By the name of the law.
    """
    from turgor.core.materials.fitting.save import can_be_saved, save_fits
    from turgor.views.plots.fits import fit_figure, write_fit_plot

    folder.mkdir(parents=True, exist_ok=True)
    unsaved: dict[str, None] = {}
    for name, ranking in rankings:
        stem = "-".join(name.lower().split())
        write_fit_plot(folder / f"{stem}.png", fit_figure(ranking.fits, title=name))
        saved = [fit for fit in ranking.fits if can_be_saved(fit)]
        if saved:
            save_fits(folder / f"{stem}.toml", name, saved, spreads)
        unsaved |= {fit.spec.name: None for fit in ranking.fits if fit not in saved}
    if unsaved:
        typer.echo(f"Files of constants have no form for {', '.join(unsaved)} yet; see the plots.")
    typer.echo(f"Plots and constants in {folder}.")
