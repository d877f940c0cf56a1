"""Suppress what compiled code writes to the terminal."""

import ctypes
import os
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from tempfile import TemporaryFile


@contextmanager
def captured_output() -> Iterator[Callable[[], str]]:
    """Catch what is written to the file descriptors of stdout and stderr, by C++ too.

    The mesh generator writes hundreds of lines when it fails, whatever its message level. Descriptors belong to the
    process: output of other threads is caught as well while this lasts.

    Yields
    ------
    callable
        Returns the text that has been caught so far.

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
    with TemporaryFile() as file:

        def text() -> str:
            _flush()
            file.seek(0)
            return file.read().decode(errors="replace")

        _flush()
        try:
            for descriptor in (1, 2):
                with suppress(OSError):  # closed, as under pythonw: there is nothing to keep quiet
                    saved[descriptor] = os.dup(descriptor)
                    os.dup2(file.fileno(), descriptor)
            yield text
        finally:
            _flush()
            for descriptor, copy in saved.items():
                os.dup2(copy, descriptor)
                os.close(copy)


def _flush() -> None:
    """Empty the buffers of Python and of C, so that text goes where the descriptors point now."""
    for stream in (sys.stdout, sys.stderr):
        with suppress(AttributeError, ValueError):  # no stream, or a closed one
            stream.flush()
    with suppress(OSError, AttributeError, TypeError):  # no C library by this name: Windows
        ctypes.CDLL(None).fflush(None)
