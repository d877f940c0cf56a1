"""OnDask: runs computed by the workers of a Dask scheduler, on this machine or on many."""

from collections.abc import Iterator, Sequence
from contextlib import chdir, nullcontext
from dataclasses import dataclass, replace
from importlib import import_module
from pathlib import Path
from time import sleep
from typing import Any

from turgor.foundation.errors import TurgorError
from turgor.studies.runs.executors.claims import Claims
from turgor.studies.runs.executors.run_outcome import Ended, compute, save_ended
from turgor.studies.runs.optional_parts import needed
from turgor.studies.runs.run import Run
from turgor.studies.runs.settings import RUNS


@dataclass(frozen=True, slots=True, kw_only=True)
class OnDask:
    """Computes runs on the workers of a Dask scheduler.

    A worker sends back its result, and this process saves it, so that workers need not see the folder of the study.
    They must see the job file and the module of the function under the same names, as on a cluster with shared homes.
    If a worker dies, the scheduler gives its run to another one.

    Parameters
    ----------
    scheduler : str
        Address, such as ``"tcp://10.0.0.1:8786"``.

    Raises
    ------
    TurgorError
        When runs are computed: if Dask is not installed, the scheduler does not answer, there is no worker, or a worker
        has another version of turgor or more than one thread.
    """

    scheduler: str

    def compute(self, runs: Sequence[Run], folder: Path | None) -> Iterator[Ended]:
        """Compute runs, and give each as it ends; where the caller stops, those that have begun are cancelled."""
        dask = needed("distributed", "a study on Dask")
        client = self._client(dask)
        try:
            _check(client, self.scheduler)
            with Claims(runs, folder) as claims:
                yield from _ended(client, dask.as_completed([], loop=client.loop), claims, folder)
        finally:
            client.close()

    def close(self) -> None:
        """Do nothing; the workers belong to the scheduler."""

    def _client(self, dask: Any) -> Any:
        try:
            return dask.Client(self.scheduler, timeout=RUNS.patience, set_as_default=False)
        except (OSError, TimeoutError, ValueError) as error:
            raise TurgorError(
                f"the Dask scheduler at '{self.scheduler}' does not answer ({type(error).__name__}); "
                "start one with 'dask scheduler', and give the address that it prints."
            ) from None


def _ended(client: Any, ending: Any, claims: Claims, folder: Path | None) -> Iterator[Ended]:
    """Hand runs to the scheduler, and give each as it ends."""
    waiting: dict[Any, Run] = {}
    while claims or waiting:
        taken = claims.take() if len(waiting) < RUNS.dask_runs else None
        if isinstance(taken, Run):
            # pure=False: runs are identified by their keys, and a failed one may be tried again
            future = client.submit(_computed, taken, str(Path.cwd()), pure=False)
            waiting[future] = taken
            ending.add(future)
        elif taken is not None:
            yield taken
        elif not waiting:
            sleep(RUNS.poll)
        else:
            future = next(ending)
            run = waiting.pop(future)
            ended = _saved(run, future, folder)
            claims.release(run)
            future.release()
            yield ended


def _check(client: Any, scheduler: str) -> None:
    """Raise an error if the workers cannot compute what this process would."""
    threads = client.nthreads()
    if not threads:
        raise TurgorError(
            f"the Dask scheduler at '{scheduler}' has no worker; start some with "
            f"'dask worker {scheduler} --nworkers 4 --nthreads 1'."
        )
    for worker, count in threads.items():
        if count > 1:
            raise TurgorError(
                f"the Dask worker at '{worker}' has {count} threads; a process computes one run at a time. "
                "Start it with '--nthreads 1', and '--nworkers N' for more processes."
            )
    here = _version()
    for worker, there in client.run(_version).items():
        if there != here:
            raise TurgorError(f"the Dask worker at '{worker}' has turgor {there}; here is turgor {here}.")


def _version() -> str:
    return str(import_module("turgor").__version__)


def _computed(run: Run, folder: str) -> Ended:
    """Compute a run on a worker, in the folder that relative paths of this study start from, if the worker sees it."""
    with chdir(folder) if Path(folder).is_dir() else nullcontext():
        return compute(run)


def _saved(run: Run, future: Any, folder: Path | None) -> Ended:
    """Save the result that a worker sent back, and return how the run ended."""
    error = future.exception()
    if error is not None:
        reported = f"{type(error).__name__}: {error}".strip(": ")
        return Ended(run=run, result=None, problem=f"the Dask worker could not compute it: {reported}")
    ended: Ended = future.result()
    return save_ended(replace(ended, run=run), folder)
