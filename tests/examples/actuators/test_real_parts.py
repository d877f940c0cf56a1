"""The example jobs of a print, a film and a textile muscle solve, and move as far as the how-tos show.

The print has a mesh that differs from machine to machine, and an estimated mesh error of 7 % at its size, which is
the tolerance.
"""

from pathlib import Path

import numpy as np
import pytest
from run_example import JOBS, at_the_end

from turgor.core.solvers.solve import solve
from turgor.job.prepare import prepare
from turgor.job.read import read_job


def angle(name: str) -> float:
    """Bending angle of `examples/<name>.toml` at its end [deg]."""
    return float(np.rad2deg(at_the_end(read_job(JOBS.parent / f"{name}.toml"))["bending_angle"]))


def test_a_print_bends() -> None:
    assert angle("print") == pytest.approx(12.5, rel=0.07)


@pytest.mark.slow
def test_a_textile_muscle_lifts_a_weight() -> None:
    at_end = at_the_end(read_job(JOBS.parent / "textile_muscle.toml"))
    assert at_end["tip_displacement_x"] == pytest.approx(-10.75e-3, rel=0.02)


@pytest.mark.slow
def test_a_pneunet_bends_on_paper_that_wrinkles() -> None:
    assert angle("film") == pytest.approx(8.06, rel=0.01)


@pytest.mark.slow
def test_a_chamber_bends_above_a_stiff_film() -> None:
    """As in tests/verification/membranes_shells/test_tension_field.py, from its job."""
    assert angle("stiff_film") == pytest.approx(2.143, rel=0.005)


@pytest.mark.slow
def test_paper_wrinkles_while_the_tip_is_blocked(tmp_path: Path) -> None:
    """The slow PneuNet on paper, its tip on a plate: 58 iterations."""
    job = tmp_path / "job.toml"
    text = (JOBS.parent / "film.toml").read_text(encoding="utf-8")
    blocked = '[procedure]\ntype = "blocked_force"\n'
    job.write_text(text[: text.index("[output]")] + blocked, encoding="utf-8")
    read = read_job(job)
    assert solve(prepare(read)[0], read.procedure).iterations < 90
