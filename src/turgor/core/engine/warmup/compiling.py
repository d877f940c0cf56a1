"""Compile loops at a known time; processes that begin at the same time share the work.

The loops come in groups. Who compiles a group holds a lock file meanwhile; who finds it locked goes on with another
group, and takes the result from the cache on disk later. So the process beside, which `turgor.foundation.kernel_cache`
starts before anything heavy is loaded, needs no orders but what the model needs: it begins at the other end of the
list. Runs that somebody starts together on a new machine share the work in the same way.

Loops that no first step needs come last, and a process that has another one beside it leaves them to that. Once they
are compiled, they are loaded where they are first called, which takes some milliseconds.
"""

import gc
import json
import os
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import asdict, dataclass
from functools import partial
from threading import Timer
from time import perf_counter

from filelock import FileLock, Timeout

from turgor.core.engine.warmup.cell_loops import (
    compile_geometry,
    compile_gradients,
    compile_pattern,
    compile_pressure,
    compile_residual,
    compile_sheets,
    compile_stretches,
    compile_tangent,
    compile_updates,
)
from turgor.core.engine.warmup.contact_loops import compile_press, compile_search
from turgor.core.engine.warmup.needs import Needs
from turgor.foundation.kernel_cache import FIRST, at_work, kept, tell


@dataclass(frozen=True, slots=True)
class Group:
    """Loops that are compiled by one process.

    Parameters
    ----------
    name : str
    touch : callable
        ``touch()`` calls each of them once.
    soon : bool
        Whether a first step needs them.
    """

    name: str
    touch: Callable[[], None]
    soon: bool = True


#: Compilation that lasts longer than this [s] is announced.
QUIET_SECONDS = 1.5

#: No group takes longer [s]; who waits longer for another process compiles it himself.
LONGEST = 120.0

#: By how much the process beside lowers its priority once all that a first step needs is compiled.
KINDNESS = 15


def compile_ahead(needs: Needs) -> bool:
    """Begin to compile in another process, or tell it what is needed; return whether something is not compiled yet."""
    missing = not all(kept(group.name).exists() for group in _groups(needs))
    if missing:
        tell(asdict(needs))
    return missing


def compile_kernels(notify: Callable[[str], None] | None, needs: Needs) -> float:
    """Load the loops that a model needs, compiled first where this machine has not; return the seconds.

    That it takes long is told by ``notify``; where that is None, on the standard error stream if it is a terminal.
    """
    start = perf_counter()
    text = "compiling the element kernels (once per machine and kind of cell, up to half a minute)"
    timer = Timer(QUIET_SECONDS, notify or _say, args=(text,))
    timer.daemon = True
    timer.start()
    try:
        with _without_collection() as left:
            left.much = compile_ahead(needs)
            groups = _groups(needs)
            later = [group for group in groups if group.soon and not _alone(group, 0.0)]
            for group in later:
                if not _alone(group, LONGEST):
                    group.touch()
            rest = [group for group in groups if not (group.soon or kept(group.name).exists())]
            if rest and not at_work():  # nobody else compiles them
                for group in rest:
                    _alone(group, 0.0)
    finally:
        timer.cancel()
    return perf_counter() - start


def compile_beside() -> None:
    """Compile what others have not begun, the last group first: the work of `foundation.kernel_cache.beside`."""
    with _without_collection():
        _alone(_pressure(), 0.0)  # the loops that any kind of cell needs, while the job is read
        told = sys.stdin.readline()
        if not told:  # the other process has ended
            return
        groups = _groups(Needs(**json.loads(told)))
        soon = [group for group in reversed(groups) if group.soon]
        for group in soon:
            _alone(group, 0.0)
        _step_back()
        for group in groups:
            if not group.soon:
                _alone(group, 0.0)


def _step_back() -> None:
    """Leave the processors to others: the run has begun to solve, and needs what comes now later or never."""
    if hasattr(os, "nice"):  # not on Windows
        os.nice(KINDNESS)


def _groups(needs: Needs) -> Sequence[Group]:
    """Groups that share no functions, so that none is compiled twice, or that one process is likely to take in turn.

    One process takes them from the front, another from the back. Large groups stand at the ends and small ones
    between, so that the two end at about the same time.
    """
    kind, cell = f"{needs.nodes}-{needs.mixed}", (needs.nodes, needs.mixed)
    gradients = Group(f"gradients-{kind}", partial(compile_gradients, *cell), soon=needs.stretches)
    groups = [
        Group(f"tangent-{kind}", partial(compile_tangent, *cell)),
        Group(f"updates-{kind}", partial(compile_updates, *cell)),
    ]
    if needs.stretches:
        groups += [Group(f"stretches-{kind}", partial(compile_stretches, *cell)), gradients]
    groups += [
        Group(f"residual-{kind}", partial(compile_residual, *cell)),
        Group(f"geometry-{kind}", partial(compile_geometry, *cell)),
        Group(FIRST, compile_pattern),
    ]
    if needs.sheets:
        groups.append(Group("sheets", partial(compile_sheets, needs.nodes)))
    groups.append(_pressure())
    if needs.sides:
        groups.append(Group("search", partial(compile_search, needs.sides)))
        groups.append(Group("press", partial(compile_press, needs.sides), soon=False))
    if not needs.stretches:
        groups.append(gradients)
    return groups


def _pressure() -> Group:
    return Group("pressure", partial(compile_pressure, Needs().nodes))


def _alone(group: Group, patience: float) -> bool:
    """Load or compile a group while no other process does; return whether it did, having waited ``patience`` [s]."""
    file = kept(group.name)
    try:
        with FileLock(file.with_suffix(".lock"), timeout=patience):
            group.touch()
    except Timeout:
        return False
    except OSError:  # no lock can be held here, so the work is not shared
        group.touch()
    with suppress(OSError):
        file.touch()
    return True


@dataclass(slots=True)
class Garbage:
    """Whether there is much garbage to look for."""

    much: bool = False


@contextmanager
def _without_collection() -> Iterator[Garbage]:
    """Leave garbage alone: numba makes millions of objects, and looking through them takes a tenth of its time.

    Where there is ``much`` in the end, all objects count as old, so that the first step does not wait for the search
    for it: that comes with the next search of old objects.
    """
    before, left = gc.isenabled(), Garbage()
    gc.disable()
    try:
        yield left
    finally:
        if left.much:
            frozen = gc.get_freeze_count()  # which looks at all of them
            gc.freeze()
            if not frozen:  # else the command has frozen what it loaded, and ends after this run
                gc.unfreeze()
        if before:
            gc.enable()


def _say(text: str) -> None:
    if sys.stderr.isatty():
        sys.stderr.write(f"turgor: {text}\n")
        sys.stderr.flush()
