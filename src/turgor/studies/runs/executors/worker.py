"""serve: a worker process computes one run after another, until the process that started it ends."""

import os
import pickle
import signal
import traceback
import warnings
from multiprocessing import parent_process
from multiprocessing.connection import Connection, wait
from threading import Thread

from turgor.foundation.finding import FindingWarning
from turgor.studies.runs.executors.run_outcome import compute

#: First message of a worker.
READY = "ready"


def serve(connection: Connection) -> None:
    """Compute the runs that come through a connection; answer each by its problem, or by how it ended without a folder.

    Parameters
    ----------
    connection : Connection
        Of `multiprocessing`; pairs of a run and the folder where it is saved, or None, come through it.
    """
    warnings.simplefilter("ignore", FindingWarning)  # the terminal is that of the process that started this one
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C reaches all processes; the first one decides
    Thread(target=_end_with_parent, daemon=True).start()
    connection.send(READY)
    while True:
        try:
            given = connection.recv_bytes()
        except (EOFError, OSError):
            return
        connection.send(_computed(given))


def _computed(given: bytes) -> object:
    try:
        run, folder = pickle.loads(given)  # from the process that started this one
        ended = compute(run, folder)
    except Exception:  # a module that cannot be imported here, a disk that is full
        return traceback.format_exc().strip()
    return ended if folder is None else ended.problem


def _end_with_parent() -> None:
    """End this process at once when the one that started it has ended, because nobody reads its results."""
    parent = parent_process()
    if parent is not None:
        wait([parent.sentinel])
        os._exit(1)
