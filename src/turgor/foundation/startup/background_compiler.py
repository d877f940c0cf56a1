"""Background compiler: a second process that compiles kernels while the first one reads the job and meshes.

Nothing here imports numba, so that a command can start the process before it loads anything heavy.
"""

import json
import subprocess
import sys
from collections.abc import Mapping
from contextlib import suppress
from functools import cache

from turgor.foundation.processors import processors
from turgor.foundation.startup.kernel_folder import FIRST, marker

#: What the process runs.
_COMMAND = "from turgor.core.engine.warmup.compiling import compile_in_background; compile_in_background()"


def start_early() -> None:
    """Start the background compiler if no kernel is compiled yet: the first thing that ``turgor run`` does."""
    if not marker(FIRST).exists():
        background_process()


@cache
def background_process() -> "subprocess.Popen[str] | None":
    """Return the background compiler, which the first call starts; None on a single processor.

    It begins with kernels that nearly every model needs, and reads from its standard input what `send_needs` writes.
    """
    if processors() < 2:
        return None
    silent = subprocess.DEVNULL
    return subprocess.Popen(
        [sys.executable, "-c", _COMMAND], stdin=subprocess.PIPE, stdout=silent, stderr=silent, text=True
    )


def send_needs(needs: Mapping[str, object]) -> None:
    """Send the model's kernel requirements to the background compiler, once."""
    process = background_process()
    if process is not None and process.stdin is not None and not process.stdin.closed:
        with suppress(OSError):  # it has ended, and this process compiles everything
            process.stdin.write(json.dumps(dict(needs)))
        with suppress(OSError):
            process.stdin.close()


def still_compiling() -> bool:
    """Return whether the background compiler is at work."""
    process = background_process()
    return process is not None and process.poll() is None
