"""Commands whose study is computed by the workers of a Dask scheduler: one scheduler for all of them."""

import csv
import json

import pytest

import turgor as tg
from calibration_cases import JOB
from dask_cluster import dask_cluster
from turgor.cli import main
from turgor.cli.exits import DONE
from turgor.studies.surrogates.surrogate import Surrogate

STUDY = """
job = "tube.toml"

[factors]
actuator.wall = { low = "2 mm", high = "2.5 mm", levels = LEVELS }

[sweep]
measures = ["tip_displacement_x"]
at = { pressure = "10 kPa" }
mesh_error = false
"""


@pytest.fixture(scope="module")
def scheduler():
    with dask_cluster(workers=2) as (address, _):
        yield address


@pytest.fixture
def call(tmp_path, monkeypatch, capsys, scheduler):
    """Call a command on the scheduler, in a folder of its own; nothing is computed on this side."""
    (tmp_path / "tube.toml").write_text(JOB, encoding="utf-8")
    monkeypatch.chdir(tmp_path)

    def run(command, levels):
        (tmp_path / "walls.toml").write_text(STUDY.replace("LEVELS", str(levels)), encoding="utf-8")
        with monkeypatch.context() as patched:
            patched.setattr("turgor.studies.runs.executors.worker_processes.Workers.compute", None)
            patched.setattr("turgor.studies.runs.jobs.job_runs.solve", None)
            code = main([command, "walls.toml", "--scheduler", scheduler])
        said = capsys.readouterr()
        return code, said.out, said.err

    return run


def moved(folder):
    with (folder / "study.csv").open(encoding="utf-8", newline="") as file:
        return [row["tip_displacement_x (mm)"] for row in csv.DictReader(file)]


def test_a_sweep(call, tmp_path):
    code, said, _ = call("sweep", 2)
    assert code == DONE
    assert "2 designs, 0 failed" in said
    here = tg.studies.sweep_job(tg.studies.read_study_file("walls.toml"), "here", tg.studies.Evaluations())
    values = here.column("tip_displacement_x", at=("pressure", 10e3)) / 1e-3
    assert [float(each) for each in moved(tmp_path / "walls-study")] == pytest.approx(values, rel=1e-8)


def test_a_surrogate(call, tmp_path):
    code, said, told = call("surrogate", 5)
    assert code == DONE
    assert told.count(": done, ") == 5
    assert "Written in walls-study: surrogate.turgor" in said
    fitted = Surrogate.load(tmp_path / "walls-study" / "surrogate.turgor")
    result = fitted.predict({"actuator.wall": 2e-3})["tip_displacement_x"]
    assert result == pytest.approx(float(moved(tmp_path / "walls-study")[0]) * 1e-3, rel=0.01)


def test_a_sensitivity(call, tmp_path):
    code, said, told = call("sensitivity", 2)
    assert code == DONE
    assert told.count(": done, ") == 2
    assert said.startswith("tip displacement x: actuator.wall 100 %")
    index = json.loads((tmp_path / "walls-study" / "study.json").read_text(encoding="utf-8"))
    assert [each["problem"] for each in index["rows"]] == [""] * 2
