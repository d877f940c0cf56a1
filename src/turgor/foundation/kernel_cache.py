"""Compiled loops on disk: where they are kept, which are there, and the process that compiles beside this one.

Nothing here imports numba, so that a command can begin to compile before it loads anything heavy.
"""

import hashlib
import json
import os
import subprocess
import sys
import tempfile
from collections.abc import Mapping
from contextlib import suppress
from functools import cache
from importlib.util import find_spec
from pathlib import Path

from platformdirs import user_cache_path

from turgor.foundation.store import caches

#: Variable that names the folder of compiled loops, read by numba.
VARIABLE = "NUMBA_CACHE_DIR"

#: Loops that every model needs: where they are compiled, so is probably the rest.
FIRST = "pattern"

#: How the names of threads begin that pass through loops; between two loops they wait.
POOL = "turgor-loop"

#: Endings of what numba and `kept` write.
_COMPILED = frozenset({".nbi", ".nbc", ".compiled"})

_ENGINE = Path(__file__).parent.parent / "core" / "engine"


def usual() -> tuple[Path, ...]:
    """The folders that numba tries by itself: one of the package, and one of the user."""
    return _ENGINE / "cells" / "__pycache__", user_cache_path("numba")


def folder() -> Path | None:
    """Folder of compiled loops: a stated one, one that numba finds by itself, or one of this user alone.

    numba loads what it finds there as code, so a folder that others could write into is not used. Others know the name
    of the one below the folder for temporary files. It serves if it is this user's alone; else a new one with a random
    name serves this process and those that it starts.

    Returns
    -------
    Path or None
        None where numba should look by itself.
    """
    stated = os.environ.get(VARIABLE)
    if stated and writable(Path(stated)):
        return Path(stated)
    if os.environ.get(caches.FOLDER):
        own = caches.cache_folder("compiled")
        if own is not None:
            return own
    elif writable(usual()[0]) or caches.private(usual()[1]):
        return None
    shared = Path(tempfile.gettempdir()) / f"turgor-compiled-{os.getuid() if hasattr(os, 'getuid') else 'user'}"
    other = shared if caches.private(shared) else Path(tempfile.mkdtemp(prefix="turgor-compiled-"))
    os.environ[VARIABLE] = str(other)
    return other


def compiled_files() -> list[Path]:
    """Return the files of compiled loops, in whatever folder they are."""
    place = folder()
    if place is not None:
        return sorted(file for file in place.rglob("*") if file.suffix in _COMPILED)
    found = {file for file in _ENGINE.rglob("__pycache__/*") if file.suffix in _COMPILED}
    for source in {file.parent for file in _ENGINE.rglob("*.py")}:  # numba names its folders so
        name = f"{source.name}_{hashlib.sha1(str(source).encode(), usedforsecurity=False).hexdigest()}"
        found |= {file for file in (usual()[1] / name).glob("*") if file.suffix in _COMPILED}
    return sorted(found)


def writable(folder: Path) -> bool:
    """Whether a file can be made in a folder, which is made where it is missing."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=folder):
            return True
    except OSError:
        return False


def kept(name: str) -> Path:
    """File that says that a group of loops is compiled; a lock with this name is held meanwhile.

    It stands beside the compiled loops and goes with them. Loops are compiled anew for another processor, another
    version of Python or numba, and other sources, so its name differs then.
    """
    place = folder() or next(filter(writable, usual()))
    return place / f"turgor-{name}-{_circumstances()}.compiled"


@cache
def _circumstances() -> str:
    numba = find_spec("numba")
    sources = [*_ENGINE.rglob("*.py"), *([Path(numba.origin)] if numba and numba.origin else [])]
    newest = max((file.stat().st_mtime_ns for file in sources), default=0)  # none in a frozen program
    told = (sys.version, os.name, str(_ENGINE), len(sources), newest)
    return hashlib.sha256(str(told).encode()).hexdigest()[:10]


def processors() -> int:
    """Processors of this process, or as many as numba was told to use, where that is fewer."""
    there = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
    told = os.environ.get("NUMBA_NUM_THREADS", "")
    return min(there, int(told)) if told.isdigit() and int(told) else there


def begin_early() -> None:
    """Begin to compile in another process if nothing is compiled yet: what a command does first."""
    if not kept(FIRST).exists():
        beside()


@cache
def beside() -> "subprocess.Popen[str] | None":
    """The process that compiles beside this one, begun by the first call; None on a single processor.

    It begins with what nearly every model needs, and waits for `tell` on its standard input.
    """
    if processors() < 2:
        return None
    command = "from turgor.core.engine.warmup.compiling import compile_beside; compile_beside()"
    silent, asked = subprocess.DEVNULL, subprocess.PIPE
    return subprocess.Popen([sys.executable, "-c", command], stdin=asked, stdout=silent, stderr=silent, text=True)


def tell(needs: Mapping[str, object]) -> None:
    """Tell the process beside this one what the model needs; it is told once."""
    process = beside()
    if process is not None and process.stdin is not None and not process.stdin.closed:
        with suppress(OSError):  # it has ended, and this process compiles everything
            process.stdin.write(json.dumps(dict(needs)))
        with suppress(OSError):
            process.stdin.close()


def at_work() -> bool:
    """Whether a process beside this one is still compiling."""
    process = beside()
    return process is not None and process.poll() is None
