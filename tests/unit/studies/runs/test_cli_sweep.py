"""The command ``turgor sweep``: designs of a study file, kept as they end, and mistakes with their lines."""

import json
import os
import signal
import subprocess
import sys
import time

import pytest
from PIL import Image

import turgor as tg
from calibration_cases import JOB
from refused import states
from turgor.cli import main
from turgor.cli.exits import BAD_INPUT, DONE, NOT_CONVERGED

STUDY = """
job = "tube.toml"

[factors]
actuator.wall = ["2 mm", "2.5 mm"]
"materials.body.C10" = { low = "0.1 MPa", high = "0.14 MPa", levels = 2 }

[sweep]
measures = ["tip_displacement_x"]
at = { pressure = "10 kPa" }
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("sweep")
    (folder / "tube.toml").write_text(JOB, encoding="utf-8")
    (folder / "walls.toml").write_text(STUDY, encoding="utf-8")
    return folder


@pytest.fixture
def call(folder, monkeypatch, capsys):
    monkeypatch.chdir(folder)

    def run(*arguments):
        code = main(["sweep", *arguments])
        said = capsys.readouterr()
        return code, said.out, said.err

    return run


def test_a_study_of_a_job(call, folder):
    code, said, progress = call("walls.toml", "--processes", "2")
    assert code == DONE
    assert "4 designs, 0 failed. Written in walls-study: study.csv, tip_displacement_x.png." in said
    assert "actuator.wall 2 mm, materials.body.C10 0.14 MPa: done" in progress
    study = tg.studies.load_study(folder / "walls-study")
    soft, stiff, thick, _ = study.column("tip_displacement_x", at=("pressure", 10e3))
    assert soft == pytest.approx(1.4 * stiff, rel=0.02)  # nearly linear: inverse in the modulus
    assert thick < soft
    assert (study.mesh_error("tip_displacement_x") > 0).all()
    lines = (folder / "walls-study" / "study.csv").read_text(encoding="utf-8").splitlines()
    assert lines[0] == (
        "actuator.wall (mm),materials.body.C10 (MPa),status,problem,cpu_seconds,tip_displacement_x (mm),"
        "tip_displacement_x_mesh_error (mm)"
    )
    assert lines[1].startswith("2,0.1,converged,,")
    assert Image.open(folder / "walls-study" / "tip_displacement_x.png").size[0] > 600
    assert not (folder / "walls-study" / "paths").exists()
    code, said, progress = call("walls.toml", "--json")  # everything is read
    result = json.loads(said)["result"]
    assert (result["designs"], result["kept"], result["failed"]) == (4, 4, 0)
    assert result["columns"]["actuator.wall (mm)"] == [2.0, 2.0, 2.5, 2.5]


def test_designs_are_listed_and_nothing_is_computed(call, folder):
    code, said, _ = call("walls.toml", "--dry-run", "--output", "nowhere")
    assert code == DONE
    assert said.splitlines()[1].split() == ["1", "2", "mm", "0.1", "MPa"]
    assert said.splitlines()[-1] == "4 designs: full factorial."
    assert not (folder / "nowhere").exists()
    code, said, _ = call("walls.toml", "--dry-run", "--json")
    assert json.loads(said)["result"]["columns"]["materials.body.C10 (MPa)"] == [0.1, 0.14, 0.1, 0.14]


def test_a_design_that_cannot_be_built_is_a_row(call, folder):
    text = STUDY.replace('["2 mm", "2.5 mm"]', '["2 mm", "-2 mm"]').split('"materials')[0]
    (folder / "bad.toml").write_text(text, encoding="utf-8")
    code, said, _ = call("bad.toml", "--set", "mesh.size=4 mm")
    assert code == NOT_CONVERGED
    assert states(said, "actuator.wall -2 mm failed")
    assert "2 designs, 1 failed." in said
    for options, read in (((), 2), (("--retry",), 1)):
        _, said, _ = call("bad.toml", "--set", "mesh.size=4 mm", "--json", *options)
        assert json.loads(said)["result"]["kept"] == read
    code, _, told = call("bad.toml", "--retry", "--gather")
    assert code == BAD_INPUT
    assert "--retry computes failed runs again, and --gather computes nothing" in told


@pytest.mark.parametrize(
    ("old", "new", "sentence"),
    [
        ("actuator.wall =", "actuator.wal =", "study.toml:5: factors.actuator.wal: with '2 mm', the job has a problem"),
        ('"2 mm",', '"2 kPa",', "study.toml:5: factors.actuator.wall: actuator.wall: '2 kPa' is a pressure"),
        ('"2 mm",', "2,", "factors.actuator.wall: 2 needs a unit, such as '2 mm'"),
        ('["2 mm", "2.5 mm"]', '"2 mm"', "'2 mm' is neither a list of levels nor a range"),
        ('["2 mm", "2.5 mm"]', "[]", "the list is empty"),
        ("levels = 2", "level = 2", "unknown key of a factor 'level'; did you mean 'levels'?"),
        ("levels = 2", "levels = 1", "levels is 1; allowed is a whole number of 2 or more"),
        ('low = "0.1 MPa"', 'low = "1 MPa"', "goes from 1e+06 to 140000; low must be below high"),
        ("[sweep]", "[sweeps]", "study.toml:8: sweeps: unknown key 'sweeps'; did you mean 'sweep'?"),
        ('job = "tube.toml"', 'jobs = "tube.toml"', "'job' is missing; name a job file"),
        ("tube.toml", "tub.toml", "did you mean 'tube.toml'?"),
        ("at = {", "att = {", "study.toml:10: sweep.att: unknown key 'att'; did you mean 'at'?"),
        ('"10 kPa"', '"10 kilo"', "sweep.at: pressure: '10 kilo' is no number with a unit"),
        ("pressure =", "presure =", "study.toml:10: sweep.at: unknown column 'presure'; did you mean 'pressure'?"),
        ('pressure = "10', 'cavity_volume = "10', "sweep.at: 'cavity_volume' is not measured; add it to the measures"),
        ('"10 kPa"', '"10 mm"', "sweep.at: '10 mm' is a length"),
        ('"tip_displacement_x"', '"tip_displacement_q"', "did you mean 'tip_displacement"),
        ("[sweep]", '[sweep]\ndesign = "sobl"', "study.toml:9: sweep.design: unknown design 'sobl'; did you"),
        ("[sweep]", '[sweep]\ndesign = "sobol"', "sweep.samples: 'samples' is missing"),
        ("[sweep]", '[sweep]\ndesign = "sobol"\nsamples = 0', "allowed is 1 to 100000"),
        ("[sweep]", '[sweep]\ndesign = "table"', "a table names its factors itself"),
        ("[sweep]", "[sweep", "this is not valid TOML"),
        ("[sweep]", "[optimize]", "the table [sweep] is missing"),
    ],
)
def test_mistakes_are_answered(call, folder, old, new, sentence):
    assert STUDY.replace(old, new) != STUDY
    (folder / "study.toml").write_text(STUDY.replace(old, new), encoding="utf-8")
    code, _, said = call("study.toml", "--dry-run")
    assert code == BAD_INPUT
    assert sentence in said


def test_a_study_file_that_is_missing(call):
    code, _, said = call("wals.toml")
    assert code == BAD_INPUT
    assert states(said, "'wals.toml'", "'walls.toml'")


def test_interrupted_and_called_again(folder):
    """Ctrl-C ends the study and its workers, says how to go on, and the same call does."""
    (folder / "again.toml").write_text(f"{STUDY}mesh_error = false\n", encoding="utf-8")
    command = [sys.executable, "-m", "turgor", "sweep", "again.toml", "--output", "again"]
    runs = folder / "again" / "runs"
    paths = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
    study = subprocess.Popen([*command, "--processes", "2"], cwd=folder, env=paths, stderr=subprocess.PIPE, text=True)
    while study.poll() is None and not list(runs.glob("*.json")):
        time.sleep(0.02)
    study.send_signal(signal.SIGINT)
    _, said = study.communicate(timeout=60)
    before = {file: file.stat().st_mtime_ns for file in runs.glob("*.json")}
    assert before
    if study.returncode:  # unless it was done by then
        assert study.returncode == 128 + signal.SIGINT
        assert "interrupted; finished runs are saved in again, and the same command continues from there." in said
    assert subprocess.run(command, cwd=folder, env=paths, capture_output=True, check=False).returncode == DONE
    assert len(list(runs.glob("*.json"))) == 4
    assert all(file.stat().st_mtime_ns == time_ for file, time_ in before.items())
