"""Runs of jobs that are ended from outside: what their folder holds, and how they go on."""

import errno
import os
import re
import signal
import subprocess
import sys
import time
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import turgor as tg
from refused import refused, states
from turgor.core.engine.fields import cell_fields
from turgor.core.results.files.response_csv import read_response
from turgor.foundation.errors import TurgorError
from turgor.foundation.store.atomic_files import PART
from turgor.foundation.store.folder import Store
from turgor.job.output.manifest import MANIFEST, list_files
from turgor.job.postprocess import measure_folder, report_folder
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
first_step = 0.1
max_step = 0.1

[output]
measures = ["tip_displacement", "cavity_volume"]
fields = false
pictures = false
report = false
mesh_error = false
"""


class Killed(BaseException):
    """Ends a run as a signal would."""


@pytest.fixture(scope="module")
def file(tmp_path_factory) -> Path:
    path = tmp_path_factory.mktemp("job") / "pull.toml"
    path.write_text(JOB, encoding="utf-8")
    return path


@pytest.fixture(scope="module")
def whole(file):
    return run_job(read_job(file), file.parent / "whole", threads=1)


def cut(file: Path, folder: Path, steps: int) -> None:
    """Run a job that ends in the Newton updates after some steps."""
    seen: list[object] = []

    def progress(iteration, state):
        if state is not None:
            seen.append(state)
        elif len(seen) == steps:
            raise Killed

    with pytest.raises(Killed):
        run_job(read_job(file), folder, threads=1, progress=progress)


def test_a_run_that_was_killed_leaves_tables_and_goes_on(file, whole, tmp_path):
    folder = tmp_path / "run"
    cut(file, folder, 4)
    response = read_response(folder / "response.csv")
    assert len(response) == 5
    assert response.column("tip_displacement") == pytest.approx(whole.response.column("tip_displacement")[:5])
    assert len((folder / "steps.csv").read_text().splitlines()) == 5
    assert "step 4: load factor 0.4" in (folder / "run.log").read_text()
    outcome = run_job(read_job(file), folder, resume=True, threads=1)
    assert outcome.solution.converged
    assert np.array_equal(outcome.response.column("tip_displacement"), whole.response.column("tip_displacement"))
    assert (folder / "response.csv").read_bytes() == (whole.folder / "response.csv").read_bytes()


def test_without_a_path_a_run_begins(file, tmp_path):
    outcome = run_job(read_job(file), tmp_path / "new", resume=True, threads=1)
    assert outcome.solution.converged


def test_another_job_does_not_go_on(file, tmp_path):
    cut(file, tmp_path / "run", 2)
    other = file.with_name("other.toml")
    other.write_text(JOB.replace("10 kPa", "11 kPa").replace('name = "rubber"', 'name = "gum"'), encoding="utf-8")
    with refused("loads.pressure", "11 kPa", "10 kPa"):
        run_job(read_job(other), tmp_path / "run", resume=True)


def test_an_unfinished_run_is_named_where_the_folder_is_not_empty(file, whole, tmp_path):
    cut(file, tmp_path / "run", 2)
    with refused(tmp_path / "run", "resume=True", "force=True"):
        run_job(read_job(file), tmp_path / "run")
    with pytest.raises(TurgorError) as raised:
        run_job(read_job(file), whole.folder)
    assert "--resume" not in str(raised.value)


def test_a_folder_serves_one_run_at_a_time(file, tmp_path):
    first = read_job(file)

    def second(iteration, state):
        with refused(tmp_path / "run", "another"):
            run_job(first, tmp_path / "run", force=True)

    assert run_job(first, tmp_path / "run", threads=1, progress=second).solution.converged


def test_an_interrupted_run_writes_its_tables_and_no_pictures(file, tmp_path):
    def progress(iteration, state):
        if iteration.step == 4:
            raise KeyboardInterrupt

    outcome = run_job(read_job(file), tmp_path / "run", threads=1, progress=progress)
    assert outcome.solution.status is tg.Status.INTERRUPTED
    assert [each.name for each in outcome.files] == ["response.csv", "job.lock.toml", "steps.csv", "run.log"]
    assert len(read_response(tmp_path / "run" / "response.csv")) == 4


def test_the_folder_of_a_killed_run_is_measured_and_reported(file, tmp_path):
    folder = tmp_path / "run"
    cut(file, folder, 3)
    assert len(tg.load(folder).states) == 4
    response = measure_folder(folder, ("cavity_volume",))
    assert response.names[-1] == "cavity_volume" and len(response) == 4
    outcome = report_folder(folder, lambda text: None)
    assert outcome.response.status == "interrupted"
    assert (folder / "response.png") in outcome.files
    with refused(tmp_path, "path"):
        measure_folder(tmp_path)


def test_a_report_writes_the_fields_where_they_are_not_those_of_the_path(file, tmp_path):
    job = read_job(file)
    run = run_job(replace(job, output=replace(job.output, fields=True)), tmp_path / "run", threads=1)
    series = run.folder / "vtu" / "state.pvd"
    said = []

    def reported():
        said.clear()
        files = report_folder(run.folder, said.append).files
        assert series in files
        return "writing the fields" in said

    assert not reported()
    first = series.parent / "state_0001.vtu"
    first.unlink()
    assert reported() and first.exists()
    assert not reported()
    os.utime(run.folder / "path" / "index.json")  # the path is younger now
    assert reported()


@pytest.mark.slow
def test_a_report_draws_the_pictures_that_do_not_show_the_path(file, tmp_path):
    job = read_job(file)
    folder = run_job(replace(job, output=replace(job.output, pictures=True)), tmp_path / "run", threads=1).folder
    pictures = [folder / name for name in ("undeformed.png", "deformed.png", "response.png")]

    def drawn():
        for each in pictures:
            os.utime(each, ns=(0, 0)) if each.exists() else None
        files = report_folder(folder, lambda text: None).files
        assert set(pictures) < set(files)
        return [each.name for each in pictures if each.stat().st_mtime_ns > 0]

    assert drawn() == []
    pictures[1].unlink()
    assert drawn() == ["undeformed.png", "deformed.png"]  # they have one view
    pictures[2].write_bytes(b"no picture")
    assert drawn() == ["response.png"]
    lock = folder / "job.lock.toml"
    text = lock.read_text(encoding="utf-8")
    lock.write_text(re.sub('(?m)^name = ".*"', 'name = "other"', text, count=1), encoding="utf-8")
    assert drawn() == [each.name for each in pictures]


@pytest.mark.slow
def test_a_report_evaluates_each_state_once(file, tmp_path, monkeypatch):
    job = read_job(file)
    shown = replace(job.output, pictures=True, report=True)
    folder = run_job(replace(job, output=shown), tmp_path / "run", threads=1).folder
    (folder / "deformed.png").unlink()
    seen = []

    def counted(model, displacement, *rest):
        seen.append(displacement.tobytes())
        return cell_fields(model, displacement, *rest)

    monkeypatch.setattr("turgor.core.results.fields.state_fields.cell_fields", counted)
    outcome = report_folder(folder, lambda text: None)
    assert len(seen) == len(set(seen)) == len(outcome.solution.states) > 3


def _start(file: Path, folder: Path, *more: str) -> subprocess.Popen:
    command = [sys.executable, "-m", "turgor", "run", str(file), "--output", str(folder), "--threads", "1", *more]
    return subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)


@pytest.mark.skipif(os.name != "posix", reason="signals of POSIX")
@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGINT])
def test_a_signal_ends_the_command_within_three_seconds(number, file, tmp_path):
    process = _start(file, tmp_path / "run")
    assert process.stdout is not None
    for line in process.stdout:
        if "step 2" in line:
            break
    process.send_signal(number)
    began = time.monotonic()
    code = process.wait(timeout=60)
    assert time.monotonic() - began < 3.0
    assert code == 128 + number
    assert len(tg.load(tmp_path / "run").states) >= 2  # the step that was told last may not be on disk yet
    assert "--resume" in process.stdout.read()


@pytest.mark.skipif(os.name != "posix", reason="limits of POSIX")
def test_a_full_disk_names_the_file_and_keeps_what_is_there(file, tmp_path):
    small = "import resource, sys; resource.setrlimit(resource.RLIMIT_FSIZE, (90_000, 90_000)); "
    small += "from turgor.cli.app import main; sys.exit(main(sys.argv[1:]))"
    command = [sys.executable, "-c", small, "run", str(file), "--output", str(tmp_path / "run"), "--threads", "1"]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120, check=False)
    assert done.returncode == 1
    assert states(done.stderr, ".turgor'")
    assert (tmp_path / "run" / "job.lock.toml").exists()


@pytest.mark.parametrize("at_end", [False, True])
def test_archives_of_a_killed_run_do_not_stay(at_end, file, whole, tmp_path, monkeypatch):
    """A run is killed between its index and the removal of what the index names no more, on its way and at its end."""
    calls, forget = [], Store.forget

    def killed(store, present):
        calls.append(present)
        if len(calls) > 4 and (len(present) == 2) is at_end:
            raise Killed
        forget(store, present)

    monkeypatch.setattr(Store, "forget", killed)
    with pytest.raises(Killed):
        run_job(read_job(file), tmp_path / "run", threads=1)
    monkeypatch.undo()
    (tmp_path / "run" / "path" / "mine.turgor").write_text("not of turgor")
    run_job(read_job(file), tmp_path / "run", resume=True, threads=1)
    there = {each.name for each in (tmp_path / "run" / "path").iterdir()}
    assert there == {"mine.turgor"} | {each.name for each in (whole.folder / "path").iterdir()}


def test_a_run_that_was_killed_at_its_first_file_begins(file, whole, tmp_path):
    for number, options in enumerate(({}, {"resume": True})):
        folder = tmp_path / str(number)
        folder.mkdir()
        (folder / f"{MANIFEST}{PART}").write_text("{")
        run_job(read_job(file), folder, threads=1, **options)
        assert {each.name for each in folder.iterdir()} == {each.name for each in whole.folder.iterdir()}


def test_files_in_part_of_a_killed_run_are_replaced_too(file, tmp_path):
    cut(file, tmp_path / "run", 2)
    for name in ("vtu/state_0001.vtu", "response.png", "path/state-0-000099.turgor"):
        (tmp_path / "run" / name).parent.mkdir(exist_ok=True)
        (tmp_path / "run" / f"{name}{PART}").write_text("half")
    list_files(tmp_path / "run", ("vtu/state_0001.vtu", "response.png"))
    run_job(read_job(file), tmp_path / "run", force=True, threads=1)
    assert not list((tmp_path / "run").rglob(f"*{PART}"))


def test_a_disk_that_fills_up_on_the_way_keeps_the_states_before(file, whole, tmp_path, monkeypatch):
    written: list[str] = []

    def replace_while_there_is_room(part, final):
        written.append(str(final))
        if len(written) > 15:
            raise OSError(errno.ENOSPC, "No space left on device")
        os.rename(part, final)

    monkeypatch.setattr("turgor.foundation.store.atomic_files.os.replace", replace_while_there_is_room)
    with refused("[Errno 28]", error=OSError) as raised:
        run_job(read_job(file), tmp_path / "run", threads=1)
    assert str(raised.value.filename) == written[-1]
    monkeypatch.undo()
    assert 1 < len(tg.load(tmp_path / "run").states) < len(whole.solution.states)
    again = run_job(read_job(file), tmp_path / "run", resume=True, threads=1)
    assert np.array_equal(again.response.column("tip_displacement"), whole.response.column("tip_displacement"))
