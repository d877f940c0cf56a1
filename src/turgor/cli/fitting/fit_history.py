"""``turgor fit --relaxation --softening --rate-dependence --set``: a law from first loading, then its history."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import typer

from turgor.foundation.errors import TurgorError

if TYPE_CHECKING:
    from turgor.cli.fitting.fit_behavior import Behavior
    from turgor.core.materials.experiments.material_test import MaterialTest
    from turgor.core.materials.fitting.histories.history_fit import HistoryFit


def fit_over_time(
    tests: "Sequence[MaterialTest]", laws: Sequence[str], behavior: "Behavior", name: str
) -> "HistoryFit":
    """Fit laws to the first loading of tests with time, take the best, and fit its behavior in time to whole tests.

    Parameters
    ----------
    tests : sequence of MaterialTest
        With time, read as cyclic.
    laws : sequence of str
        Laws to choose from.
    behavior : Behavior
        What is fitted.
    name : str
        Name of the material.
    """
    from turgor.core.materials.fitting.ranking import rank

    virgin = [_first_loading(test) for test in tests]
    best = rank(laws, virgin).best
    typer.echo(f"Law of the first loading: {best.spec.name}, {', '.join(best.parameter(p) for p in best.spec.names)}")
    fit = behavior.fit(best.law, tests)
    typer.echo(fit.describe())
    if behavior.softening:
        typer.echo(f"Softening after the largest stretch of the tests: {100 * fit.largest_softening:.2g} % near rest")
    for quality in fit.quality:
        typer.echo(f"{quality.name}: R² = {quality.r2:.5f}, {quality.points} points")
    return replace(fit, material=replace(fit.material, name=name))


def write_history_fit(folder: Path, fit: "HistoryFit", tests: "Sequence[MaterialTest]") -> None:
    """Write the material as a file of records, and the plot.

    Parameters
    ----------
    folder : Path
        Folder, created if missing.
    fit : HistoryFit
        The fit.
    tests : sequence of MaterialTest
        Tests for the plot.
    """
    from turgor.core.materials.fitting.save import save_material
    from turgor.views.plots.fits import write_fit_plot
    from turgor.views.plots.history import history_figure

    folder.mkdir(parents=True, exist_ok=True)
    stem = "-".join(fit.material.name.lower().split())
    write_fit_plot(folder / f"{stem}.png", history_figure(fit.material, tests, title=fit.material.name))
    save_material(folder / f"{stem}.toml", fit.material)
    typer.echo(f"Plot and constants in {folder}.")


def _first_loading(test: "MaterialTest") -> "MaterialTest":
    """Part of a test up to its first largest stretch, before the rubber relaxes."""
    import numpy as np

    from turgor.core.materials.experiments.cycles import select_cycle
    from turgor.core.materials.experiments.test_edits import thin

    low, high = test.range
    if test.stretch[0] > low + 0.5 * (high - low) or high == low:
        raise TurgorError(
            f"test '{test.name}' begins stretched, so no law can be fitted to its loading; give its loading, too, "
            "or fit in Python with fit_history and a law from other tests."
        )
    loading = select_cycle(test, 1)
    top = int(np.argmax(loading.stretch >= loading.stretch.max()))
    loading = loading.keeping(np.arange(len(loading.stretch)) <= top, "After the first largest stretch")
    resting = (loading.stretch == 1.0) & (loading.nominal_stress == 0.0)
    return thin(loading.keeping(~resting, "At rest"))
