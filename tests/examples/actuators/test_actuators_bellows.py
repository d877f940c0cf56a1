"""The example jobs of bellows and of actuators with several cavities solve; they move the way the review says."""

from dataclasses import replace

import pytest
from run_example import JOBS, at_the_end, example, run_example

from turgor.core.model.loads import Pressure
from turgor.core.solvers.procedures.static import Static
from turgor.job.read import read_job
from turgor.units import deg, kPa, mm


def driven(name: str, *pressures: float, size: float | None = None, **dimensions: float) -> dict[str, float]:
    """Solve an example with other pressures in its cavities, and perhaps other dimensions."""
    job = example(name)
    loads = tuple(Pressure(f"cavity_{i}", each) for i, each in enumerate(pressures, start=1))
    actuator = replace(job.actuator, **dimensions)
    few = Static(first_step=0.5, max_step=0.5)
    return at_the_end(
        replace(job, actuator=actuator, loads=loads, procedure=few, mesh=replace(job.mesh, size=size or job.mesh_size))
    )


@pytest.mark.slow
def test_a_bellows_extends_by_a_fifth_of_its_length() -> None:
    response = run_example("bellows_of_revolution")
    assert response.column("tip_displacement_x")[-1] == pytest.approx(9.9 * mm, rel=0.03)
    assert response.column("cavity_volume")[-1] > 1.4 * response.column("cavity_volume")[0]


@pytest.mark.slow
def test_the_meridian_of_a_bellows_moves_as_a_fine_one_does() -> None:
    # 9.025 mm at 0.6 mm, 9.022 mm at 1 mm; a quarter of 888 hexahedra moves by 9.016 mm
    assert at_the_end(read_job(JOBS.parent / "axisymmetric_bellows.toml"))["tip_displacement_x"] == pytest.approx(
        9.025 * mm, rel=0.003
    )


@pytest.mark.slow
def test_a_quarter_of_a_bellows_moves_as_its_half_does() -> None:
    job = example("bellows_of_revolution")
    quarter = replace(job, actuator=replace(job.actuator, folds=1))
    half = replace(quarter, actuator=replace(quarter.actuator, quarter=False))
    of_quarter, of_half = at_the_end(quarter), at_the_end(half)
    for name in ("tip_displacement_x", "cavity_volume"):
        assert of_half[name] == pytest.approx(of_quarter[name], rel=0.005)


@pytest.mark.slow
def test_one_chamber_bends_an_omnidirectional_actuator_away_from_it() -> None:
    response = run_example("omnidirectional_actuator")
    assert response.column("bending_angle")[-1] == pytest.approx(1.07 * deg, rel=0.03)
    assert response.column("tip_displacement_z")[-1] < 0
    assert response.column("tip_displacement_x")[-1] > 0


def test_two_chambers_bend_it_back_and_three_stretch_it() -> None:
    one, two, all_three = (
        driven("omnidirectional_actuator", *pressures, size=3.4 * mm, length=25 * mm)
        for pressures in ((6 * kPa, 0.0), (0.0, 6 * kPa), (6 * kPa, 6 * kPa))
    )
    assert one["bending_angle"] > 0.2 * deg
    assert two["bending_angle"] == pytest.approx(-one["bending_angle"], rel=0.05)
    assert abs(all_three["bending_angle"]) < 0.01 * one["bending_angle"]
    assert all_three["tip_displacement_x"] > 2 * one["tip_displacement_x"] > 0


@pytest.mark.parametrize(
    ("name", "pressure", "angle", "error"),
    [("three_extenders", 3 * kPa, 0.92, 0.03), ("parallel_bellows", 1.5 * kPa, 7.99, 0.05)],  # of references
)
@pytest.mark.slow
def test_one_cylinder_tilts_the_plate_away_and_three_push_it_straight_on(name, pressure, angle, error) -> None:
    one, all_three = driven(name, pressure, 0.0), driven(name, pressure, pressure)
    assert one["bending_angle"] == pytest.approx(angle * deg, rel=error)
    assert one["tip_displacement_z"] < 0
    assert abs(all_three["bending_angle"]) < 0.01 * one["bending_angle"]
    assert all_three["tip_displacement_x"] > 2 * one["tip_displacement_x"] > 0


def test_a_revolute_joint_turns_both_ways() -> None:
    assert run_example("revolute_joint").column("bending_angle")[-1] == pytest.approx(1.46 * deg, rel=0.03)
    assert driven("revolute_joint", 0.0, 5 * kPa, size=6 * mm)["bending_angle"] == pytest.approx(-1.46 * deg, rel=0.1)
