"""Worker processes: they stay over batches, one that dies takes only its run with it, and they end with the study."""

import os
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

from study_cases import killed, refuses, slow

import turgor as tg
from refused import refused, states
from turgor.studies.runs.evaluations import Evaluations
from turgor.studies.runs.executors.worker_processes import Workers
from turgor.studies.runs.files.run_files import saved_run
from turgor.studies.runs.run import Run


def clocks(log: Path, numbers, seconds: float = 0.2) -> list[Run]:
    given = {"log": str(log), "seconds": seconds}
    return [Run(name=str(each), function=slow, values={"number": each, **given}) for each in numbers]


def told(log: Path, what: str) -> list[list[str]]:
    lines = log.read_text(encoding="utf-8").splitlines() if log.exists() else []
    return [line.split()[1:] for line in lines if line.startswith(what)]


def alive(process: int) -> bool:
    try:
        state = Path(f"/proc/{process}/stat").read_text(encoding="utf-8").rsplit(")", 1)[1].split()[0]
    except FileNotFoundError:
        return False
    return state != "Z"


def until(true, seconds: float = 60.0) -> None:
    end = time.monotonic() + seconds
    while not true():
        assert time.monotonic() < end
        time.sleep(0.02)


def test_processes_stay_over_batches(tmp_path):
    log = tmp_path / "log"
    with tg.studies.saved_in(tmp_path / "runs", processes=2) as runs:
        first = runs.of(clocks(log, range(4)))
        runs.of(clocks(log, range(2, 8)))
    assert [each.run.name for each in first] == ["0", "1", "2", "3"]
    assert sorted(number for number, _ in told(log, "ended")) == list("01234567")
    processes = {process for _, process in told(log, "ended")}
    assert len(processes) == 2
    assert not any(alive(int(each)) for each in processes)


def test_without_a_folder_results_come_back(tmp_path):
    with Evaluations(executor=Workers(processes=1)) as runs:
        (only,) = runs.of(clocks(tmp_path / "log", [7]))
    assert only.result is not None
    assert only.result.response["pressure"][-1] == 7.0


def test_a_worker_that_is_killed_takes_only_its_run_with_it(tmp_path):
    log = tmp_path / "log"
    runs = [Run(name="dead", function=killed), *clocks(log, range(5)), Run(name="refused", function=refuses)]
    with tg.studies.saved_in(tmp_path / "runs", processes=2) as evaluations:
        dead, *others, failed = evaluations.of(runs)
    assert states(dead.problem, "process", "SIGKILL")
    assert all(each.result is not None for each in others)
    assert failed.problem == "wall is -1 mm; allowed is above 0 mm."


def test_a_worker_that_is_killed_between_batches_is_replaced(tmp_path):
    log = tmp_path / "log"
    with tg.studies.saved_in(tmp_path / "runs", processes=2) as runs:
        runs.of(clocks(log, [1, 2]))
        os.kill(int(told(log, "ended")[0][1]), signal.SIGKILL)
        time.sleep(0.1)
        again = runs.of(clocks(log, [3, 4, 5]))
    assert [each.problem for each in again] == ["", "", ""]


def test_a_worker_killed_from_outside_as_it_computes(tmp_path):
    log = tmp_path / "log"

    def kill() -> None:
        until(lambda: told(log, "begun"))
        os.kill(int(told(log, "begun")[0][1]), signal.SIGKILL)

    killer = threading.Thread(target=kill)
    killer.start()
    with tg.studies.saved_in(tmp_path / "runs", processes=2) as runs:
        ended = runs.of(clocks(log, range(6), seconds=0.4))
    killer.join()
    lost = [each for each in ended if each.problem]
    assert [each.run.name for each in lost] == [told(log, "begun")[0][0]]
    with tg.studies.saved_in(tmp_path / "runs", processes=2) as runs:  # the next call computes the lost one alone
        again = runs.of(clocks(log, range(6), seconds=0.4))
    assert [each.run.name for each in again if not each.again] == [lost[0].run.name]


SCRIPT = """
import sys
from pathlib import Path

import turgor as tg
from test_workers import clocks

if __name__ == "__main__":
    with tg.studies.saved_in("runs", processes=2) as runs:
        runs.of(clocks(Path("log").absolute(), range(8), seconds=0.4))
"""


def started(folder: Path, script: str = SCRIPT) -> "subprocess.Popen[bytes]":
    (folder / "study.py").write_text(script, encoding="utf-8")
    paths = os.pathsep.join(sys.path)
    return subprocess.Popen([sys.executable, "study.py"], cwd=folder, env={**os.environ, "PYTHONPATH": paths})


def test_a_study_that_is_killed_goes_on_and_computes_nothing_twice(tmp_path):
    """kill -9 of the study ends its workers at once; each run that has ended is kept, and is not begun again."""
    log = tmp_path / "log"
    study = started(tmp_path)
    until(lambda: len(told(log, "ended")) >= 3)
    study.kill()
    study.wait()
    processes = {int(process) for _, process in told(log, "begun")}
    until(lambda: not any(alive(each) for each in processes))
    before = [number for number, _ in told(log, "ended")]
    assert 3 <= len(before) < 8
    lost = [each for each in clocks(log, range(8), seconds=0.4)
            if each.name in before and saved_run(each, tmp_path / "runs") is None]  # fmt: skip
    assert len(lost) <= 2  # killed between the end of a function and its file
    assert started(tmp_path).wait() == 0
    ended = [number for number, _ in told(log, "ended")]
    assert len(ended) == 8 + len(lost)
    assert set(ended) == set("01234567")


def test_workers_end_at_once_with_the_study(tmp_path):
    """Nothing is computed for nobody: runs of ten minutes end within seconds of the study."""
    log = tmp_path / "log"
    study = started(tmp_path, SCRIPT.replace("seconds=0.4", "seconds=600.0"))
    until(lambda: len(told(log, "begun")) == 2)
    study.kill()
    study.wait()
    until(lambda: not any(alive(int(process)) for _, process in told(log, "begun")))


def test_scripts_that_import_themselves_are_told(tmp_path):
    (tmp_path / "study.py").write_text(SCRIPT.replace('__name__ == "__main__"', "True"), encoding="utf-8")
    paths = os.pathsep.join(sys.path)
    said = subprocess.run(
        [sys.executable, "study.py"], cwd=tmp_path, env={**os.environ, "PYTHONPATH": paths}, capture_output=True,
        text=True, check=False,
    )  # fmt: skip
    assert said.returncode == 1
    assert states(said.stderr, "worker processes")


def test_a_process_at_least(tmp_path):
    with refused("processes", 0, "1 or more"):
        tg.studies.saved_in(tmp_path, processes=0)
