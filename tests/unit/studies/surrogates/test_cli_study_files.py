"""Commands that fit a study and tell its sensitivities, called with a study file: they compute it first."""

import os
import signal
import subprocess
import sys
import time

import pytest

from calibration_cases import JOB
from turgor.cli import main
from turgor.cli.exits import BAD_INPUT, DONE
from turgor.studies import load_study
from turgor.studies.surrogates.surrogate import Surrogate

STUDY = """
job = "tube.toml"

[factors]
actuator.wall = { low = "2 mm", high = "2.5 mm", levels = 3 }
"materials.body.C10" = { low = "0.1 MPa", high = "0.14 MPa", levels = 3 }

[sweep]
measures = ["tip_displacement_x"]
at = { pressure = "10 kPa" }
mesh_error = false
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("studies")
    (folder / "tube.toml").write_text(JOB, encoding="utf-8")
    (folder / "walls.toml").write_text(STUDY, encoding="utf-8")
    return folder


@pytest.fixture
def call(folder, monkeypatch, capsys):
    monkeypatch.chdir(folder)

    def run(*arguments):
        code = main(arguments)
        said = capsys.readouterr()
        return code, said.out, said.err

    return run


def test_a_study_file_is_computed_once_and_fitted(call, folder):
    code, said, told = call("surrogate", "walls.toml")
    assert code == DONE
    assert told.count(": done, ") == 9
    assert "Written in walls-study: surrogate.turgor" in said
    fitted = Surrogate.load(folder / "walls-study" / "surrogate.turgor")
    assert fitted.measures == ("tip_displacement_x",)
    rows = load_study(folder / "walls-study")
    middle = rows.column("tip_displacement_x", at=("pressure", 10e3))[4]
    values = dict(zip([each.name for each in rows.factors], rows.inputs[4], strict=True))
    assert fitted.predict(values).values["tip_displacement_x"] == pytest.approx(middle, rel=0.02)
    code, said, told = call("sensitivity", "walls.toml", "--set", "mesh.size=3 mm")
    assert code == DONE
    assert told.count(": read, ") == 9  # the same job
    assert said.startswith("tip displacement x: materials.body.C10 8")
    assert "actuator.wall × materials.body.C10" in said


def test_the_job_is_changed(call):
    code, said, told = call(
        "sensitivity", "walls.toml", "--set", "materials.body.C10=1", "--set", "loads.presure=3 kPa"
    )
    assert (code, said) == (BAD_INPUT, "")
    assert "did you mean 'pressure'?" in told


@pytest.mark.parametrize("command", ["surrogate", "sensitivity"])
@pytest.mark.parametrize("option", [("--set", "loads.pressure=3 kPa"), ("--scheduler", "tcp://here:8786")])
def test_what_is_computed_already_is_not_changed(call, command, option):
    code, _, told = call(command, "walls-study", *option)
    assert code == BAD_INPUT
    assert f"{option[0]} goes with a study file, which is computed; 'walls-study' is read as it is." in told


def test_interrupted_it_says_how_to_go_on(folder):
    (folder / "again.toml").write_text(STUDY, encoding="utf-8")
    command = [sys.executable, "-m", "turgor", "surrogate", "again.toml"]
    runs = folder / "again-study" / "runs"
    paths = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
    fitted = subprocess.Popen(command, cwd=folder, env=paths, stderr=subprocess.PIPE, text=True)
    while fitted.poll() is None and not list(runs.glob("*.json")):
        time.sleep(0.02)
    fitted.send_signal(signal.SIGINT)
    _, said = fitted.communicate(timeout=60)
    assert len(list(runs.glob("*.json"))) < 9
    assert fitted.returncode == 128 + signal.SIGINT
    assert "interrupted; finished runs are saved in again-study, and the same command continues from there." in said
