"""Compile loops at a known time; processes that begin at the same time share the work.

The loops come in groups. Who compiles a group holds a lock file meanwhile; who finds it locked goes on with another
group, and takes the result from the cache on disk later. So the process beside, which `compile_ahead` starts while the
mesh is made, needs no orders: it begins at the other end of the list. Runs that somebody starts together on a new
machine share the work in the same way.
"""

import gc
import hashlib
import json
import subprocess
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import asdict
from functools import partial
from pathlib import Path
from threading import Timer
from time import perf_counter

import numba
from filelock import FileLock, Timeout
from platformdirs import user_cache_path

from turgor.engine.compiled import processors
from turgor.engine.warmup.cell_loops import touch_cells, touch_first_loop, touch_pressure, touch_sheets, touch_stretches
from turgor.engine.warmup.contact_loops import touch_contact
from turgor.engine.warmup.needs import Needs

Group = tuple[str, Callable[[], None]]

#: Compilation that lasts longer than this [s] is announced.
QUIET_SECONDS = 1.5

#: No group takes longer [s]; who waits longer for another process compiles it himself.
LONGEST = 120.0


def compile_ahead(needs: Needs) -> None:
    """Begin to compile in another process, where nothing is compiled yet and a second processor is there."""
    if touch_first_loop() and processors() > 1:
        told = json.dumps(asdict(needs))
        command = f"from turgor.engine.warmup.compiling import compile_beside; compile_beside('{told}')"
        silent = subprocess.DEVNULL
        subprocess.Popen([sys.executable, "-c", command], stdin=silent, stdout=silent, stderr=silent)


def compile_kernels(notify: Callable[[str], None] | None, needs: Needs) -> float:
    """Load the loops that a model needs, compiled first where this machine has not; return the seconds.

    That it takes long is told by ``notify``, or on the standard error stream where that is None.
    """
    start = perf_counter()
    text = "compiling the element kernels (once per machine and kind of cell, up to half a minute)"
    timer = Timer(QUIET_SECONDS, notify or _say, args=(text,))
    timer.daemon = True
    timer.start()
    try:
        with _without_collection():
            compile_ahead(needs)
            later = [group for group in _groups(needs) if not _alone(group, 0.0)]
            for group in later:
                if not _alone(group, LONGEST):
                    group[1]()
    finally:
        timer.cancel()
    return perf_counter() - start


def compile_beside(told: str) -> None:
    """Compile what others have not begun, the last group first: what the process of `compile_ahead` does."""
    with _without_collection():
        for group in reversed(_groups(Needs(**json.loads(told)))):
            _alone(group, 0.0)


def _groups(needs: Needs) -> Sequence[Group]:
    """Groups that share no functions, so that none is compiled twice; the last ones suit a process that comes later."""
    kind = f"{needs.nodes}-{needs.mixed}"
    groups: list[Group] = [(f"cells-{kind}", partial(touch_cells, needs.nodes, needs.mixed))]
    if needs.stretches:
        groups.append((f"stretches-{kind}", partial(touch_stretches, needs.nodes, needs.mixed)))
    groups.append(("pressure", partial(touch_pressure, needs.nodes)))
    if needs.sheets:
        groups.append(("sheets", partial(touch_sheets, needs.nodes)))
    if needs.sides:
        groups.append(("contact", partial(touch_contact, needs.sides)))
    return groups


def _alone(group: Group, patience: float) -> bool:
    """Load or compile a group while no other process does; return whether it did, having waited ``patience`` [s]."""
    name, touch = group
    try:
        with FileLock(_lock_file(name), timeout=patience):
            touch()
    except Timeout:
        return False
    except OSError:  # no lock can be held here, so the work is not shared
        touch()
    return True


def _lock_file(name: str) -> Path:
    """File in a folder of the user, one for each folder of compiled loops and version of Python and numba."""
    where = (numba.config.CACHE_DIR, numba.__version__, sys.version, __file__)
    folder = Path(numba.config.CACHE_DIR) if numba.config.CACHE_DIR else user_cache_path("turgor")
    folder.mkdir(parents=True, exist_ok=True)
    return folder / f"{name}-{hashlib.sha256(str(where).encode()).hexdigest()[:10]}.lock"


@contextmanager
def _without_collection() -> Iterator[None]:
    """Leave garbage alone: numba makes millions of objects, and looking through them takes a tenth of its time."""
    before = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if before:
            gc.enable()


def _say(text: str) -> None:
    sys.stderr.write(f"turgor: {text}\n")
    sys.stderr.flush()
