"""Jobs varied by key: numbers, whole numbers, records and choices; and a path that was killed goes on."""

import os
import signal
import subprocess
import sys
from dataclasses import replace

import pytest

import turgor as tg
from calibration_cases import JOB
from refused import refused
from turgor.job.read import read_job
from turgor.studies.runs.jobs.job_changes import job_changes
from turgor.studies.runs.jobs.job_factors import job_factor
from turgor.studies.runs.jobs.job_function import job_function
from turgor.studies.runs.jobs.job_numbers import numbers_of
from turgor.studies.runs.jobs.job_runs import PATHS, path_name, solved_job
from turgor.units import mm

CONTENT = {
    "actuator": {"wall": "1 mm", "chambers": 4},
    "mesh": {"cells": "tetrahedra"},
    "materials": {"body": {"law": "neo_hooke", "C10": "0.1 MPa", "density": "1070 kg/m³"}},
}


def test_values_of_every_kind_as_changes():
    given = {"actuator.wall": 2 * mm, "actuator.chambers": 6, "mesh.cells": "hexahedra", "materials.body": "a/b"}
    assert job_changes(CONTENT, given) == {
        "actuator.wall": "2.0 mm", "actuator.chambers": 6, "mesh.cells": "hexahedra",
        "materials.body": {"library": "a", "record": "b", "density": "1070 kg/m³"},
    }  # fmt: skip
    with refused("'actuator.chambers'", "whole number", 4.5):
        job_changes(CONTENT, {"actuator.chambers": 4.5})


def factor(key, given):
    return job_factor(key, given, CONTENT, numbers_of(CONTENT))


def test_factors_of_a_job():
    assert factor("actuator.wall", ["1 mm", "0.2 cm"]).levels == (1 * mm, 2 * mm)
    assert factor("actuator.chambers", [4, 6]).levels == (4, 6)
    assert factor("actuator.chambers", {"low": 4, "high": 8, "levels": 3}).spaced() == (4, 6, 8)
    assert factor("mesh.cells", ["tetrahedra", "hexahedra"]).is_choice
    assert factor("materials.body", ["a/b", "a/c"]).is_choice
    assert factor("actuator.wall", {"low": "1 mm", "high": "2 mm"}).bounds == (1 * mm, 2 * mm)


@pytest.mark.parametrize(
    ("key", "given", "facts"),
    [
        ("actuator.wal", [1.0], ["'actuator.wal'", "'actuator.wall'"]),
        ("materials.bdy", ["a/b"], ["'materials.bdy'", "'materials.body.C10'"]),
        ("actuator.chambers", [4.5], ["'actuator.chambers'", "whole number", 4.5]),
        ("actuator.wall,materials.body.C10", ["1 mm"], ["length", "pressure", "one value"]),
        ("actuator.wall", [True], ["True", "'actuator.wall'"]),
    ],
)
def test_mistakes_are_answered(key, given, facts):
    with refused(*facts):
        factor(key, given)


def test_one_rubber_harder_than_another(tmp_path):
    (tmp_path / "tube.toml").write_text(JOB, encoding="utf-8")
    (tmp_path / "study.toml").write_text(
        'job = "tube.toml"\n[factors]\n'
        '"materials.body" = ["ecoflex-00-30/yeoh-steck-2019", "elastosil-m4601/neo-hooke-polygerinos-2020"]\n'
        "[sweep]\nmesh_error = false\n",
        encoding="utf-8",
    )
    asked = tg.studies.read_study_file(tmp_path / "study.toml", {"loads.pressure": "2 kPa"})
    kept = tg.studies.saved_in(tmp_path / "runs")
    study = tg.studies.sweep_job(asked, tmp_path / "found", kept)
    soft, hard = study.column("tip_displacement_x")
    assert soft > 3 * hard > 0


def test_a_study_finds_its_runs_whatever_the_job_is_called(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "tube.toml").write_text(JOB, encoding="utf-8")
    (tmp_path / "other").mkdir()
    (tmp_path / "other" / "renamed.toml").write_text(JOB, encoding="utf-8")
    files = ("tube.toml", tmp_path / "tube.toml", tmp_path / "other" / "renamed.toml")
    results = [job_function(read_job(file), tmp_path / f"study-{number}") for number, file in enumerate(files)]
    assert len({each.values["digest"] for each in results}) == 1


SCRIPT = """
import os
import signal
import sys
import turgor.studies.runs.jobs.job_runs as runs

count = 0
real = runs.solve

def killed_after_two_states(*given, **named):
    del named["progress"]
    def progress(iteration, state):
        global count
        count += state is not None
        if count == 3:
            os.kill(os.getpid(), signal.SIGKILL)
    return real(*given, progress=progress, **named)

runs.solve = killed_after_two_states
job, digest = sys.argv[1:]
runs.solved_job(job, digest, {"materials.body.C10": 1.1e5})
"""


def test_a_path_that_was_killed_goes_on(tmp_path, monkeypatch):
    (tmp_path / "tube.toml").write_text(JOB + '\n[procedure]\ntype = "static"\nmax_step = 0.1\n', encoding="utf-8")
    base = job_function(tg.jobs.read_job(tmp_path / "tube.toml"), tmp_path / "study")
    paths = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
    script = subprocess.run(
        [sys.executable, "-c", SCRIPT, base.values["job"], base.values["digest"]], env=paths, check=False
    )
    assert script.returncode == -signal.SIGKILL
    numbers = {"materials.body.C10": 1.1e5}
    path = base.file.parent / PATHS / path_name(base.values["digest"], numbers)
    assert path.is_dir()
    monkeypatch.setattr("turgor.studies.runs.jobs.job_runs.solve", None)  # it is not begun anew
    response = solved_job(**base.values, numbers=numbers).response
    monkeypatch.undo()
    assert not path.parent.exists()
    whole = solved_job(**base.values, numbers=numbers).response
    assert response["tip_displacement_x"] == pytest.approx(whole["tip_displacement_x"], rel=1e-8)


def test_ctrl_c_in_the_middle_of_a_run_ends_the_study_and_not_the_run(tmp_path, monkeypatch):
    (tmp_path / "tube.toml").write_text(JOB + '\n[procedure]\ntype = "static"\nmax_step = 0.1\n', encoding="utf-8")
    base = job_function(tg.jobs.read_job(tmp_path / "tube.toml"), tmp_path / "study")
    states = []

    def interrupting(*given, **named):
        del named["progress"]

        def progress(iteration, state):
            states.extend([] if state is None else [state])
            if len(states) == 3:
                raise KeyboardInterrupt

        return tg.solve(*given, progress=progress, **named)

    monkeypatch.setattr("turgor.studies.runs.jobs.job_runs.solve", interrupting)
    run = base.computation().run({"materials.body.C10": 1.1e5})
    kept = tmp_path / "study" / "runs"
    with pytest.raises(KeyboardInterrupt):
        tg.studies.saved_in(kept).of([run])
    assert len(states) == 3
    assert not kept.exists() or not list(kept.iterdir())
    monkeypatch.setattr("turgor.studies.runs.jobs.job_runs.solve", None)  # the path goes on
    (ended,) = tg.studies.saved_in(kept).of([run])
    assert ended.result.response.status == "converged"
    assert ended.result.response["load_factor"][-1] == 1.0


def test_a_path_that_was_hardly_begun_is_begun_anew(tmp_path):
    (tmp_path / "tube.toml").write_text(JOB, encoding="utf-8")
    base = job_function(tg.jobs.read_job(tmp_path / "tube.toml"), tmp_path / "study")
    path = base.file.parent / PATHS / path_name(base.values["digest"], {})
    path.mkdir(parents=True)
    assert solved_job(**base.values, numbers={}).response.status == "converged"
    assert not path.exists()


def test_paths_of_other_runs_stay_and_their_folder_may_vanish_at_any_time(tmp_path, monkeypatch):
    (tmp_path / "tube.toml").write_text(JOB, encoding="utf-8")
    base = job_function(tg.jobs.read_job(tmp_path / "tube.toml"), tmp_path / "study")
    paths = base.file.parent / PATHS
    other = paths / "other"
    other.mkdir(parents=True)
    real, vanished = os.mkdir, []

    def mkdir(path, *given):
        real(path, *given)
        if not vanished and str(path) == str(paths):  # a run that ends removes the empty folder
            vanished.append(path)
            os.rmdir(path)

    solved_job(**base.values, numbers={})
    assert list(paths.iterdir()) == [other]
    other.rmdir()
    paths.rmdir()
    monkeypatch.setattr("os.mkdir", mkdir)
    assert solved_job(**base.values, numbers={}).response.status == "converged"
    assert vanished
    assert not paths.exists()


def test_a_study_that_was_moved_finds_its_runs_again(tmp_path):
    (tmp_path / "tube.toml").write_text(JOB, encoding="utf-8")
    job = read_job(tmp_path / "tube.toml")
    keys = [
        job_function(job, tmp_path / folder).computation(mesh_error=False).run({"actuator.wall": 2e-3}).key
        for folder in ("a", "b")
    ]
    assert keys[0] == keys[1]
    other = replace(job, output=replace(job.output, measures=("cavity_volume",)))
    assert job_function(other, tmp_path / "c").computation(mesh_error=False).run({"actuator.wall": 2e-3}).key != keys[0]
