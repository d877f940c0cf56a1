"""Watchers: show the progress of a solve on a terminal, in a notebook, or to a function."""

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from multiprocessing import parent_process
from typing import Any, TypeAlias

from turgor.core.solvers.solution import Iteration, State
from turgor.foundation.errors import TurgorError
from turgor.foundation.given import shown

Heard: TypeAlias = Callable[[Iteration, State | None], None]

#: What `solve` takes: a function, whether a bar is shown, or None, which shows one in a terminal or a notebook.
Progress: TypeAlias = Heard | bool | None


@dataclass(frozen=True, slots=True, kw_only=True)
class Watcher:
    """Callbacks of a solve: after each iteration, and before work that takes long; None where nothing is called."""

    progress: Heard | None = None
    notify: Callable[[str], None] | None = None


@contextmanager
def watched(progress: Progress) -> Iterator[Watcher]:
    """Show the progress of a solve as requested.

    Parameters
    ----------
    progress : callable, bool or None
        A function that is called instead; whether a bar is shown; by default where a terminal or a notebook looks on.

    Yields
    ------
    Watcher

    Raises
    ------
    TurgorError
        If it is something else.
    """
    if progress is not None and not isinstance(progress, bool):
        if not callable(progress):
            raise TurgorError(f"progress is {shown(progress)}; allowed are True, False, None and a function.")
        yield Watcher(progress=progress)
        return
    notebook = _notebook()
    if progress is False or (progress is None and not (notebook or on_terminal())):
        yield Watcher()
        return
    with _bar(notebook) as bar:
        yield Watcher(progress=bar.progress, notify=bar.notify)


def on_terminal() -> bool:
    """Whether the standard error stream is a terminal that belongs to this process, not to the one that started it."""
    try:
        return sys.stderr.isatty() and parent_process() is None
    except (AttributeError, ValueError):  # there is none, or it is closed
        return False


def _notebook() -> Any:
    """The function that shows things in a notebook; None elsewhere."""
    python = sys.modules.get("IPython")
    shell = None if python is None else python.get_ipython()
    return python.display.display if python is not None and hasattr(shell, "kernel") else None


def _bar(notebook: Any) -> Any:
    """A bar in a terminal or a notebook; rich is slow to load, and many solves need none."""
    if notebook is not None:
        from turgor.core.solvers.progress.notebook_bar import NotebookBar

        return NotebookBar(notebook)
    from rich.console import Console

    from turgor.core.solvers.progress.bar import Bar

    return Bar(Console(file=sys.stderr))
