"""Suppression of the terminal output of compiled code."""

import ctypes
import faulthandler
import os
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from tempfile import TemporaryFile


@contextmanager
def captured_output() -> Iterator[Callable[[], str]]:
    """Capture the output to the file descriptors of stdout and stderr, also that of C++.

    The mesh generator writes hundreds of lines when it fails, at any message level. Descriptors belong to the process,
    so the output of other threads is captured as well. If the compiled code ends the process, its last words are lost;
    Python then says on the true stderr where it happened.

    Yields
    ------
    callable
        Returns the captured text.

    Examples
    --------
    >>> import os
    >>> with captured_output() as text:
    ...     _ = os.write(2, b"noise")
    ...     caught = text()
    >>> caught
    'noise'
    """
    saved: dict[int, int] = {}
    watched = False
    with TemporaryFile() as file:

        def text() -> str:
            _flush()
            file.seek(0)
            return file.read().decode(errors="replace")

        _flush()
        try:
            for descriptor in (1, 2):
                with suppress(OSError):  # closed, as under pythonw: there is no output to capture
                    saved[descriptor] = os.dup(descriptor)
                    os.dup2(file.fileno(), descriptor)
            watched = 2 in saved and not faulthandler.is_enabled()
            if watched:
                faulthandler.enable(saved[2], all_threads=False)
            yield text
        finally:
            _flush()
            if watched:
                faulthandler.disable()
            for descriptor, copy in saved.items():
                os.dup2(copy, descriptor)
                os.close(copy)


def _flush() -> None:
    """Flush the buffers of Python and of C, so that their text goes to the current descriptors."""
    for stream in (sys.stdout, sys.stderr):
        with suppress(AttributeError, ValueError):  # no stream, or a closed one
            stream.flush()
    with suppress(OSError, AttributeError, TypeError):  # Windows has no C library of this name
        ctypes.CDLL(None).fflush(None)
