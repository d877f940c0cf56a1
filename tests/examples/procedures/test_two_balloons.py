"""Two balloons at one pressure: beyond the limit point of the weaker one, the stronger one empties into it."""

from pathlib import Path

import numpy as np
import pytest
from run_example import solve_job

import turgor as tg
from turgor.units import kPa, mL

JOB = Path(__file__).parents[3] / "examples" / "two_balloons.toml"


def test_the_stronger_balloon_empties_into_the_weaker_one():
    response = solve_job(tg.jobs.read_job(JOB))
    pressure = response.column("pressure")
    weak, strong = (response.column(f"cavity_{k}_volume") for k in (1, 2))
    top = int(pressure.argmax())
    # thick neo-Hookean spheres of 10 mm and walls of 1 and 1.1 mm: maxima of 28.323 and 31.006 kPa (exact)
    assert pressure[top] / kPa == pytest.approx(28.323, rel=2e-3)
    assert weak[top] / mL == pytest.approx(12.15, rel=0.02)
    assert (np.diff(weak) > 0).all()
    assert (np.diff(strong)[:top] > 0).all() and (np.diff(strong)[top:] < 0).all()
    assert (np.diff(weak + strong) > 0).all(), "the path needs no more than a pump of liquid"
