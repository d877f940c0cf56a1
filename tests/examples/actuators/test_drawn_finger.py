"""The finger that a Python function draws has the cavity of its dimensions, and bends towards its floor."""

from pathlib import Path

import numpy as np
import pytest

import turgor as tg
from turgor.job.prepare import prepare
from turgor.units import mm

JOB = Path(__file__).parents[3] / "examples" / "drawn_finger.toml"

#: Rooms of 5 x 9 x 8.5 mm, and 4 x 2 mm of channel through 9 mm of walls and gaps.
VOLUME = 3 * 5 * 9 * 8.5 + 9 * 4 * 2


def test_the_finger_bends():
    job = tg.jobs.read_job(JOB, {"mesh.size": "6 mm"})
    model, _ = prepare(job)
    response = tg.measure(tg.solve(model, job.procedure), tg.bending_angle, tg.cavity_volume)
    assert response.column("cavity_volume")[0] / mm**3 == pytest.approx(VOLUME, rel=1e-4)
    assert np.rad2deg(response.column("bending_angle")[-1]) == pytest.approx(20.5, abs=1.5)
