"""A Dask scheduler and workers of their own on the loopback interface, for as long as a test runs."""

import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory

#: Seconds until all workers must have joined.
PATIENCE = 60.0

TESTS = Path(__file__).parent


@contextmanager
def dask_cluster(workers: int = 2, threads: int = 1) -> Iterator[tuple[str, Sequence[subprocess.Popen]]]:
    """Start a scheduler and workers; give its address and the processes of the workers."""
    import distributed

    folders = [str(TESTS.parent / "src"), str(TESTS), str(TESTS / "unit"), os.environ.get("PYTHONPATH", "")]
    environment = os.environ | {"PYTHONPATH": os.pathsep.join(filter(None, folders))}
    with TemporaryDirectory() as name:
        file = Path(name) / "scheduler.json"
        scheduler = _started("scheduler", environment, name, "--host", "127.0.0.1", "--port", "0", "--no-dashboard",
                             "--scheduler-file", str(file))  # fmt: skip
        processes = [scheduler]
        try:
            _until(file.exists)
            options = ("--scheduler-file", str(file), "--nthreads", str(threads), "--no-nanny", "--no-dashboard")
            processes += [_started("worker", environment, name, *options) for _ in range(workers)]
            with distributed.Client(scheduler_file=str(file), timeout=PATIENCE, set_as_default=False) as client:
                client.wait_for_workers(workers, timeout=PATIENCE) if workers else None
                address = client.scheduler.address
            yield address, processes[1:]
        finally:
            for each in reversed(processes):
                each.send_signal(signal.SIGKILL)
                each.wait()


def _started(what: str, environment: dict[str, str], folder: str, *options: str) -> subprocess.Popen:
    command = [sys.executable, "-m", "distributed.cli.dask_" + what, *options]
    quiet = subprocess.DEVNULL
    return subprocess.Popen(command, env=environment, cwd=folder, stdout=quiet, stderr=quiet)


def _until(true) -> None:
    end = time.monotonic() + PATIENCE
    while not true():
        if time.monotonic() > end:
            raise TimeoutError("the Dask scheduler did not start")
        time.sleep(0.05)
