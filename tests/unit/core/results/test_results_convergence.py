"""A convergence study says its result with the digits that its error leaves, as table and as plot."""

from pathlib import Path

import numpy as np
import pytest
from matplotlib.figure import Figure

from refused import refused
from turgor.core.results.convergence.study import Convergence
from turgor.core.results.files.response_csv import read_response
from turgor.core.results.measures.field_measures import maximum_principal_stretch
from turgor.core.results.measures.standard_measures import cavity_volume
from turgor.units import mL, mm
from turgor.views.plots.convergence import plot_convergence, write_convergence_plot

CELLS = np.array([1000, 3000, 9000])


def study(values, cells=CELLS, measure=cavity_volume) -> Convergence:
    sizes = np.array([4.0, 2.8, 2.0]) * mm
    return Convergence(measure=measure, sizes=sizes, cells=cells, unknowns=6 * cells, values=np.array(values))


def test_order_and_error_are_those_of_the_effective_sizes() -> None:
    h = 4 * mm * (CELLS[0] / CELLS) ** (1 / 3)  # not the 4, 2.8 and 2 mm that were aimed at
    result = study(2 * mL + 0.01 * h**2)
    assert result.effective_sizes == pytest.approx(h)
    assert result.extrapolation.order == pytest.approx(2)
    assert result.extrapolation.value == pytest.approx(2 * mL)


def test_the_summary_shows_digits_down_to_the_error() -> None:
    h = (CELLS[0] / CELLS) ** (1 / 3)
    assert study(2 * mL - 4e-4 * mL * h**3).summary == (
        "Extrapolated cavity volume 2.000000 mL; the finest mesh gives 1.999956 mL, with an estimated error of "
        "5.6e-05 mL (0.0028 %); observed order 3."
    )
    assert study(1.5 + 0 * h, measure=maximum_principal_stretch).summary == (
        "Extrapolated maximum principal stretch 1.5; the finest mesh gives 1.5, with an estimated error of 0 (0 %). "
        "The values are equal on all meshes."
    )


@pytest.mark.parametrize(
    ("values", "words"),
    [
        (
            [1.0, 1.2, 1.1],
            "gives maximum principal stretch 1.10, with an error of about 0.2 (18 %). The values go up and",
        ),
        ([1.0, 1.1, 1.4], "with an error of about 0.4 (29 %). The values do not come closer to each other"),
        ([1.0, 1.1, 1.195], "observed order 0.1"),
        ([1.0, 1.1, 1.1001], "faster than these cells can (order 4)"),
    ],
)
def test_the_summary_is_honest_where_nothing_can_be_extrapolated(values, words: str) -> None:
    text = study(values, measure=maximum_principal_stretch).summary
    assert words in text
    assert ("Extrapolated" in text) == ("faster" in text)


def test_the_table_comes_back_from_its_file(tmp_path: Path) -> None:
    result = study([1.9 * mL, 2.0 * mL, 2.02 * mL])
    result.response.to_csv(tmp_path / "convergence.csv")
    table = read_response(tmp_path / "convergence.csv")
    assert table.names == ("mesh_size", "effective_size", "cells", "unknowns", "cavity_volume")
    assert table.column("cavity_volume") == pytest.approx(result.values, rel=1e-12)
    assert list(table.column("unknowns")) == [6000, 18000, 54000]


@pytest.mark.parametrize("values", [[1.9, 2.0, 2.02], [1.9, 2.0, 1.95]])
def test_the_plot_marks_what_is_extrapolated(tmp_path: Path, values) -> None:
    result = study(np.array(values) * mL)
    axes = plot_convergence(Figure().add_subplot(), result)
    labels = axes.get_legend_handles_labels()[1]
    assert any(label.startswith("extrapolated: ") for label in labels) == result.extrapolation.reliable
    assert axes.get_ylabel() == "cavity volume [mL]"
    write_convergence_plot(tmp_path / "plot.png", result, title="small")
    assert (tmp_path / "plot.png").read_bytes().startswith(b"\x89PNG")
    with refused("plot.jpg", ".jpg", ".png or .svg"):
        write_convergence_plot(tmp_path / "plot.jpg", result)


def test_meshes_that_do_not_get_finer_are_refused() -> None:
    with refused("900, 1200, 1200 cells"):
        study([1.0, 1.1, 1.2], cells=np.array([900, 1200, 1200]))
    two = np.array([2e-3, 1e-3])
    with refused("2 mesh sizes", "least three"):
        Convergence(measure=cavity_volume, sizes=two, cells=CELLS[:2], unknowns=CELLS[:2], values=two)
