"""`turgor fit --rate-dependence --set`: constants that read back, what is said, and what is refused."""

import numpy as np
import pytest
import typer
from typer.testing import CliRunner

import turgor as tg
from refused import states
from turgor.cli.fitting.fit import fit_command
from turgor.core.materials.history.stress_history import stress_history
from turgor.core.materials.library.records import from_library

RUBBER = tg.Material(
    name="r",
    law=tg.laws.NeoHooke(C10=1e5),
    permanent_set=tg.laws.PermanentSet(stress=5e6, exponent=1.5),
)


@pytest.fixture
def strip(tmp_path):
    time = np.linspace(0, 80, 81)
    stretch = np.interp(time, [0, 10, 20, 40, 60, 80], [1, 1.4, 1.05, 1.8, 1.1, 1.8])
    stress = stress_history(RUBBER, "uniaxial", time, stretch).nominal_stress
    rows = "".join(f"{t},{a},{p}\n" for t, a, p in zip(time, stretch, stress / 1e3, strict=True))
    file = tmp_path / "strip_uniaxial.csv"
    file.write_text("Time (s),stretch,nominal stress (kPa)\n" + rows)
    return file


@pytest.fixture
def run():
    app = typer.Typer()
    app.command()(fit_command)
    return lambda *arguments: CliRunner().invoke(app, [str(argument) for argument in arguments])


def test_a_set_is_fitted_written_and_read(run, strip, tmp_path):
    result = run(strip, "--laws", "neo-hooke", "--set", "--output", tmp_path / "out")
    assert result.exit_code == 0, result.output
    for words in ("set_stress = ", "set_exponent = ", "R² = 1.0000"):
        assert words in result.output
    (file,) = (tmp_path / "out").glob("*.toml")
    again = from_library(str(file))
    plastic = again.permanent_set
    assert plastic.residual_stretch(4e5) == pytest.approx(RUBBER.permanent_set.residual_stretch(4e5), abs=2e-3)
    (law,) = (again.law.C10 / 1e5,)
    assert law == pytest.approx(1.0, rel=0.02)
    assert list((tmp_path / "out").glob("*.png"))


@pytest.mark.parametrize(
    ("options", "facts"),
    [
        (("--relaxation", 1, "--set"), ("--relaxation", "--set")),
        (("--relaxation", 1, "--rate-dependence"), ("--relaxation", "--rate-dependence")),
        (("--each", "--average", "--set"), ("--average", "--each")),
        (("--set", "--zero", "auto"), ("--zero", "--set")),
    ],
)
def test_options_that_exclude_each_other_are_refused(run, strip, options, facts):
    result = run(strip, *options)
    assert result.exit_code != 0
    assert all(states(result.output, fact) for fact in facts), result.output
