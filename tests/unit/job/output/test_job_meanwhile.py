"""What a run does at the same time: it loads and measures while it solves, and draws while it estimates."""

import errno
import sys
from dataclasses import replace
from threading import Event, current_thread, enumerate

import pytest

import turgor as tg
from refused import refused
from turgor.core.results.fields import state_fields
from turgor.core.results.files.response_csv import read_response
from turgor.foundation.errors import TurgorError
from turgor.job import run
from turgor.job.output import growing_files
from turgor.job.read import read_job
from turgor.job.run import run_job
from turgor.views.viewer import scene

JOB = """\
[actuator]
type = "fast_pneunet"
chambers = 1
length = "10 mm"

[mesh]
size = "6 mm"

[materials]
body = { law = "neo_hooke", C10 = "110 kPa" }
base = { law = "neo_hooke", C10 = "110 kPa" }

[loads]
pressure = "2 kPa"

[procedure]
type = "static"
first_step = 0.5
max_step = 0.5

[output]
fields = false
pictures = false
report = false
measures = ["bending_angle"]
"""


@pytest.fixture
def job(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "finger.toml").write_text(JOB, encoding="utf-8")
    monkeypatch.setattr(run, "_with_errors", lambda job, response, *_: (response, ()))
    return read_job(tmp_path / "finger.toml")


@pytest.mark.filterwarnings("error::pytest.PytestUnhandledThreadExceptionWarning")
@pytest.mark.parametrize(("threads", "loader"), [(2, "turgor-loads"), (1, None)])
def test_what_is_needed_later_is_loaded_on_another_thread(job, tmp_path, monkeypatch, threads, loader):
    (tmp_path / "late_part.py").write_text("from threading import current_thread\nNAME = current_thread().name\n")
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.setattr(run, "AFTERWARDS", ("late_part", "a_part_that_is_missing"))
    monkeypatch.delitem(sys.modules, "late_part", raising=False)
    assert run_job(job, threads=threads).solution.complete
    for thread in enumerate():
        if thread.name == "turgor-loads":
            thread.join()
    assert getattr(sys.modules.get("late_part"), "NAME", None) == loader


def test_a_picture_that_fails_does_not_wait_for_the_estimate(job, tmp_path, monkeypatch):
    failed = Event()

    def draw(*_):
        failed.set()
        raise TurgorError("the picture 'deformed' cannot be drawn.")

    def estimate(_, response, *others):
        assert failed.wait(60)
        return response, ()

    monkeypatch.setattr("turgor.job.output.write.draw_path", draw)
    monkeypatch.setattr(run, "_with_errors", estimate)
    with refused("'deformed'"):
        run_job(job, threads=2)
    assert tg.load(tmp_path / "finger-results").complete


def test_an_estimate_that_fails_is_reported_after_the_pictures(job, monkeypatch):
    drawn = []

    def estimate(*_):
        raise TurgorError("the estimate of 'bending_angle' fails.")

    monkeypatch.setattr("turgor.job.output.write.draw_path", lambda *_: drawn.append(1))
    monkeypatch.setattr(run, "_with_errors", estimate)
    with refused("'bending_angle'"):
        run_job(job, threads=2)
    assert drawn


@pytest.mark.parametrize(("threads", "writer"), [(2, "turgor-tables_0"), (1, "MainThread")])
def test_states_are_measured_while_the_next_step_is_solved(job, tmp_path, monkeypatch, threads, writer):
    writers, write = [], growing_files.write_steps

    def noted(file, solution):
        writers.append(current_thread().name)
        write(file, solution)

    monkeypatch.setattr(growing_files, "write_steps", noted)
    outcome = run_job(job, threads=threads)
    assert set(writers) == {writer}
    written = read_response(tmp_path / "finger-results" / "response.csv")
    assert len(written) == len(outcome.solution.states) == 3


def test_a_table_that_cannot_be_written_on_another_thread_ends_the_run(job, monkeypatch):
    def full(file, solution):
        raise PermissionError(errno.EACCES, "denied", str(file))

    monkeypatch.setattr(growing_files, "write_steps", full)
    with pytest.raises(PermissionError):
        run_job(job, threads=2)


def test_fields_of_a_state_are_computed_once(job, monkeypatch):
    computed, compute = [], state_fields.cell_fields

    def counted(model, displacement, *others):
        computed.append(float(abs(displacement).max()))
        return compute(model, displacement, *others)

    monkeypatch.setattr(state_fields, "cell_fields", counted)
    outcome = run_job(replace(job, output=replace(job.output, fields=True, measures=("von_mises_p99",))), threads=2)
    assert len(computed) == len(set(computed)) == len(outcome.solution.states)


def test_the_scene_of_a_report_does_not_wait_for_the_estimate(job, tmp_path, monkeypatch):
    drawn, shown, collected = [], scene.shown_fields, Event()

    def counted(*given):
        drawn.append(given)
        collected.set()
        return shown(*given)

    def estimate(_, response, *others):
        assert collected.wait(20)
        return response, ()

    monkeypatch.setattr(scene, "shown_fields", counted)
    monkeypatch.setattr(run, "_with_errors", estimate)
    run_job(replace(job, output=replace(job.output, report=True)), threads=2)
    assert len(drawn) == 1
    assert "von Mises stress" in (tmp_path / "finger-results" / "report.html").read_text(encoding="utf-8")
