"""Runs in processes: kept as they end, read again, failures as sentences, one thread each."""

import json
import os
import subprocess
import sys
from dataclasses import replace

import numpy as np
from study_cases import PICTURE, breaks, dies, line, refuses

from refused import refused, states
from turgor.studies.runs.executors.run_outcome import compute
from turgor.studies.runs.files.run_files import save_run, saved_run
from turgor.studies.runs.run import Computed, Run
from turgor.studies.runs.run_all import run_all


def lines(log: str = "", slopes=(1e-5, 2e-5, 3e-5)) -> list[Run]:
    return [Run(name=f"slope {slope}", function=line, values={"slope": slope, "log": log}) for slope in slopes]


def test_what_is_kept_is_read_again(tmp_path):
    run, result = lines()[0], line(1e-5)
    assert saved_run(run, tmp_path) is None
    save_run(run, replace(result, seconds=1.25), tmp_path)
    read = saved_run(run, tmp_path)
    assert read is not None
    assert read.response.names == result.response.names
    for name in read.response.names:
        np.testing.assert_allclose(read.response.column(name), result.response.column(name), rtol=1e-15)
    assert (read.picture, read.seconds, read.response.message) == (PICTURE, 1.25, "ended")
    assert str(read.response.source) == "a line"


def test_what_is_computed_is_what_a_later_call_reads(tmp_path):
    """To the last bit, which a table does not always keep: an analysis that goes on finds what it finds at once."""
    run = Run(name="third", function=line, values={"slope": 1.01e-5})
    ended = compute(run, tmp_path)
    read = saved_run(run, tmp_path)
    assert ended.result is not None and read is not None
    for name in read.response.names:
        assert np.array_equal(read.response.column(name), ended.result.response.column(name))
    assert read.seconds == ended.result.seconds


def test_notes_are_written_last(tmp_path):
    """A run that was killed between its table and its notes has not ended."""
    run = lines()[0]
    save_run(run, line(1e-5), tmp_path)
    (tmp_path / f"{run.key}.json").unlink()
    assert saved_run(run, tmp_path) is None


def test_equal_questions_have_equal_keys_whatever_their_names():
    first, other = lines()[:2]
    assert replace(first, name="another") != first
    assert replace(first, name="another").key == first.key
    assert other.key != first.key
    assert replace(first, function=refuses).key != first.key


def test_runs_that_no_process_could_repeat_are_refused():
    with refused("'a'", "<lambda>", "module"):
        Run(name="a", function=lambda: Computed(response=line(1.0).response))
    with refused("'b'", "set", "JSON"):
        Run(name="b", function=line, values={"slope": {1}})


def test_each_is_computed_once_in_a_process_with_one_thread(tmp_path):
    log = tmp_path / "log"
    runs = lines(str(log))
    seen = []
    first = run_all([*runs, runs[0]], tmp_path / "runs", processes=2, progress=seen.append)
    assert [each.run.name for each in first.values()] == [run.name for run in runs]
    assert sorted(log.read_text().splitlines()) == ["1e-05 1", "2e-05 1", "3e-05 1"]
    assert len(seen) == 3
    assert not any(each.again for each in seen)
    again = run_all(runs, tmp_path / "runs")
    assert all(each.again for each in again.values())
    assert len(log.read_text().splitlines()) == 3
    told = json.loads((tmp_path / "runs" / f"{runs[0].key}.json").read_text())
    assert told["values"]["slope"] == 1e-5
    assert told["cpu_seconds"] >= 0


def test_a_run_that_fails_is_told_and_the_others_go_on(tmp_path):
    runs = [Run(name="refused", function=refuses), Run(name="broken", function=breaks), lines()[0]]
    ended = run_all(runs, tmp_path)
    failed, broken, good = ended.values()
    assert failed.problem == "wall is -1 mm; allowed is above 0 mm."
    assert failed.result is None
    assert "ZeroDivisionError: of the study" in broken.problem
    assert good.result is not None
    assert run_all(runs[:1], tmp_path)[runs[0].key].again
    assert not run_all(runs[:1], tmp_path, retry=True)[runs[0].key].again


def test_a_worker_that_dies_is_told(tmp_path):
    ended = run_all([Run(name="dead", function=dies)], tmp_path)
    (only,) = ended.values()
    assert states(only.problem, "process", "killed")


def test_a_process_at_least():
    with refused("processes", 0, "1 or more"):
        run_all((), None, processes=0)  # type: ignore[arg-type]


SCRIPT = """
import sys
from pathlib import Path

from study_cases import line
from turgor.studies.runs.run import Run
from turgor.studies.runs.run_all import run_all
from turgor.studies.runs.run_all import run_all
from turgor.studies.runs.executors.run_outcome import compute
from turgor.studies.runs.run import Run


def steep(slope):
    return line(slope)


if __name__ == "__main__":
    ended = run_all([Run(name="a", function=steep, values={"slope": 1e-5})], Path("runs"))
    print([(each.result is not None, each.again) for each in ended.values()])
"""


def test_functions_of_a_script_are_found_again(tmp_path):
    (tmp_path / "study.py").write_text(SCRIPT, encoding="utf-8")
    paths = os.pathsep.join(sys.path)
    said = [
        subprocess.run(
            [sys.executable, "study.py"], cwd=tmp_path, env={**os.environ, "PYTHONPATH": paths}, capture_output=True,
            text=True, check=True,
        ).stdout.strip()
        for _ in range(2)
    ]  # fmt: skip
    assert said == ["[(True, False)]", "[(True, True)]"]
