"""The finger of the example hangs, is filled and is pressed upon, as its stages say."""

from pathlib import Path

import numpy as np
import pytest
from run_example import solve_job

import turgor as tg
from turgor.units import kPa, mL

JOB = Path(__file__).parents[3] / "examples" / "hang_fill_press.toml"


def test_the_finger_goes_through_its_stages():
    response = solve_job(tg.jobs.read_job(JOB))
    assert list(dict.fromkeys(response.stages)) == ["hang", "fill", "press"]
    ends = [int(np.flatnonzero(response.column("stage") == number)[0]) for number in (1, 2, 3)]
    pressure, volume = response.column("pressure")[ends] / kPa, response.column("cavity_volume")[ends] / mL
    assert pressure == pytest.approx([0, 8.48, 9.09], rel=0.02)
    assert volume[1] - volume[0] == pytest.approx(0.5, rel=1e-5)
    assert volume[2] == pytest.approx(volume[1], rel=1e-5)
    assert np.rad2deg(response.column("bending_angle")[ends]) == pytest.approx([4.46, 22.3, 13.7], rel=0.03)
    assert response.column("plate_force")[ends] == pytest.approx([0, 0, 0.060], abs=0.003)
