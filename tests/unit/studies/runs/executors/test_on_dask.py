"""Studies on Dask, with a real scheduler and real workers; one of them is killed in the middle."""

import os
import signal
import time
from dataclasses import replace

from study_cases import refuses, slow

import turgor as tg
from dask_cluster import dask_cluster
from refused import refused
from turgor.studies.runs.evaluations import Evaluations
from turgor.studies.runs.executors import dask_workers
from turgor.studies.runs.executors.dask_workers import OnDask
from turgor.studies.runs.files.run_files import saved_run
from turgor.studies.runs.run import Run
from turgor.studies.runs.settings import RUNS


def clocks(log, numbers, seconds):
    given = {"log": str(log), "seconds": seconds}
    return [Run(name=str(each), function=slow, values={"number": each, **given}) for each in numbers]


def told(log, what):
    lines = log.read_text(encoding="utf-8").splitlines() if log.exists() else []
    return [line.split()[1:] for line in lines if line.startswith(what)]


def test_a_killed_worker_costs_its_own_run_only_and_another_worker_repeats_it(tmp_path):
    log, folder = tmp_path / "log", tmp_path / "runs"
    runs = clocks(log, range(8), seconds=0.4)
    victim = []

    def kill_once(_):
        if not victim:
            while not (running := {p for n, p in told(log, "begun")} - {str(os.getpid())}):
                time.sleep(0.01)
            victim.append(sorted(running)[0])
            os.kill(int(victim[0]), signal.SIGKILL)

    with dask_cluster(workers=2) as (address, workers):
        assert len(workers) == 2
        study = Evaluations(folder=folder, executor=OnDask(scheduler=address), progress=kill_once)
        ended = study.of(runs)
        assert [each.problem for each in ended] == [""] * 8
        assert [each.run.name for each in ended] == list("01234567")
        assert all(saved_run(run, folder) is not None for run in runs)
        processes = {process for _, process in told(log, "begun")}
        assert len(processes) == 2
        assert victim[0] in processes
        begun = [number for number, _ in told(log, "begun")]
        assert 8 <= len(begun) <= 10, "the killed worker may have begun one run, and been sent one more"
        again = Evaluations(folder=folder, executor=OnDask(scheduler=address)).of(runs)
        assert all(each.again for each in again)
        assert len(told(log, "begun")) == len(begun)


def test_a_run_that_fails_on_a_worker_is_a_row_with_its_sentence(tmp_path):
    run, good = Run(name="bad", function=refuses), clocks(tmp_path / "log", [1], 0.0)[0]
    with dask_cluster(workers=1) as (address, _), Evaluations(executor=OnDask(scheduler=address)) as runs:
        failed, fine = runs.of([run, good])
    assert failed.problem == "wall is -1 mm; allowed is above 0 mm."
    assert fine.result is not None


def test_what_a_cluster_lacks_is_said(monkeypatch):
    study = Evaluations(executor=OnDask(scheduler="tcp://127.0.0.1:9"))
    with monkeypatch.context() as patch, refused("'tcp://127.0.0.1:9'", "OSError", "'dask scheduler'"):
        patch.setattr(dask_workers, "RUNS", replace(RUNS, patience=0.5))
        study.of([Run(name="one", function=refuses)])
    told = {(0, 1): ["no worker", "--nworkers 4"], (1, 3): ["3 threads", "'--nthreads 1'"]}
    for (workers, threads), facts in told.items():
        with dask_cluster(workers, threads) as (address, _), refused(*facts):
            Evaluations(executor=OnDask(scheduler=address)).of([Run(name="one", function=refuses)])


def test_a_sweep_on_dask_is_the_sweep_here(tmp_path):
    with dask_cluster(workers=2) as (address, _):
        runs = Evaluations(folder=tmp_path, executor=OnDask(scheduler=address))
        there = tg.sweep(slow, {"log": str(tmp_path / "log"), "seconds": 0.0}, number=[1, 2, 3], evaluations=runs)
    here = tg.sweep(slow, {"log": str(tmp_path / "log"), "seconds": 0.0}, number=[1, 2, 3])
    name = here.measures[-1]
    assert list(there.column(name)) == list(here.column(name))
