"""Compile kernels at a known time, shared among processes that start together.

The kernels come in groups. Each group has a lock file: a process that finds a group locked compiles another one and
loads the result from disk later. So the background compiler (`turgor.foundation.startup.background_compiler`) needs no
orders: it takes the groups from the other end of the list. Runs that start together on a new machine share the work in
the same way.

Kernels that no first step needs come last. The background compiler compiles them at low priority while the run solves.
A compiled kernel is loaded where it is first called, which takes some milliseconds.
"""

import json
import os
import sys
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import asdict, dataclass
from functools import partial
from threading import Timer
from time import perf_counter

from filelock import FileLock, Timeout

from turgor.core.engine.warmup.cell_kernels import (
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
from turgor.core.engine.warmup.contact_kernels import compile_press, compile_search
from turgor.core.engine.warmup.needs import Needs
from turgor.core.engine.warmup.settings import COMPILATION
from turgor.foundation.startup.background_compiler import send_needs, still_compiling
from turgor.foundation.startup.garbage import no_garbage_searches
from turgor.foundation.startup.kernel_folder import FIRST, marker


@dataclass(frozen=True, slots=True)
class Group:
    """Kernels that one process compiles together.

    Parameters
    ----------
    name : str
    compile : callable
        ``compile()`` calls each kernel once.
    needed_first : bool
        Whether a first step needs them.
    """

    name: str
    compile: Callable[[], None]
    needed_first: bool = True


def announce_needs(needs: Needs) -> None:
    """Send the background compiler what a model needs, where some of it is not compiled yet."""
    if not all(marker(group.name).exists() for group in _groups(needs)):
        send_needs(asdict(needs))


def compile_kernels(notify: Callable[[str], None] | None, needs: Needs) -> float:
    """Load the kernels that a model needs, compiled first if this machine has not compiled them.

    Parameters
    ----------
    notify : callable or None
        ``notify(text)``, called if the compilation takes long; None writes to the standard error stream if that is a
        terminal.
    needs : Needs

    Returns
    -------
    float
        Duration [s].
    """
    start = perf_counter()
    text = "compiling the element kernels (once per machine and kind of cell, up to half a minute)"
    timer = Timer(COMPILATION.announced_after, notify or _say, args=(text,))
    timer.daemon = True
    timer.start()
    try:
        with no_garbage_searches():
            announce_needs(needs)
            _compile(_groups(needs))
    finally:
        timer.cancel()
    return perf_counter() - start


def _compile(groups: Sequence[Group]) -> None:
    """Compile all groups but those that another process compiles for later."""
    locked = [group for group in groups if group.needed_first and not _compiled_alone(group, 0.0)]
    for group in locked:
        if not _compiled_alone(group, COMPILATION.longest):
            group.compile()
    rest = [group for group in groups if not (group.needed_first or marker(group.name).exists())]
    if rest and not still_compiling():
        for group in rest:
            _compiled_alone(group, 0.0)


@no_garbage_searches()
def compile_in_background() -> None:
    """Compile the groups that no other process has begun, the last one first: what the background compiler runs."""
    _compiled_alone(_pressure(), 0.0)  # kernels that any kind of cell needs, while the job is read
    line = sys.stdin.readline()
    if not line:  # the other process has ended
        return
    groups = _groups(Needs(**json.loads(line)))
    for group in reversed(groups):
        if group.needed_first:
            _compiled_alone(group, 0.0)
    _lower_priority()
    for group in groups:
        if not group.needed_first:
            _compiled_alone(group, 0.0)


def _lower_priority() -> None:
    """Leave the processors to the run, which has begun to solve and may not need the kernels that follow."""
    if hasattr(os, "nice"):  # not on Windows
        os.nice(COMPILATION.niceness)


def _groups(needs: Needs) -> Sequence[Group]:
    """Groups that share no functions, so that none is compiled twice, or that one process is likely to take in turn.

    One process takes them from the front, another from the back. Large groups stand at the ends and small ones
    between, so that the two end at about the same time.
    """
    kind, cell = f"{needs.nodes}-{needs.mixed}", (needs.nodes, needs.mixed)
    gradients = Group(f"gradients-{kind}", partial(compile_gradients, *cell), needed_first=needs.stretches)
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
        groups.append(Group("press", partial(compile_press, needs.sides), needed_first=False))
    if not needs.stretches:
        groups.append(gradients)
    return groups


def _pressure() -> Group:
    return Group("pressure", partial(compile_pressure, Needs().nodes))


def _compiled_alone(group: Group, patience: float) -> bool:
    """Compile or load a group while no other process does; return False if one still does after ``patience`` [s]."""
    file = marker(group.name)
    try:
        with FileLock(file.with_suffix(".lock"), timeout=patience):
            group.compile()
    except Timeout:
        return False
    except OSError:  # there is no place for a lock, so the work is not shared
        group.compile()
    with suppress(OSError):
        file.touch()
    return True


def _say(text: str) -> None:
    if sys.stderr.isatty():
        sys.stderr.write(f"turgor: {text}\n")
        sys.stderr.flush()
