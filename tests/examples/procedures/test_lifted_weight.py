"""The bellows of the example is pressed together by the weight on its plate, and lifts it with its pressure."""

from pathlib import Path

import numpy as np
import pytest
from run_example import solve_job
from turgor.measures import total_mass

import turgor as tg
from turgor.units import mm

JOB = Path(__file__).parents[3] / "examples" / "lifted_weight.toml"


@pytest.mark.slow
def test_the_weight_is_pressed_down_and_lifted():
    job = tg.jobs.read_job(JOB)
    response = solve_job(job)
    weighed = int(np.flatnonzero(response.column("load_factor") >= 0.3 - 1e-9)[0])
    lifted = response.column("plate_displacement_x")[[weighed, -1]] / mm
    assert lifted == pytest.approx([-10.1, 10.0], rel=0.03)
    rubber = total_mass(tg.Model(tg.jobs.prepare(job)[0].mesh, job.materials, [], []))
    assert response.column("reaction")[-1] == pytest.approx((0.1 + rubber) * 9.80665, rel=1e-6)
