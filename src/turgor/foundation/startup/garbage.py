"""Searches for garbage: rare in the process of a command, none while kernels are compiled."""

import gc
from collections.abc import Iterator
from contextlib import contextmanager

#: How many new objects start a search for garbage, and how many searches a wider one. With Python's own numbers (700,
#: 10, 10) the searches take a tenth of a first run: libraries and compilers make millions of objects that stay.
THRESHOLDS = (100_000, 20, 50)


def search_rarely() -> None:
    """Search for garbage rarely from now on: for the process of a command, in which no other program runs."""
    gc.set_threshold(*THRESHOLDS)


@contextmanager
def no_garbage_searches() -> Iterator[None]:
    """Search for no garbage while a block runs.

    Examples
    --------
    >>> import gc
    >>> with no_garbage_searches():
    ...     gc.isenabled()
    False
    """
    enabled = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if enabled:
            gc.enable()
