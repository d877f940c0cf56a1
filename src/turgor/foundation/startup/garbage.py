"""Rare searches for garbage, while libraries are loaded and kernels compiled."""

import gc
from collections.abc import Iterator
from contextlib import contextmanager

#: How many new objects start a search for garbage, and how many searches a wider one. Python's own numbers are 700, 10
#: and 10, with which the searches take a tenth of a first run: compilers make millions of objects that stay.
THRESHOLDS = (100_000, 20, 50)


@contextmanager
def rare_garbage_searches() -> Iterator[None]:
    """Search for garbage rarely while a block runs.

    Examples
    --------
    >>> import gc
    >>> with rare_garbage_searches():
    ...     gc.get_threshold()
    (100000, 20, 50)
    """
    before = gc.get_threshold()
    gc.set_threshold(*THRESHOLDS)
    try:
        yield
    finally:
        gc.set_threshold(*before)
