"""Ctrl-C during a solve of a study ends the study, and is no failure that is kept."""

from pathlib import Path

import pytest
import solver_cases

import turgor as tg
from turgor.foundation.response import Response
from turgor.studies.runs.executors.run_outcome import compute
from turgor.studies.runs.run import Run


def pressed_at(limit: float) -> Response:
    """A solve during which Ctrl-C is pressed."""

    def press(iteration: object, state: tg.solutions.State | None) -> None:
        if state is not None and state.load_factor > limit:
            raise KeyboardInterrupt

    return tg.measure(tg.solve(solver_cases.model(), progress=press), "reaction", mesh_error=False)


def stopped(limit: float) -> Response:
    """A solve that fails."""
    tg.solve(solver_cases.model(), tg.Static(first_step=limit, max_step=limit, max_steps=1))
    raise AssertionError


def test_a_solve_that_is_interrupted_ends_the_study(tmp_path: Path) -> None:
    with pytest.raises(KeyboardInterrupt):
        compute(Run(name="one", function=pressed_at, values={"limit": 0.1}), tmp_path)
    assert list(tmp_path.iterdir()) == []


def test_a_solve_that_fails_is_a_row_with_its_sentence(tmp_path: Path) -> None:
    ended = compute(Run(name="one", function=stopped, values={"limit": 0.1}), tmp_path)
    assert ended.final and ended.problem.startswith("step_limit: Stopped at")
