"""Console: rejected steps, findings before the solve, and lines that fit the terminal."""

import io
import re
from dataclasses import replace

import pytest
import results_cases as cases
import typer
from rich.console import Console

from turgor.cli.console import PlainDisplay
from turgor.cli.exits import NOT_CONVERGED, errors_as_sentences
from turgor.cli.live import LiveDisplay
from turgor.core.solvers.solution import Iteration
from turgor.core.solvers.step_reasons import Cause, Reason
from turgor.foundation.errors import NotSolved
from turgor.foundation.finding import Finding, Severity

STATE = cases.state(cases.model(cases.body()), None, 0.25)
ACCEPTED = Iteration(step=5, iteration=4, load_factor=0.25, residual=2e-7, correction=0.0, step_length=1.0)
REJECTED = Iteration(
    step=6, iteration=15, load_factor=0.5, residual=0.3, correction=0.0, step_length=1.0,
    rejected=Reason(Cause.TOO_MANY_ITERATIONS, 15),
)  # fmt: skip
WARNING = Finding(code="P02", severity=Severity.WARNING, message="Pressure in 'cavity': 1 MPa.", advice="Check it.")


def written(width=100, terminal=False):
    stream = io.StringIO()
    return Console(file=stream, width=width, force_terminal=terminal, color_system=None, legacy_windows=False), stream


def test_a_rejected_step_is_a_line_of_the_plain_display():
    console, stream = written()
    display = PlainDisplay(console)
    display.progress(ACCEPTED, STATE)
    display.progress(REJECTED, None)
    lines = stream.getvalue().splitlines()
    assert len(lines) == 2
    assert lines[1].endswith("] step 6 cut back: no convergence in 15 iterations at load factor 0.5000")


def test_newton_updates_are_no_lines():
    console, stream = written()
    PlainDisplay(console).progress(replace(REJECTED, rejected=None), None)
    assert stream.getvalue() == ""


def test_a_rejected_step_is_a_line_above_the_bar():
    console, stream = written(terminal=True)
    with LiveDisplay(console) as display:
        display.progress(ACCEPTED, STATE)
        display.progress(REJECTED, None)
    assert "step 6 cut back: no convergence in 15 iterations at load factor 0.5000" in stream.getvalue()


@pytest.mark.parametrize("width", [30, 40, 60, 80, 120])
def test_the_bar_fits_its_terminal_in_one_line_with_the_time_left(width):
    console, stream = written(width, terminal=True)
    with LiveDisplay(console) as display:
        display.notify("building the actuator and everything around it in one long activity")
        display.progress(ACCEPTED, STATE)
        display._course.angle = 4.5
        display.progress(ACCEPTED, STATE)
        display.progress(REJECTED, None)
    other, shown = written(width)
    other.print(display._bar.get_renderable())
    lines = shown.getvalue().splitlines()
    assert len(lines) == 1
    assert len(lines[0]) <= width
    assert "left" in lines[0]
    assert "0.250" in lines[0]
    if width >= 120:
        assert "step 6, iteration 15, residual 3.0e-01, bending" in lines[0]
    longest = max(len(line) for line in re.sub(r"\x1b\[[0-9;?]*[A-Za-z]", "", stream.getvalue()).splitlines())
    assert longest <= width


@pytest.mark.parametrize("quiet", [False, True])
def test_findings_before_the_solve_go_to_standard_error_also_when_quiet(quiet, capsys):
    stream = io.StringIO()
    display = PlainDisplay(Console(file=stream, quiet=quiet))
    display.report(WARNING)
    assert capsys.readouterr().err == "P02 warning: Pressure in 'cavity': 1 MPa. Check it.\n"
    assert display.reported == [WARNING]


def test_findings_stand_above_the_bar():
    console, stream = written(terminal=True)
    with LiveDisplay(console) as display:
        display.report(WARNING)
    assert "P02 warning: Pressure in 'cavity': 1 MPa. Check it." in stream.getvalue()


def test_a_computation_that_did_not_end_has_an_exit_code_of_its_own(capsys):
    with pytest.raises(typer.Exit) as ended, errors_as_sentences(debug=False):
        raise NotSolved("step_too_small: No equilibrium was found.")
    assert ended.value.exit_code == NOT_CONVERGED
    assert capsys.readouterr().err == "step_too_small: No equilibrium was found.\n"
