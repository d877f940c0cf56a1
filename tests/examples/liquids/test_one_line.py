"""One supply line for two chambers: the far one fills through a channel, so the bender bends and straightens again."""

from dataclasses import replace
from pathlib import Path

import pytest
from run_example import solve_job

import turgor as tg
from turgor.units import deg, kPa

JOB = Path(__file__).parents[3] / "examples" / "one_line.toml"


def test_the_far_side_lags_behind():
    job = tg.jobs.read_job(JOB)
    job = replace(job, procedure=tg.Static(duration=8.0, first_step=0.05, max_step=0.1))
    response = solve_job(job)
    angle, near, far = (response.column(n) for n in ("bending_angle", "cavity_1_pressure", "cavity_2_pressure"))
    assert response.column("time")[1] == pytest.approx(0.4)
    assert angle[1] / deg == pytest.approx(2.8, rel=0.05)  # at 0.4 s, when the supply has just reached 30 kPa
    assert far[1] / kPa == pytest.approx(8.7, rel=0.05)
    assert far[-1] / near[-1] == pytest.approx(1, abs=0.02)
    assert abs(angle[-1]) < 0.1 * angle[1]
