"""Number of processors that this process may use."""

import os


def processors() -> int:
    """Return the processors of this process, at most as many as ``NUMBA_NUM_THREADS`` states.

    Examples
    --------
    >>> processors() >= 1
    True
    """
    available = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
    stated = os.environ.get("NUMBA_NUM_THREADS", "")
    return min(available, int(stated)) if stated.isdigit() and int(stated) else available
