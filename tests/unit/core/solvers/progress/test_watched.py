"""Progress of a solve: a bar where somebody looks on, silence elsewhere, and records of a log."""

import io
import logging
import sys
from types import SimpleNamespace

import pytest
import solver_cases

import turgor as tg
from refused import refused
from turgor.core.solvers.progress import notebook_bar
from turgor.core.solvers.progress.bar import Bar
from turgor.core.solvers.progress.notebook_bar import NotebookBar
from turgor.core.solvers.progress.watchers import watched

STEPS = tg.Static(first_step=0.5, max_step=0.5)


class Terminal(io.StringIO):
    """A stream that is a terminal."""

    def isatty(self) -> bool:
        return True


def terminal_of(monkeypatch: pytest.MonkeyPatch, patience: float = 0.0) -> Terminal:
    """A terminal on which a bar appears at once; made within the test, because pytest sets the stream before it."""
    stream = Terminal()
    monkeypatch.setattr(sys, "stderr", stream)
    monkeypatch.setenv("TERM", "xterm")
    monkeypatch.setattr(Bar.__init__, "__defaults__", (None, patience))
    return stream


def test_a_terminal_sees_a_bar_that_goes_away(monkeypatch: pytest.MonkeyPatch) -> None:
    terminal = terminal_of(monkeypatch)
    tg.solve(solver_cases.model(), STEPS)
    assert "load factor 1.000" in terminal.getvalue()
    assert terminal.getvalue().endswith("\x1b[2K")  # the line is erased


def test_nobody_sees_a_bar_that_was_not_asked_for(monkeypatch: pytest.MonkeyPatch) -> None:
    terminal = terminal_of(monkeypatch)
    tg.solve(solver_cases.model(), STEPS, progress=False)
    monkeypatch.setattr("turgor.core.solvers.progress.watchers.parent_process", lambda: "the process of a study")
    tg.solve(solver_cases.model(), STEPS)
    assert terminal.getvalue() == ""


def test_a_pipe_sees_nothing_but_what_is_asked_for(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "stderr", io.StringIO())
    tg.solve(solver_cases.model(), STEPS)
    assert sys.stderr.getvalue() == ""
    heard: list[object] = []
    tg.solve(solver_cases.model(), STEPS, progress=lambda iteration, state: heard.append(state))
    assert sum(state is not None for state in heard) == 2
    with watched(True) as watcher:
        assert watcher.progress is not None and watcher.notify is not None


def test_a_short_solve_shows_no_bar(monkeypatch: pytest.MonkeyPatch) -> None:
    terminal = terminal_of(monkeypatch, patience=60.0)
    tg.solve(solver_cases.model(), STEPS)
    assert terminal.getvalue() == ""


def test_anything_else_is_refused() -> None:
    with refused("progress", "'yes'", "True, False, None"):
        tg.solve(solver_cases.model(), progress="yes")


def test_a_notebook_sees_a_bar_in_html(monkeypatch: pytest.MonkeyPatch) -> None:
    shown: list[str] = []

    def display(data: dict[str, str], *, raw: bool, display_id: bool) -> SimpleNamespace:
        shown.append(data["text/html"])
        return SimpleNamespace(update=lambda data, raw: shown.append(data["text/html"]))

    shell = SimpleNamespace(kernel="of Jupyter")
    python = SimpleNamespace(get_ipython=lambda: shell, display=SimpleNamespace(display=display))
    monkeypatch.setitem(sys.modules, "IPython", python)
    monkeypatch.setattr(notebook_bar, "AT_ONCE", 0.0)
    monkeypatch.setattr(notebook_bar, "REFRESH", 0.0)
    tg.solve(solver_cases.model(), STEPS)
    assert any('<progress value="0.5000" max="1"></progress> load factor 0.500, step 2' in each for each in shown)
    assert shown[-1] == ""
    with watched(None) as watcher:
        assert isinstance(watcher.progress.__self__, NotebookBar)


def test_the_log_has_a_record_of_each_step(caplog: pytest.LogCaptureFixture) -> None:
    with caplog.at_level(logging.INFO, logger="turgor"):
        tg.solve(solver_cases.model(), STEPS)
    said = [record.getMessage() for record in caplog.records if record.name == "turgor"]
    assert len(said) == 2
    assert said[1].startswith("step 2: load factor 1.0000, ")
    assert any(isinstance(each, logging.NullHandler) for each in logging.getLogger("turgor").handlers)
