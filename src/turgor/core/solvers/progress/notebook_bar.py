"""Notebook bar: progress of a solve below the cell that runs it."""

from html import escape
from time import perf_counter
from typing import Any, Self

from turgor.core.solvers.progress.bar import AT_ONCE
from turgor.core.solvers.progress.progress import Course, clock, of_stage
from turgor.core.solvers.solution import Iteration, State

#: Shortest time [s] between two pictures of it.
REFRESH = 0.2


class NotebookBar:
    """A bar over the load factor with step and remaining time, which goes away in the end.

    Parameters
    ----------
    display : callable
        ``IPython.display.display``, which shows HTML in place of what it has shown before.
    """

    def __init__(self, display: Any) -> None:
        self._display = display
        self._handle: Any = None
        self._course = Course()
        self._next = perf_counter() + AT_ONCE

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        if self._handle is not None:
            self._show("")

    def notify(self, text: str) -> None:
        """Show what is being done."""
        self._draw(text, now=True)

    def progress(self, iteration: Iteration, state: State | None) -> None:
        """Move the bar."""
        self._course.follow(state)
        text = f"{of_stage(self._course.stage)}load factor {self._course.load_factor:.3f}, step {iteration.step}"
        self._draw(f"{text}, {clock(self._course.seconds_left)} left")

    def _draw(self, text: str, now: bool = False) -> None:
        if now or perf_counter() >= self._next:
            self._next = perf_counter() + REFRESH
            self._show(f'<progress value="{self._course.load_factor:.4f}" max="1"></progress> {escape(text)}')

    def _show(self, html: str) -> None:
        shown = {"text/html": html, "text/plain": ""}
        if self._handle is None:
            self._handle = self._display(shown, raw=True, display_id=True)
        else:
            self._handle.update(shown, raw=True)
