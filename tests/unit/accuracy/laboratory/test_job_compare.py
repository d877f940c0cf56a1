"""A run compared with an experiment on the command line, and the report that shows it."""

import json

import numpy as np
import pytest

from refused import states
from turgor.cli.app import main
from turgor.job.postprocess import report_folder
from turgor.job.read import read_job
from turgor.job.run import run_job

JOB = """
[actuator]
type = "extending_cylinder"
length = "20 mm"

[mesh]
size = "6 mm"
cells = "hexahedra"

[materials]
body = { name = "rubber", law = "neo_hooke", C10 = "0.1 MPa" }

[loads]
pressure = "10 kPa"

[procedure]
type = "static"
first_step = 0.25
max_step = 0.25

[output]
measures = ["tip_displacement", "chord_angle"]
fields = false
pictures = false
mesh_error = true
"""


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    folder = tmp_path_factory.mktemp("compared")
    file = folder / "pull.toml"
    file.write_text(JOB, encoding="utf-8")
    return run_job(read_job(file), folder / "pull-results", threads=1)


@pytest.fixture
def experiment(run, tmp_path):
    """The computed curve a tenth longer, at pressures between the states, in words of a spreadsheet."""
    computed = run.response
    at = np.linspace(0.5e3, 9.5e3, 10)
    moved = 1.1 * np.interp(at, computed["pressure"], computed["tip_displacement"])
    lines = [f"{p / 1e3:.4f};{u * 1e3:.7f}" for p, u in zip(at, moved, strict=True)]
    file = tmp_path / "rig.csv"
    file.write_text("\n".join(["Pressure (kPa);Tip Displacement [mm]", *lines]), encoding="utf-8")
    return file


def test_compare_prints_and_writes_and_the_report_shows_it(run, experiment, capsys):
    assert main(["compare", str(run.folder), str(experiment)]) == 0
    told = capsys.readouterr().out
    largest = 0.1 * np.interp(9.5e3, run.response["pressure"], run.response["tip_displacement_mm"])
    assert f"at most by -{largest:.3g} mm at 9.5 kPa" in told
    written = sorted(file.name for file in (run.folder / "comparisons").iterdir())
    assert written == ["rig.png", "rig_compared.csv", "rig_measured.csv"]
    report_folder(run.folder, lambda text: None)
    page = (run.folder / "report.html").read_text(encoding="utf-8")
    assert "<h3>Against rig</h3>" in page and f"at most by -{largest:.3g} mm" in page


@pytest.mark.parametrize("named", ["", "response.csv"])
def test_a_run_is_compared_with_a_run(run, named, tmp_path, capsys):
    """By its folder or by its response; a column that is zero in both is not what is compared."""
    softer = JOB.replace("0.1 MPa", "0.09 MPa").replace('"tip_disp', '"bending_angle", "tip_disp')
    (tmp_path / "softer.toml").write_text(softer.replace("mesh_error = true", "mesh_error = false\nreport = false"))
    other = run_job(read_job(tmp_path / "softer.toml"), tmp_path / "softer-results", threads=1)
    assert main(["compare", str(run.folder), str(other.folder / named)]) == 0
    said = capsys.readouterr().out
    assert said.startswith("Tip displacement differs by ") and "softer-results.png" in said


def test_names_to_measure_may_have_commas(run, capsys):
    assert main(["measure", str(run.folder), "tip_displacement,chord_angle"]) == 0
    assert capsys.readouterr().out.startswith("load_factor,pressure_kPa,tip_displacement_mm,chord_angle_deg\n")


def test_a_report_made_anew_keeps_the_mesh_errors(run):
    before = run.response["tip_displacement_mesh_error"]
    again = report_folder(run.folder, lambda text: None).response
    np.testing.assert_allclose(again["tip_displacement_mesh_error"], before, rtol=1e-12)


def test_compare_for_programs(run, experiment, capsys):
    assert main(["compare", str(run.folder / "response.csv"), str(experiment), "--json"]) == 0
    result = json.loads(capsys.readouterr().out)["result"]
    assert result["y"] == "tip_displacement" and result["rows"] == 10 and result["files"] == []


@pytest.mark.parametrize(
    ("change", "more", "sentence"),
    [
        (("Pressure (kPa)", "Pressure"), [], "column 'Pressure' states no unit"),
        (("Pressure (kPa)", "Pressure"), ["--unit", "pressure"], "--unit is 'pressure'; write the name"),
        (("", ""), ["--y", "tip_displacment"], "did you mean 'tip_displacement'"),
        (("Tip Displacement [mm]", "Force [N]"), [], "nothing to compare"),
    ],
)
def test_bad_input_is_a_sentence(run, experiment, capsys, change, more, sentence):
    experiment.write_text(experiment.read_text(encoding="utf-8").replace(*change), encoding="utf-8")
    assert main(["compare", str(run.folder), str(experiment), *more]) == 1
    assert sentence in capsys.readouterr().err


def test_a_folder_without_a_run(tmp_path, experiment, capsys):
    assert main(["compare", str(tmp_path), str(experiment)]) == 1
    assert states(capsys.readouterr().err, "response.csv")


def test_a_straight_tube_keeps_its_chord(run):
    np.testing.assert_allclose(run.response["chord_angle"], 0.0, atol=1e-9)
