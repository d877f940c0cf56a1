"""The finger of a CAD program bends towards the plate that closes it, and its cavity is measured."""

from math import pi
from pathlib import Path

import numpy as np
import pytest

import turgor as tg
from turgor.job.prepare import prepare
from turgor.units import mm

JOB = Path(__file__).parents[3] / "examples" / "cad_file.toml"

#: Four rooms of 5.5 x 13 x 11.5 mm, three channels of 4.5 x 3 x 3 mm, an inlet of 2.4 mm through a wall of 1.5 mm.
VOLUME = 4 * 5.5 * 13 * 11.5 + 3 * 4.5 * 9 + pi * 1.44 * 1.5


def test_the_finger_bends():
    job = tg.jobs.read_job(JOB)
    assert job.actuator.build().cavity_volume / mm**3 == pytest.approx(VOLUME, rel=1e-6)
    model, _ = prepare(job)
    response = tg.measure(tg.solve(model, job.procedure), tg.bending_angle, tg.cavity_volume)
    assert response.column("cavity_volume")[0] / mm**3 == pytest.approx(VOLUME, rel=1e-4)
    assert np.rad2deg(response.column("bending_angle")[-1]) == pytest.approx(42.5, abs=1.5)
