"""A hand of three fingers carries a loose ball, and an arm of three segments bends by three pressures."""

import pytest
from run_example import JOBS, solve_job

from turgor.job.read import read_job


@pytest.mark.slow  # 60 s
def test_three_fingers_carry_a_ball_after_the_table_has_gone():
    response = solve_job(read_job(JOBS.parent / "soft_hand.toml"))
    assert response["table_force"][-1] == 0
    assert response["ball_contact_force"][-1] == pytest.approx(0.0980665, rel=1e-3)  # N, its weight
    assert -0.5e-3 < response["ball_displacement_z"][-1] < 0  # m: it has slipped by a quarter of a millimeter
    forces = [response[f"finger_{number}_contact_force"][-1] for number in (1, 2, 3)]
    assert forces == pytest.approx([0.2] * 3, rel=0.03)  # N
    assert response["ball_friction_use"][-1] == pytest.approx(0.36, abs=0.05)
    assert response["ball_grasp_margin"][-1] == pytest.approx(0.39, abs=0.03)


@pytest.mark.slow  # 15 s
def test_an_arm_of_three_segments_bends_by_three_pressures():
    response = solve_job(read_job(JOBS.parent / "soft_arm.toml"))
    assert response["cavity_segment_3_pressure"][-1] == pytest.approx(20e3)
    assert response["plate_segment_3_displacement_z"][-1] < response["plate_segment_2_displacement_z"][-1] < -1e-3  # m
