"""The example jobs of the PneuNets solve, and each actuator moves as its family should."""

from dataclasses import replace

import pytest
from run_example import example, run_example, solve_job

from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
from turgor.core.model.loads import Pressure
from turgor.core.solvers.procedures.static import Static
from turgor.units import deg, kPa


def at_end(response, name="bending_angle"):
    return response.column(name)[-1] / deg


def changed(job, actuator, face, pressure):
    """The job with another actuator and pressure, in larger steps."""
    loads = (Pressure(face, pressure),)
    return replace(job, actuator=actuator, loads=loads, procedure=Static(first_step=0.5, max_step=0.5))


def fast_like(job, pressure):
    """The job with a fast PneuNet in place of its actuator, as many chambers and as long."""
    fast = FastPneuNet(chambers=job.actuator.chambers, length=job.actuator.length)
    return changed(job, fast, "cavity", pressure)


def test_slow_pneunet_bends_far_less_than_the_fast_one():
    slow = run_example("slow_pneunet")
    assert at_end(slow) == pytest.approx(3.42, rel=0.02)  # at 15 kPa
    fast = solve_job(fast_like(example("slow_pneunet"), 1 * kPa))
    assert at_end(fast) > at_end(slow)  # at a fifteenth of the pressure


@pytest.mark.slow
def test_free_bottom_pneunet_bends_more_than_the_fast_one():
    free = run_example("free_bottom_pneunet")
    assert at_end(free) == pytest.approx(10.80, rel=0.02)  # at 3 kPa
    fast = solve_job(fast_like(example("free_bottom_pneunet"), 3 * kPa))
    assert at_end(free) / at_end(fast) == pytest.approx(
        1.27, abs=0.05
    )  # guards drift; the width of the strips was chosen with it


def test_trapezoidal_pneunet_bends_towards_its_base():
    assert at_end(run_example("trapezoidal_pneunet")) == pytest.approx(12.1, rel=0.05)  # at 6 kPa


def test_triangular_pneunet_bends_towards_its_base():
    assert at_end(run_example("triangular_pneunet")) == pytest.approx(10.6, rel=0.05)  # at 6 kPa


@pytest.mark.slow
def test_helical_pneunet_twists_as_it_bends_and_the_other_way_with_the_other_slant():
    response = run_example("helical_pneunet")
    assert at_end(response) == pytest.approx(7.4, rel=0.05)  # at 3 kPa
    assert at_end(response, "twist_angle") == pytest.approx(4.7, rel=0.05)
    job = example("helical_pneunet")
    slanted = replace(job.actuator, chamber_angle=-job.actuator.chamber_angle)
    other = solve_job(changed(job, slanted, "cavity", 1 * kPa))
    assert at_end(other, "twist_angle") == pytest.approx(-1.8, rel=0.05)


def test_bidirectional_pneunet_bends_down_or_up():
    down = run_example("bidirectional_pneunet")
    assert at_end(down) == pytest.approx(6.5, rel=0.05)  # at 3 kPa
    job = example("bidirectional_pneunet")
    up = solve_job(changed(job, job.actuator, "cavity_2", 1 * kPa))
    assert at_end(up) == pytest.approx(-2.33, rel=0.02)


def test_manta_fin_bends_down_and_twists():
    response = run_example("manta_fin")
    assert at_end(response) == pytest.approx(1.24, rel=0.05)  # at 8 kPa
    assert at_end(response, "twist_angle") == pytest.approx(-0.139, rel=0.1)
