"""Process: a command of turgor in a session of its own; whether it still runs, and how it is ended."""

import os
import signal
import subprocess
import sys
import time
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path

from turgor.studio.settings import STUDIO


def begin(module: str, arguments: Sequence[str], folder: Path, log: Path) -> "subprocess.Popen[bytes]":
    """Start ``python -m MODULE ARGUMENTS`` in a folder; it goes on when the server ends.

    Parameters
    ----------
    module : str
    arguments : sequence of str
    folder : Path
    log : Path
        Takes what the process prints.
    """
    environment = os.environ | {"PYTHONUNBUFFERED": "1"}
    with log.open("wb") as out:
        return subprocess.Popen(
            [sys.executable, "-m", module, *arguments],
            cwd=folder,
            stdin=subprocess.DEVNULL,
            stdout=out,
            stderr=subprocess.STDOUT,
            env=environment,
            start_new_session=True,
        )


def birth(pid: int) -> str:
    """Return when a process began, which tells it from a later one with its number; empty where none runs."""
    file = Path(f"/proc/{pid}/stat")
    if file.parent.parent.joinpath("self").exists():
        try:
            fields = file.read_text(encoding="utf-8", errors="replace").rpartition(")")[2].split()
        except OSError:
            return ""
        return "" if fields[0] in "ZX" else fields[19]
    listed = subprocess.run(["ps", "-o", "lstart=", "-p", str(pid)], capture_output=True, text=True, check=False)
    return listed.stdout.strip()


def interrupt(pid: int) -> None:
    """Send Ctrl-C to a process and those that it has started: it writes what it has, and ends."""
    with suppress(ProcessLookupError):
        os.killpg(pid, signal.SIGINT)


def end(pid: int, born: str) -> None:
    """End a process: with Ctrl-C, and after `STUDIO.cancel` by force. Its states are on disk."""
    interrupt(pid)
    until = time.monotonic() + STUDIO.cancel
    while birth(pid) == born:
        if time.monotonic() > until:
            with suppress(ProcessLookupError):
                os.killpg(pid, signal.SIGKILL)
            until = time.monotonic() + STUDIO.cancel
        time.sleep(STUDIO.look)
