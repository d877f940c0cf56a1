"""End of the process of a command."""

import atexit
import os
import sys
import threading
from typing import NoReturn

from turgor.foundation.kernel_cache import POOL


def leave(code: int) -> NoReturn:
    """End the process with an exit code, and leave its memory to the system.

    To take everything apart, object by object, lasts 0.06 CPU seconds after a small run, and up to half a second after
    a large one. All that Python does for others is done before: what is registered with `atexit` is called, output is
    written. Where a thread is still at work, Python waits for it and ends as usual; those that wait for the next loop
    have no work.

    Parameters
    ----------
    code : int
    """
    others = (thread for thread in threading.enumerate() if thread is not threading.main_thread())
    if any(not (thread.daemon or thread.name.startswith(POOL)) for thread in others):
        sys.exit(code)
    atexit._run_exitfuncs()  # as the processes of `multiprocessing` do, which end in the same way
    try:
        for stream in (sys.stdout, sys.stderr):
            if stream is not None:
                stream.flush()
    except (OSError, ValueError):  # nobody reads it, or it is closed: Python says so, and has a code for it
        sys.exit(code)
    os._exit(code)
