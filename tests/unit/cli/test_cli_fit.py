"""`turgor fit`: the table, the words, the files, and what is said about mistakes."""

import re

import numpy as np
import pytest
import typer
from typer.testing import CliRunner

from refused import states
from turgor.cli.fitting.fit import fit_command
from turgor.core.materials.laws.laws import Yeoh
from turgor.core.materials.library.record_files import read_records


@pytest.fixture
def strip(tmp_path):
    stretch = np.linspace(1.0, 4.0, 100)
    x = stretch**2 + 2 / stretch - 3
    stress = 2 * (stretch - stretch**-2) * (20e3 - 200 * x + 12 * x**2)
    rows = "".join(f"{a},{b}\n" for a, b in zip(stretch, stress / 1e6, strict=True))
    path = tmp_path / "strip_uniaxial.csv"
    path.write_text(f"stretch,nominal_stress_MPa\n{rows}5,0.001\n")  # it broke
    return path


@pytest.fixture
def run():
    app = typer.Typer()
    app.command()(fit_command)
    return lambda *arguments: CliRunner().invoke(app, [str(argument) for argument in arguments])


def test_table_words_plot_and_constants(run, strip, tmp_path):
    result = run(
        strip, "--laws", "yeoh,neo-hooke,ogden-2", "--range", "1:4", "--starts", 5, "--output", tmp_path / "out"
    )
    assert result.exit_code == 0, result.output
    assert "After the break at stretch 4: one point of 101 removed." in result.output
    assert re.search(r"C10 = (20|19\.9)", result.output), result.output
    assert "neo-hooke" in result.output
    assert "neo-hooke suits strains up to 50 %" in result.output
    assert "ogden-2: Uniaxial tests alone do not determine Ogden constants" in result.output
    assert (tmp_path / "out" / "strip_uniaxial.png").read_bytes().startswith(b"\x89PNG")
    first = read_records(tmp_path / "out" / "strip_uniaxial.toml")[0]
    law = first.build_law()
    assert isinstance(law, Yeoh)
    assert pytest.approx((20e3, -100, 4), rel=0.02) == (law.C10, law.C20, law.C30)


def test_handling_can_be_switched_off(run, strip):
    result = run(strip, "--laws", "yeoh", "--keep-tail", "--points", 0)
    assert "After the break" not in result.output
    assert "101 points" in result.output


def test_each_file_can_be_a_material_of_its_own(run, strip, tmp_path):
    other = tmp_path / "other_uniaxial.csv"
    other.write_text(strip.read_text())
    result = run(strip, other, "--each", "--laws", "yeoh,neo-hooke", "--range", "1:4", "--output", tmp_path / "out")
    assert result.exit_code == 0, result.output
    rows = [line for line in result.output.splitlines() if line.startswith(("strip_uniaxial  ", "other_uniaxial  "))]
    assert len(rows) == 2 and all("*" in row for row in rows)
    names = {path.name for path in (tmp_path / "out").iterdir()}
    assert names == {f"{name}_uniaxial.{ending}" for name in ("strip", "other") for ending in ("png", "toml")}


def test_replicates_are_averaged(run, tmp_path):
    stretch = np.linspace(1.0, 2.0, 40)
    paths = []
    for number, modulus in enumerate((80e3, 100e3, 120e3)):
        path = tmp_path / f"uniaxial_{number}.csv"
        rows = "".join(f"{x},{modulus * (x - x**-2)}\n" for x in stretch[: 40 - number])
        path.write_text(f"stretch,nominal_stress_Pa\n{rows}")
        paths.append(path)
    result = run(*paths, "--average", "--laws", "neo-hooke")
    assert result.exit_code == 0, result.output
    assert re.search(r"C10 = (50|49\.9\d*|50\.0\d*) ", result.output), "half of the mean modulus of 100 kPa"
    assert "mean of 3 uniaxial [%]" in result.output
    assert "3 points outside removed" in result.output
    assert "scatter by up to 20 % of the largest stress" in result.output
    both = tmp_path / "both_uniaxial.csv"
    both.write_text("specimen,stretch,nominal_stress_Pa\nA,1,0\nA,2,140e3\nB,1,0\nB,2,210e3\n".replace("e3", "000"))
    assert states(run(both).output, "--average", "--by 'specimen'")
    assert "mean of 2 uniaxial [%]" in run(both, "--average", "--laws", "neo-hooke", "--points", 0).output


def test_compression_is_fitted(run, tmp_path):
    stretch = np.linspace(1.0, 0.5, 30)
    path = tmp_path / "button_uniaxial.csv"
    path.write_text("stretch,nominal_stress_Pa\n" + "".join(f"{x},{1e5 * (x - x**-2)}\n" for x in stretch))
    result = run(path, "--laws", "neo-hooke")
    assert result.exit_code == 0, result.output
    assert "C10 = 50 " in result.output
    assert "only from stretch 0.5 to 1" in result.output


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (["--range", "1-4"], "--range is '1-4'; write smallest and largest stretch, for example 1:4"),
        (["--laws", "yeo"], "unknown law 'yeo'; did you mean 'yeoh'"),
        (["--mode", "planr"], "unknown mode 'planr'; did you mean 'planar'"),
        (["--mode", "planar,uniaxial"], "--mode names 2 modes for 1 files"),
        (["--specimen", "33 mm"], "--specimen is '33 mm'"),
        (["--specimen", "33 mm, 0 mm, 3 mm"], "width is 0 m; it must be more than 0"),
        (["--preload", "7"], "--preload: '7' needs a unit"),
        (["--cycle", "0"], "cycle is 0; 1 is the first"),
        (["--cycle", "9"], "has one loading curve; there is no number 9"),
        (["--average"], "--average has one uniaxial test only"),
        (["--average", "--each"], "--average goes with neither --each"),
        (["--weights", "none"], "unknown weights 'none'"),
    ],
)
def test_mistakes_are_sentences_and_exit_code_1(run, strip, arguments, sentence):
    result = run(strip, *arguments)
    assert result.exit_code == 1
    assert sentence in result.output
    assert "Traceback" not in result.output


def test_a_missing_file_and_an_unanswered_question(run, strip, tmp_path):
    assert states(run(tmp_path / "no_uniaxial.csv").output, "no_uniaxial.csv")
    bare = tmp_path / "bare_uniaxial.csv"
    bare.write_text(strip.read_text().replace("nominal_stress_MPa", "stress (MPa)"))
    assert "--stress nominal" in run(bare).output
    assert run(bare, "--stress", "nominal", "--laws", "yeoh").exit_code == 0
