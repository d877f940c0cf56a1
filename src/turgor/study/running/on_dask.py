"""OnDask: runs computed by the workers of a Dask scheduler, on this machine or on many."""

from collections.abc import Iterator, Sequence
from contextlib import chdir, nullcontext
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from typing import Any

from turgor.errors import TurgorError
from turgor.study.optional import needed
from turgor.study.running.ended import Ended, compute
from turgor.study.runs import Run, keep

#: Time [s] in which the scheduler must answer.
PATIENCE = 10.0


@dataclass(frozen=True, slots=True, kw_only=True)
class OnDask:
    """Computes runs on the workers of a Dask scheduler.

    A worker sends back what it found, and this process keeps it, so that workers need not see the folder of the study.
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
            # pure=False: what a run computes is known by its key, and a failed one may be tried again
            waiting = {client.submit(_computed, run, str(Path.cwd()), pure=False): run for run in runs}
            for future in dask.as_completed(list(waiting), loop=client.loop):
                yield _kept(waiting.pop(future), future, folder)
                future.release()
        finally:
            client.close()

    def close(self) -> None:
        """Do nothing: the workers are not ours."""

    def _client(self, dask: Any) -> Any:
        try:
            return dask.Client(self.scheduler, timeout=PATIENCE, set_as_default=False)
        except (OSError, TimeoutError, ValueError) as error:
            raise TurgorError(
                f"the Dask scheduler at '{self.scheduler}' does not answer ({type(error).__name__}); "
                "start one with 'dask scheduler', and give the address that it prints."
            ) from None


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


def _kept(run: Run, future: Any, folder: Path | None) -> Ended:
    """Keep what a worker sent back, and return how the run ended."""
    error = future.exception()
    if error is not None:
        told = f"{type(error).__name__}: {error}".strip(": ")
        return Ended(run=run, found=None, problem=f"the Dask worker could not compute it: {told}")
    ended: Ended = future.result()
    if folder is not None and ended.found is not None:
        keep(run, ended.found, folder)
    return Ended(run=run, found=ended.found, problem=ended.problem)
