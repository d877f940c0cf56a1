"""`turgor fit --relaxation --softening`: words, files that read back, plots, and what is refused."""

import numpy as np
import pytest
import typer
from matplotlib.colors import to_hex
from typer.testing import CliRunner

from refused import refused, states
from turgor.cli.fitting.fit import fit_command
from turgor.core.materials.experiments.material_test import MaterialTest
from turgor.core.materials.history.softening import Mullins
from turgor.core.materials.history.stress_history import stress_history
from turgor.core.materials.history.viscoelastic import Prony
from turgor.core.materials.laws.laws import NeoHooke
from turgor.core.materials.library.records import from_library
from turgor.core.materials.material import Material
from turgor.views.plots.fits import COLORS
from turgor.views.plots.history import history_figure

RUBBER = Material(
    name="r",
    law=NeoHooke(C10=3e4),
    viscoelasticity=Prony(g=(0.2,), tau=(5.0,), moduli="instantaneous"),
    stress_softening=Mullins(r=2.0, m=3e3),
)


def rows(at, stretches):
    time = np.linspace(at[0], at[-1], 400)
    stretch = np.interp(time, at, stretches)
    stress = stress_history(RUBBER, "uniaxial", time, stretch).nominal_stress
    return "".join(f"{t},{a},{p}\n" for t, a, p in zip(time, stretch, stress / 1e3, strict=True))


@pytest.fixture
def strip(tmp_path):
    file = tmp_path / "strip_uniaxial.csv"
    table = rows([0, 10, 20, 30, 40, 42, 80], [1, 1.8, 1, 1.8, 1, 2.2, 2.2])
    file.write_text("Time (s),stretch,nominal stress (kPa)\n" + table)
    return file


@pytest.fixture
def run():
    app = typer.Typer()
    app.command()(fit_command)
    return lambda *arguments: CliRunner().invoke(app, [str(argument) for argument in arguments])


def test_words_plot_and_constants(run, strip, tmp_path):
    result = run(
        strip,
        "--laws",
        "neo-hooke",
        "--relaxation",
        1,
        "--softening",
        "--output",
        tmp_path / "out",
    )
    assert result.exit_code == 0, result.output
    assert "Law of the first loading: neo-hooke, C10 = 2" in result.output
    assert "% near rest" in result.output
    assert "strip_uniaxial: R² = 1.00000" in result.output
    assert (tmp_path / "out" / "strip_uniaxial.png").read_bytes().startswith(b"\x89PNG")
    results = from_library(str(tmp_path / "out" / "strip_uniaxial.toml"))
    assert pytest.approx(3e4, rel=0.01) == results.law.C10
    assert results.viscoelasticity.g[0] == pytest.approx(0.2, abs=0.02)
    assert results.stress_softening.r == pytest.approx(2.0, rel=0.05)


def test_a_preload_lets_it_rest_where_it_is_slack(run, strip):
    result = run(strip, "--laws", "neo-hooke", "--softening", "--preload", "0.1 kPa")
    assert "at rest below it" in result.output


def test_a_file_without_its_loading_is_refused(run, tmp_path):
    file = tmp_path / "held_uniaxial.csv"
    file.write_text("Time (s),stretch,nominal stress (kPa)\n" + rows([0, 50], [1.8, 1.8]))
    result = run(file, "--relaxation", 1)
    assert result.exit_code != 0
    assert "begins stretched" in result.output


def test_a_file_without_time_is_refused(run, tmp_path):
    file = tmp_path / "strip_uniaxial.csv"
    file.write_text("stretch,nominal stress (kPa)\n1,0\n1.2,40\n1.5,80\n1.4,70\n")
    assert states(run(file, "--softening", "--laws", "neo-hooke").output, file.name, "time")


def test_the_plot_shows_what_was_measured_and_what_the_law_leaves_over():
    time = np.linspace(0, 20, 101)
    stretch = np.interp(time, [0, 10, 20], [1, 1.8, 1])
    stress = stress_history(RUBBER, "planar", time, stretch).nominal_stress
    test = MaterialTest(mode="planar", stretch=stretch, nominal_stress=stress, time=time, name="a sheet")
    first, over_time, rest = history_figure(RUBBER, [test]).axes
    measured, model = first.get_lines()
    assert to_hex(model.get_color()) == COLORS[0]
    at = ~np.isnan(model.get_xdata())
    assert model.get_ydata()[at] == pytest.approx(measured.get_ydata(), abs=1e-9)
    assert over_time.get_lines()[0].get_xdata().max() == 20
    law = stress_history(Material(name="r", law=RUBBER.law), "planar", time, stretch).nominal_stress
    assert rest.get_lines()[0].get_ydata() == pytest.approx((stress - law)[1:] / 1e3, abs=1e-9)
    assert "R² = 1.0000" in first.get_title(loc="left")
    with refused("test"):
        history_figure(RUBBER, [])


@pytest.mark.filterwarnings("error")
def test_the_plot_of_a_constant_stress_has_no_r2():
    time = np.linspace(0, 20, 11)
    test = MaterialTest(
        mode="planar", stretch=0 * time + 1.5, nominal_stress=0 * time + 2e4, time=time, name="a held sheet"
    )
    assert history_figure(RUBBER, [test]).axes[0].get_title(loc="left") == "a held sheet: planar (pure shear), R² = nan"


@pytest.mark.parametrize(("law", "facts"), [("blatz-ko", ("BlatzKo", "foam")), ("orthotropic", ("--directions",))])
def test_foams_and_laws_with_directions_do_not_relax(run, strip, law, facts):
    result = run(strip, "--laws", law, "--relaxation", 1)
    assert result.exit_code == 1
    assert states(result.output, *facts)
