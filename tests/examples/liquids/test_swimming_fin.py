"""A fin that flaps in water pushes itself away from its tip."""

from pathlib import Path

import pytest
from run_example import solve_job

import turgor as tg
from turgor.units import deg, mN

JOB = Path(__file__).parents[3] / "examples" / "swimming_fin.toml"


@pytest.mark.slow
def test_the_fin_swims_towards_its_root():
    response = solve_job(tg.jobs.read_job(JOB))
    assert response.column("bending_angle").max() / deg == pytest.approx(14.3, rel=0.03)
    # ½ m ⟨v²⟩ of its tip is 0.050 mN, with the width of the tip; the fin is wider before it
    assert response.column("thrust_x")[-1] / mN == pytest.approx(-0.0443, rel=0.05)
