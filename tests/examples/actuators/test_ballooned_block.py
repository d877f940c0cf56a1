"""A block that balloons until its cells fold: they are cut on the way, and the path goes on."""

from pathlib import Path

import numpy as np
import pytest
from run_example import solve_job

import turgor as tg
from turgor.units import kPa, mL

JOB = Path(__file__).parents[3] / "examples" / "ballooned_block.toml"


def test_the_block_is_filled_with_new_cells():
    response = solve_job(tg.jobs.read_job(JOB))
    assert response.status == "converged"
    assert response["injected_volume"][-1] == pytest.approx(6.5 * mL)
    # 47.07 kPa at 30 times the volume (here 30.1) on hexahedra that were cut on the way
    assert response["pressure"][-1] / kPa == pytest.approx(47.0, rel=0.01)
    assert (np.diff(response["cavity_volume"]) > 0).all()
