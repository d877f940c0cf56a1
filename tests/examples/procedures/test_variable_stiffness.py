"""The bender on a core that melts keeps its shape when the core freezes, and loses it when the core melts again."""

from pathlib import Path

import numpy as np
import pytest
from run_example import solve_job

import turgor as tg
from turgor.units import mm

JOB = Path(__file__).parents[3] / "examples" / "variable_stiffness.toml"


@pytest.mark.slow
def test_the_frozen_core_keeps_the_shape():
    response = solve_job(tg.jobs.read_job(JOB))
    assert list(dict.fromkeys(response.stages)) == ["melt", "bend", "freeze", "release", "melt again"]
    ends = [int(np.flatnonzero(response.column("stage") == number)[0]) for number in range(1, 6)]
    melt, bend, freeze, release, again = response.column("tip_displacement_z")[ends] / mm
    assert bend == pytest.approx(-4.89, rel=0.03) and freeze == pytest.approx(bend, rel=0.01)
    assert release / bend == pytest.approx(0.948, abs=0.02), "shape fixity"
    assert max(abs(melt), abs(again)) < 1e-3 * abs(bend)
