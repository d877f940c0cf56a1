"""Expected time and memory of a run: from its counts, and the iterations of the last run of the same job."""

from dataclasses import replace

import pytest

from turgor.cli.app import main
from turgor.job import expected
from turgor.job.expected import Expected, expected_of, remember
from turgor.job.prepare import prepare
from turgor.job.read import read_job

JOB = """
[actuator]
type = "fast_pneunet"
chambers = 2
length = "20 mm"

[mesh]
size = "4 mm"

[materials]
body = { library = "elastosil-m4601", record = "yeoh-mosadegh-2014" }
base = { library = "elastosil-m4601", record = "yeoh-mosadegh-2014" }

[loads]
pressure = "1 kPa"

[output]
pictures = false
report = false
fields = false
mesh_error = false
measures = ["bending_angle"]
"""


@pytest.fixture
def file(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("TURGOR_CACHE", str(tmp_path / "cache"))
    monkeypatch.setattr(expected, "_slowness", lambda: 1.0)
    (tmp_path / "job.toml").write_text(JOB, encoding="utf-8")
    return tmp_path / "job.toml"


def of(file, threads=1, **changes):
    job = read_job(file, changes)
    return expected_of(job, prepare(job)[0], threads)


def test_a_run_that_is_larger_slower_or_touches_takes_longer(file):
    coarse, fine = of(file), of(file, **{"mesh.size": "2 mm"})
    assert fine.seconds > 1.5 * coarse.seconds
    assert fine.memory > coarse.memory
    assert of(file, threads=2).seconds == coarse.seconds  # few unknowns are solved on one thread
    assert of(file, threads=2, **{"mesh.size": "1 mm"}).seconds < of(file, **{"mesh.size": "1 mm"}).seconds
    assert coarse.meeting > 2 * coarse.seconds  # whether its walls meet is open before the first run
    apart = of(file, **{"contact.self_contact": False})
    assert (apart.meeting, apart.seconds) == (None, coarse.seconds)
    estimated = of(file, **{"output.mesh_error": True})
    assert estimated.seconds > 1.3 * coarse.seconds
    assert estimated.memory > coarse.memory


def test_the_time_of_a_draft_is_said_where_it_is_much_shorter(file):
    fine = of(file, **{"mesh.size": "1 mm"})
    assert fine.draft < 0.5 * fine.seconds
    assert of(file, **{"mesh.size": "4 mm"}).draft is None
    assert of(file, **{"mesh.size": "1 mm", "mesh.quality": "draft"}).draft is None


def test_the_next_run_on_any_mesh_knows_the_iterations_of_the_last(file):
    assert main(["run", "job.toml", "--quiet", "--threads", "1"]) in (0, 2)
    after, finer = of(file), of(file, **{"mesh.size": "2 mm"})
    assert (after.meeting, finer.meeting) == (None, None)
    other = of(file, **{"loads.pressure": "2 kPa"})
    assert other.meeting is not None  # another path: the last run says nothing about it


def test_an_unfinished_run_is_not_remembered(file):
    job = read_job(file)

    class Unfinished:
        complete, iterations = False, 3

    remember(job, Unfinished())
    assert of(file).meeting is not None


def test_the_time_of_a_motion_is_open(file):
    text = JOB + '\n[procedure]\ntype = "dynamic"\nduration = "0.1 s"\n'
    file.write_text(text, encoding="utf-8")
    motion = of(file)
    assert motion.seconds is None
    assert "GB" in str(motion)


def test_steps_that_are_shorter_take_more_iterations(file):
    long, short = of(file), of(file, **{"procedure.max_step": 0.05})
    assert short.seconds > 2 * long.seconds


def test_it_is_said_before_the_solve_and_by_the_check(file, capsys):
    assert main(["check", "job.toml"]) == 0
    line = next(line for line in capsys.readouterr().out.splitlines() if line.startswith("Expected: about "))
    assert line.endswith(".")
    assert " GB on " in line
    assert main(["run", "job.toml", "--threads", "1"]) in (0, 2)
    said = capsys.readouterr().out
    assert said.index("expected: about ") < said.index("solving")


def test_it_reads_as_a_sentence():
    known = Expected(seconds=43.0, memory=0.62e9, threads=2, draft=8.2)
    assert str(known) == 'about 45 s and 0.6 GB on 2 threads; quality = "draft" takes about 8 s'
    assert "(3 min if walls meet)" in str(replace(known, meeting=190.0))


def test_the_speed_of_the_machine_is_measured():
    assert 0.05 < expected._slowness() < 50
