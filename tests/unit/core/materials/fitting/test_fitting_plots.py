"""Plots of fits: raw, used and removed points, solid where tested and dashed elsewhere."""

import numpy as np
import pytest
from matplotlib.figure import Figure

from refused import refused
from turgor.core.materials.experiments.material_test import MaterialTest
from turgor.core.materials.experiments.test_edits import average, crop
from turgor.core.materials.fitting.fit_laws import fit
from turgor.views.plots.fits import fit_figure, plot_law, plot_test, write_fit_plot


def strip(factor=1.0, mode="uniaxial"):
    stretch = np.linspace(1.0, 4.0, 31)
    stress = factor * 1e5 * (stretch - stretch**-2)
    return MaterialTest(mode=mode, stretch=stretch, nominal_stress=stress, name="strip")


def labels(axes):
    return [line.get_label() for line in axes.get_lines()]


def test_raw_used_and_removed_points_are_shown():
    axes = plot_test(Figure().add_subplot(), crop(strip(), 1.0, 2.0))
    assert labels(axes) == ["raw", "removed", "used"]
    raw, removed, used = (len(line.get_xdata()) for line in axes.get_lines())
    assert (raw, removed, used) == (31, 20, 11)
    assert labels(plot_test(Figure().add_subplot(), strip())) == ["used"]


def test_replicates_have_a_band():
    axes = plot_test(Figure().add_subplot(), average([strip(1.0), strip(2.0)]))
    assert len(axes.collections) == 1


def test_a_law_is_dashed_beyond_its_tests():
    result = fit("neo-hooke", crop(strip(), 1.0, 2.0))
    axes = plot_law(Figure().add_subplot(), result, "uniaxial", 4.0, color="k")
    solid, dashed = axes.get_lines()
    assert (solid.get_linestyle(), dashed.get_linestyle()) == ("-", "--")
    assert solid.get_xdata().max() == pytest.approx(2.0, abs=0.02)
    assert dashed.get_xdata().max() == 4.0
    (other,) = plot_law(Figure().add_subplot(), result, "planar", 3.0, color="k").get_lines()
    assert other.get_linestyle() == "--"
    assert other.get_label() == "neo-hooke, predicted"


def test_one_panel_a_mode_and_what_was_not_fitted_too(tmp_path):
    result = fit("neo-hooke", strip())
    stretch = np.array([1.2, 1.5, 2.0])
    field = MaterialTest(
        mode="biaxial",
        stretch=stretch,
        nominal_stress=1e5 * stretch,
        name="f",
        stretch_2=stretch,
        nominal_stress_2=1e5 * stretch,
    )
    shear = MaterialTest(mode="simple_shear", stretch=[-1.0, 1.0], nominal_stress=[-1e5, 1e5], name="s")
    figure = fit_figure([result], [strip(mode="planar"), field, shear], title="rubber")
    titles = [axes.get_title(loc="left") for axes in figure.axes]
    assert titles == ["Uniaxial", "Planar (pure shear)", "General biaxial", "Simple shear"]
    for ending in ("png", "svg"):
        write_fit_plot(tmp_path / f"a.{ending}", figure)
        assert (tmp_path / f"a.{ending}").stat().st_size > 1000
    with refused("a.jpg", ".jpg", ".png or .svg"):
        write_fit_plot(tmp_path / "a.jpg", figure)
    with refused("no fit", "plot"):
        fit_figure([])
