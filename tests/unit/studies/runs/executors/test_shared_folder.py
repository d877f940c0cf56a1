"""Several calls of one study in one folder: each run is computed once, and that of a killed process is taken over."""

import os
import signal
import subprocess
import sys
import time
from collections import Counter
from pathlib import Path

import pytest
from filelock import FileLock
from study_cases import fails, waits

import turgor as tg
from turgor.studies.runs.evaluations import Evaluations
from turgor.studies.runs.executors import claims
from turgor.studies.runs.executors.run_outcome import Ended
from turgor.studies.runs.run import Run

SCRIPT = """
import sys
import time
from pathlib import Path

import turgor as tg
from test_shared_folder import gated

if __name__ == "__main__":
    name, processes, others = sys.argv[1:]
    Path(name).touch()
    while len(list(Path().glob("ready-*"))) < int(others):
        time.sleep(0.01)
    with tg.studies.saved_in("runs", processes=int(processes)) as runs:
        ended = runs.of(gated(Path.cwd()))
    print([each.problem for each in ended])
"""

NUMBERS = range(40)


def gated(folder: Path) -> list[Run]:
    given = {"log": str(folder / "log"), "gate": str(folder / "gate")}
    return [Run(name=str(each), function=waits, values={"number": each, **given}) for each in NUMBERS]


def started(folder: Path, name: str, processes: int, others: int = 1) -> "subprocess.Popen[str]":
    (folder / "study.py").write_text(SCRIPT, encoding="utf-8")
    command = [sys.executable, "study.py", f"ready-{name}", str(processes), str(others)]
    paths = os.pathsep.join(sys.path)
    environment = {**os.environ, "PYTHONPATH": paths}
    return subprocess.Popen(command, cwd=folder, env=environment, stdout=subprocess.PIPE, text=True)


def begun(folder: Path) -> Counter:
    log = folder / "log"
    lines = log.read_text(encoding="utf-8").splitlines() if log.exists() else []
    return Counter(int(line.split()[1]) for line in lines)


def until(true, seconds: float = 60.0) -> None:
    end = time.monotonic() + seconds
    while not true():
        assert time.monotonic() < end
        time.sleep(0.02)


def test_two_calls_compute_each_run_once_and_a_killed_one_is_taken_over(tmp_path):
    """Three calls begin together. The one that holds the first run is killed as it computes; nothing else is lost."""
    calls = [started(tmp_path, name, processes, 3) for name, processes in (("a", 1), ("b", 1), ("c", 2))]
    try:
        until(lambda: len(begun(tmp_path)) == len(NUMBERS))
        assert begun(tmp_path) == Counter(NUMBERS), "each was begun once, and the first one still waits"
        lines = (tmp_path / "log").read_text(encoding="utf-8").splitlines()
        holder = next(int(line.split()[2]) for line in lines if line.startswith("begun 0 "))
        held = next((each for each in calls if each.pid == holder), calls[2])  # or a worker of the third one
        held.send_signal(signal.SIGKILL)
        held.wait()
        until(lambda: begun(tmp_path)[0] == 2)  # another call has taken it over
        (tmp_path / "gate").touch()
        told = [each.communicate(timeout=60)[0].strip() for each in calls if each is not held]
    finally:
        for each in calls:
            each.kill()
    assert told == [str([""] * len(NUMBERS))] * 2
    assert begun(tmp_path) == Counter([0, *NUMBERS])
    kept = {each.suffix for each in (tmp_path / "runs").iterdir()}
    assert kept == {".json", ".csv"}, "no lock stays behind"


def test_a_lock_that_a_killed_process_left_behind_locks_nothing(tmp_path):
    (tmp_path / "gate").touch()
    (tmp_path / "runs").mkdir()
    runs = gated(tmp_path)[:2]
    for run in runs:
        (tmp_path / "runs" / f"{run.key}.lock").touch()
    ended = tg.studies.saved_in(tmp_path / "runs").of(runs)
    assert [each.problem for each in ended] == ["", ""]
    assert not list((tmp_path / "runs").glob("*.lock"))


def test_the_lock_of_a_run_that_has_ended_goes(tmp_path):
    """A process that is killed between the end of a run and its unlocking leaves the file of the lock."""
    (tmp_path / "gate").touch()
    runs = gated(tmp_path)[:2]
    tg.studies.saved_in(tmp_path / "runs").of(runs)
    for run in runs:
        (tmp_path / "runs" / f"{run.key}.lock").touch()
    with FileLock(tmp_path / "runs" / f"{runs[0].key}.lock"):  # the process is still there
        assert all(each.again for each in tg.studies.saved_in(tmp_path / "runs").of(runs))
        assert [each.stem for each in (tmp_path / "runs").glob("*.lock")] == [runs[0].key]
    tg.studies.saved_in(tmp_path / "runs").of(runs)
    assert not list((tmp_path / "runs").glob("*.lock"))


def test_a_file_system_without_locks_computes_without(tmp_path, monkeypatch):
    def refused(*_):
        raise OSError(38, "Function not implemented")

    (tmp_path / "gate").touch()
    monkeypatch.setattr("turgor.studies.runs.executors.claims.FileLock.acquire", refused)
    ended = tg.studies.saved_in(tmp_path / "runs").of(gated(tmp_path)[:2])
    assert [each.problem for each in ended] == ["", ""]


WAYS = ("refused", "early", "lacks", "broken", "good")


def ends(folder: Path, ways=WAYS) -> list[Run]:
    return [Run(name=each, function=fails, values={"log": str(folder / "log"), "how": each}) for each in ways]


@pytest.mark.parametrize("processes", [1, 2])
def test_failures_that_are_told_are_kept_and_others_tried_again(tmp_path, processes):
    """A sentence of turgor would come again; a mistake in Python, a missing file or a killed process need not."""
    ways = WAYS if processes == 1 else (*WAYS, "killed")  # a worker, not this process
    with tg.studies.saved_in(tmp_path / "runs", processes=processes) as runs:
        first = runs.of(ends(tmp_path, ways))
    with tg.studies.saved_in(tmp_path / "runs", processes=processes) as runs:
        second = runs.of(ends(tmp_path, ways))
    assert {each.run.name for each in second if each.again} == {"refused", "early", "good"}
    assert [each.problem.splitlines()[-1:] for each in second] == [each.problem.splitlines()[-1:] for each in first]
    (tmp_path / "log").unlink()
    with tg.studies.saved_in(tmp_path / "runs", processes=processes, retry=True) as runs:
        third = runs.of(ends(tmp_path, ways))
        runs.of(ends(tmp_path, ways))  # asked for twice, computed once
    assert sorted((tmp_path / "log").read_text(encoding="utf-8").split()) == sorted({*ways} - {"good"})
    assert [each.again for each in third] == [each.run.name == "good" for each in third]


def test_a_failure_that_is_mended_is_no_failure_any_more(tmp_path, monkeypatch):
    """A row that ended early is computed again and fails, and is then computed again and ends well."""
    (run,) = ends(tmp_path, ["early"])
    folder = tmp_path / "runs"
    Evaluations(folder=folder).of([run])
    for how, problem in (("refused", "wall is -1 mm; allowed is above 0 mm."), ("good", "")):
        monkeypatch.setattr(Run, "call", lambda self, how=how: fails(str(tmp_path / "log"), how))
        (ended,) = Evaluations(folder=folder, retry=True).of([run])
        assert (ended.problem, ended.again) == (problem, False)
        (read,) = Evaluations(folder=folder).of([run])
        assert (read.problem, read.again) == (problem, True)


def test_a_run_that_has_ended_is_read_without_a_lock(tmp_path, monkeypatch):
    """The file of a lock would stay where its holder is killed while it only reads."""
    (tmp_path / "gate").touch()
    run = gated(tmp_path)[0]
    with tg.studies.saved_in(tmp_path / "runs") as runs:
        runs.of([run])
    monkeypatch.setattr(claims, "_locked", lambda file: pytest.fail("locked"))
    read = claims.Claims([run], tmp_path / "runs").take()
    assert isinstance(read, Ended)
    assert read.problem == ""
