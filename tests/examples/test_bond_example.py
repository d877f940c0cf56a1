"""The seam of a finger cast in two halves opens at the pressure that the guide states."""

import pytest
from run_example import JOBS, solve_job

from turgor.job.read import read_job


@pytest.mark.slow  # 10 s
def test_a_glued_seam_bears_25_kpa():
    response = solve_job(read_job(JOBS.parent / "bond_peel.toml"))
    assert response["pressure"].max() == pytest.approx(25.5e3, rel=0.02)  # Pa; then it falls while the seam opens
    assert response["pressure"][-1] < response["pressure"].max()
    assert response["seam_peel_damage"][-1] == pytest.approx(0.44, rel=0.05)  # after 1.3 mL
