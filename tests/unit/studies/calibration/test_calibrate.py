"""Calibration: what is found, what is said about it, and what is refused."""

import os
import signal
import subprocess
import sys
import time
from dataclasses import replace
from math import isnan

import numpy as np
import pytest

import calibration_cases as cases
from refused import refused
from turgor.accuracy.laboratory.runs import within_ranges
from turgor.foundation.response import Column, Response
from turgor.foundation.source import Source
from turgor.studies.calibration.calibrate import calibrate
from turgor.studies.calibration.curve import PathCurve
from turgor.studies.calibration.parameter import Parameter
from turgor.studies.calibration.trial import Trial
from turgor.studies.runs.evaluations import Evaluations, saved_in
from turgor.units import kPa, mm

C10 = Parameter(name="C10", start=0.2e6, unit="MPa")
C20 = Parameter(name="C20", start=0.0, lower=-0.05e6, upper=0.05e6, unit="MPa")


def sphere(measured=None, **options):
    return Trial(measured=measured or cases.measured_sphere(), function=cases.thin_sphere, **options)


def test_two_parameters_of_an_exact_curve_come_out_with_few_runs():
    result = calibrate(sphere(), [C10, C20])
    assert result.values["C10"] == pytest.approx(0.12e6, rel=2e-3)
    assert result.values["C20"] == pytest.approx(0.004e6, rel=0.05)
    assert result.converged
    assert result.solves == result.computed <= 25
    assert result.fits[0].rms < 0.01 * result.fits[0].rms_start
    assert "C10 = 0.12 MPa ±" in result.summary()


def test_updates_of_the_jacobian_save_runs():
    """Without them it is 27 runs."""
    result = calibrate(sphere(), [Parameter(name="C10", start=0.09e6), C20])
    assert result.converged
    assert result.solves <= 23


def test_the_bound_that_is_reached_is_named():
    result = calibrate(
        sphere(cases.measured_sphere(C20=0.0)), [Parameter(name="C10", start=0.2e6, lower=0.15e6, unit="MPa")]
    )
    assert result.status == "at_bound"
    assert result.values["C10"] == pytest.approx(0.15e6, rel=1e-4)
    assert isnan(result.errors["C10"])
    assert "C10 = 0.15 MPa, its lower bound" in result.table()
    assert "Widen the bound of C10" in result.advice


def test_an_offset_and_a_scale_of_the_gauge_cost_no_runs():
    measured = cases.measured_sphere(offset=0.5 * kPa, C20=0.0)
    alone = calibrate(sphere(measured), [C10])
    both = calibrate(sphere(measured), [C10], rig=["pressure_offset"])
    assert both.values["pressure_offset"] == pytest.approx(0.5 * kPa, abs=5)
    assert both.values["C10"] == pytest.approx(0.12e6, rel=2e-3)
    assert abs(alone.values["C10"] / 0.12e6 - 1) > 0.02
    assert both.solves <= alone.solves + 8
    scaled = Response(
        columns=(Column("pressure", "kPa", measured["pressure"] / 1.1 + 1), measured.columns[1]),
        source=Source(text="rig"),
    )
    fixed = Parameter(name="C10", start=0.12e6, lower=0.119e6, upper=0.121e6, prior=(0.12e6, 10.0))
    result = calibrate(sphere(scaled, spread=1e-4), [fixed], rig=["pressure_scale", "stretch_offset"])
    assert result.values["pressure_scale"] == pytest.approx(1.1, rel=0.06)


def test_what_cannot_be_told_apart_is_said():
    """Pressure of a thin sphere depends on the product of stiffness and wall alone."""
    wall = Parameter(name="wall", start=1.2 * mm, unit="mm")
    result = calibrate(sphere(cases.measured_sphere(noise=1e-3, C20=0.0), spread=1e-3), [C10, wall])
    (sentence,) = result.undetermined
    assert "C10 and wall are not determined separately: the curves tell only the product C10 · wall." in sentence
    assert result.values["C10"] * result.values["wall"] == pytest.approx(0.12e6 * 1 * mm, rel=0.01)
    assert result.errors["wall"] > 10 * mm
    known = calibrate(
        sphere(cases.measured_sphere(noise=1e-3, C20=0.0), spread=1e-3),
        [C10, Parameter(name="wall", start=1.2 * mm, prior=(1 * mm, 0.05 * mm), unit="mm")],
    )
    assert known.values["C10"] == pytest.approx(0.12e6, rel=0.02)
    assert known.errors["C10"] == pytest.approx(0.05 * known.values["C10"], rel=0.05)
    assert "rests on the prior of wall" in known.undetermined[0]


def test_a_prior_keeps_its_width_where_the_spread_is_not_known():
    wall = Parameter(name="wall", start=1.2 * mm, prior=(1 * mm, 0.05 * mm), unit="mm")
    result = calibrate(sphere(cases.measured_sphere(noise=1e-4, C20=0.0)), [C10, wall])
    assert result.errors["wall"] == pytest.approx(0.05 * mm, rel=0.1)
    assert result.values["wall"] == pytest.approx(1 * mm, rel=0.01)


def test_a_parameter_without_effect_is_said():
    reach = Parameter(name="up_to", start=1.4, lower=1.35, upper=1.6)
    result = calibrate(sphere(cases.measured_sphere(noise=1e-3, C20=0.0), spread=1e-3), [C10, reach])
    assert any(
        each.startswith("up_to is not determined: the curves hardly depend on it") for each in result.undetermined
    )
    assert result.values["C10"] == pytest.approx(0.12e6, rel=2e-3)


@pytest.mark.parametrize(("noise", "told"), [(2e-4, 0), (2e-2, 1)])
def test_noise_decides_what_is_determined(noise, told):
    """Stiffness and wall of a thick sphere act almost alike: a good rig tells them apart, a bad one does not."""
    exact = cases.thick_sphere()
    draws = np.random.default_rng(2).standard_normal(24)
    at = np.repeat(exact["pressure"], 4)
    measured = cases.response(at, np.repeat(exact["inner_stretch"], 4) + noise * draws)
    wall = Parameter(name="wall", start=4.5 * mm, unit="mm")
    trial = Trial(measured=measured, function=cases.thick_sphere, y="inner_stretch=stretch", spread=noise)
    result = calibrate(trial, [Parameter(name="C10", start=0.13e6), wall])
    assert len(result.undetermined) == told
    if told:
        assert "C10 and wall are not determined separately" in result.undetermined[0]
    else:
        assert result.values["wall"] == pytest.approx(5 * mm, rel=0.05)


def test_two_experiments_determine_what_one_does_not():
    """A second sphere with a known wall gives the stiffness, and the first one its wall."""
    wall = Parameter(name="wall", start=1.2 * mm, unit="mm")
    known = Trial(
        measured=cases.measured_sphere(noise=1e-3, wall=2 * mm, C20=0.0), function=cases.widening, spread=1e-3
    )
    result = calibrate([sphere(cases.measured_sphere(noise=1e-3, C20=0.0), spread=1e-3), known], [C10, wall])
    assert result.undetermined == ()
    assert result.values["wall"] == pytest.approx(1 * mm, rel=0.02)
    assert len(result.fits) == 2


def test_a_trial_that_is_held_out_is_predicted():
    other = Trial(measured=cases.measured_sphere(wall=2 * mm, C20=0.0), function=cases.widening, name="thick one")
    result = calibrate(sphere(cases.measured_sphere(C20=0.0)), [C10], hold_out=[other])
    (held,) = result.held_out
    assert held.rms < 2e-3 < held.rms_start
    assert "held out: thick one: stretch differs by" in result.summary()
    assert [len(each.to_response()) for each in (*result.fits, held)] == [25, 25]


def test_runs_that_fail_are_avoided_and_told():
    measured = cases.measured_sphere(C10=0.104e6, C20=0.0)
    result = calibrate(Trial(measured=measured, function=cases.breaks_when_soft), [C10])
    assert result.values["C10"] == pytest.approx(0.104e6, rel=2e-3)
    lowest = Parameter(name="C10", start=0.12e6, lower=0.05e6)
    result = calibrate(
        Trial(measured=cases.measured_sphere(C10=0.09e6, C20=0.0), function=cases.breaks_when_soft), [lowest]
    )
    assert result.failures
    assert "ended at its first step" in result.failures[0]
    assert result.values["C10"] == pytest.approx(0.1e6, rel=0.05)
    with refused("rig: C10 90000", "path"):
        calibrate(Trial(measured=measured, function=cases.breaks_when_soft), [Parameter(name="C10", start=0.09e6)])


def test_a_path_that_ends_below_the_measured_range_is_continued_and_told():
    result = calibrate(Trial(measured=cases.measured_sphere(C20=0.0), function=cases.ends_early), [C10])
    assert result.values["C10"] == pytest.approx(0.12e6, rel=0.05)
    assert "measured rows of rig lie beyond the computed curve" in result.message
    assert "could not rise past 12 kPa" in result.message


def test_rows_beyond_a_prescribed_drive_are_refused():
    """A straight continuation of a curve that ends at 60 % made C10 16 % lower."""
    measured = cases.measured_sphere(C20=0.0)
    top = 0.6 * float(measured.column("pressure").max())
    whole = Trial(measured=measured, function=_up_to, values={"top": top}, prescribed=True)
    with refused("rig", "'pressure'", "within_ranges"):
        calibrate(whole, [C10])
    part = within_ranges(measured, [f"pressure=0..{top / kPa} kPa"])
    result = calibrate(replace(whole, measured=part), [C10])
    assert result.values["C10"] == pytest.approx(0.12e6, rel=2e-3)


def _up_to(C10, top):
    """A thin sphere that is computed up to a pressure."""
    whole = cases.thin_sphere(C10=C10, C20=0.0)
    at = np.linspace(0, top, 40)
    columns = [
        Column(name, whole.find(name).unit, np.interp(at, whole.column("pressure"), whole.column(name)))
        for name in whole.names
    ]
    return Response(columns=tuple(columns), source=whole.source)


def test_all_runs_used_up():
    result = calibrate(sphere(), [Parameter(name="C10", start=1e6, unit="MPa"), C20], most_solves=5)
    assert result.status == "not_converged"
    assert result.solves <= 8
    assert "Not converged: all" in result.message and "would lower the differences by about" in result.message
    assert "most_solves" in result.advice
    assert result.fits[0].rms <= result.fits[0].rms_start


def test_mistakes_are_answered():
    with refused("'C11'", "'C10'"):
        calibrate(sphere(), [Parameter(name="C11", start=1.0)])
    with refused("rig", "'presure_offset'", "'pressure_offset'"):
        calibrate(sphere(), [C10], rig=["presure_offset"])
    with refused("parameters", "'C10'", "two"):
        calibrate(sphere(), [C10, C10])
    with refused("calibration", "parameter"):
        calibrate(sphere(), [])
    with refused("calibration", "trial"):
        calibrate([], [C10])
    with refused("'C10'", "0.2 MPa", "0.3 MPa to 2 MPa"):
        Parameter(name="C10", start=0.2e6, lower=0.3e6, unit="MPa")
    with refused("'C20'", "0 MPa", "lower", "upper"):
        Parameter(name="C20", start=0.0, unit="MPa")
    with refused("'C10'", "2 and 1"):
        Parameter(name="C10", start=1.0, lower=2.0, upper=1.0)
    with refused("'C10'", "(1.0, 0.0)", "standard deviation"):
        Parameter(name="C10", start=1.0, prior=(1.0, 0.0))
    with refused("'C10'", "step 2", "0 and 1"):
        Parameter(name="C10", start=1.0, step=2.0)
    with refused("'rig'", "spread", -1, "above 0"):
        sphere(spread=-1.0)
    with refused("most_solves", 2, "4 or more"):
        calibrate(sphere(), [C10, C20], most_solves=2)
    flat = Response(
        columns=(Column("pressure", "kPa", [0, 1e3, 2e3]), Column("stretch", "", [1, 1, 1])), source=Source(text="flat")
    )
    with refused("'flat'", "'stretch'", 1):
        calibrate(sphere(flat), [C10])


def test_a_spread_of_repeated_runs_weighs_the_rows():
    measured = cases.measured_sphere(C20=0.0)
    wrong = measured["stretch"].copy()
    wrong[-5:] += 0.05
    spread = np.where(np.arange(25) >= 20, 1.0, 1e-3)
    columns = (measured.columns[0], Column("stretch", "", wrong), Column("stretch_spread", "", spread))
    result = calibrate(sphere(Response(columns=columns, source=Source(text="rig"))), [C10])
    assert result.values["C10"] == pytest.approx(0.12e6, rel=3e-3)


def test_a_computed_curve_is_smooth_and_goes_on_straight():
    x = np.linspace(0.0, 1.0, 6)
    curve = Response(columns=(Column("pressure", "", x), Column("y", "", x**2)), source=Source(text="a parabola"))
    at = np.array([0.5, 0.9])
    made = PathCurve.of(curve, "pressure", "y")
    smooth = np.abs(made.at(at) - at**2)
    assert smooth.max() < 0.3 * np.abs(np.interp(at, x, x**2) - at**2).max()
    assert made.at(np.array([1.5, -1.0])) == pytest.approx([1 + 1.8 * 0.5, -0.2])


SCRIPT = """
import sys
from pathlib import Path
import calibration_cases as cases
from turgor.studies.calibration.calibrate import calibrate
from turgor.studies.calibration.curve import PathCurve
from turgor.studies.runs.evaluations import saved_in
from turgor.studies.calibration.parameter import Parameter
from turgor.studies.calibration.trial import Trial

if __name__ == "__main__":
    log = sys.argv[1]
    trial = Trial(measured=cases.measured_sphere(C20=0.0), function=cases.thin_sphere, values={"log": log})
    found = calibrate(trial, [Parameter(name="C10", start=0.3e6)], evaluations=saved_in("runs"))
    print(found.values["C10"], found.solves, found.computed)
"""


def test_killed_and_called_again_it_computes_nothing_twice(tmp_path):
    (tmp_path / "script.py").write_text(SCRIPT, encoding="utf-8")
    log = tmp_path / "log"
    call = [sys.executable, "script.py", str(log)]
    around = {"cwd": tmp_path, "env": {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}}
    process = subprocess.Popen(call, start_new_session=True, **around)
    ended = time.monotonic() + 60
    while len(list((tmp_path / "runs").glob("*.json"))) < 2 and time.monotonic() < ended:
        time.sleep(0.05)
    os.killpg(process.pid, signal.SIGKILL)
    process.wait()
    kept = len(list((tmp_path / "runs").glob("*.json")))
    assert kept >= 2
    said = subprocess.run(call, capture_output=True, text=True, check=True, **around).stdout.split()
    value, solves, computed = float(said[0]), int(said[1]), int(said[2])
    assert value == pytest.approx(0.12e6, rel=2e-3)
    assert computed == solves - kept
    begun = log.read_text().splitlines()
    assert len(begun) <= solves + 1  # what was being computed when it was killed, at most
    assert len(set(begun)) == solves


def test_evaluations_compute_each_value_once():
    runs = Evaluations()
    first = calibrate(sphere(), [C10], evaluations=runs)
    again = calibrate(sphere(), [C10], evaluations=runs)
    assert (first.solves > 5, again.solves) == (True, 0)
    assert again.values == first.values


def test_processes_at_once_find_the_same(tmp_path):
    free = [Parameter(name="C10", start=0.125e6), Parameter(name="C20", start=0.004e6, lower=-0.05e6, upper=0.05e6)]
    several = calibrate(sphere(), free, evaluations=saved_in(tmp_path, processes=2))
    assert several.values == calibrate(sphere(), free).values
    assert len(list(tmp_path.glob("*.json"))) == several.solves


def test_runs_that_are_used_up_at_a_good_curve_have_converged():
    """The curve lies within 0.1 % of its range, which no rig resolves: that the runs are used up changes nothing."""
    near = [
        Parameter(name="C10", start=1.005 * 0.12e6, unit="MPa"),
        Parameter(name="C20", start=0.004e6 / 1.005**3),
    ]
    result = calibrate(sphere(), near, most_solves=4)
    assert result.fits[0].rms < 1e-3 * np.ptp(result.fits[0].data.value)
    assert result.converged, result.message
