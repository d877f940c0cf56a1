"""Standard errors and intervals of a calibration are those of statistics.

Problem: a straight line through measured points, whose least squares are known in closed form; a thin sphere of a Yeoh
rubber with known noise, calibrated again and again with other noise.
Exact: covariance σ² (XᵀX)⁻¹ of a line, with a prior (XᵀX/σ² + P⁻¹)⁻¹; 95 % of the 95 % intervals hold the true value;
the spread of the estimates is their standard error.
Tolerance: a line is exact but for rounding, and with a prior for where the search ends, far below a standard error. Of
100 draws 95 % ± 5 % lie within (two standard deviations of a binomial are 4.4 %); the standard deviation of 100 draws
is known to 7 %, hence 20 %.
"""

import numpy as np
import pytest

import calibration_cases as cases
from turgor.studies.calibration.calibrate import calibrate
from turgor.studies.calibration.parameter import Parameter
from turgor.studies.calibration.trial import Trial

HEIGHT = Parameter(name="height", start=0.0, lower=-1.0, upper=1.0, unit="N")
SLOPE = Parameter(name="slope", start=0.0, lower=-4.0, upper=4.0, unit="N")
NOISE, DRAWS = 0.05, 100


def line(parameters=(HEIGHT, SLOPE), seed=0, **options):
    measured = cases.measured_line(0.3, 2.0, NOISE, seed)
    x = measured["pressure"] / 10e3
    table = np.column_stack([np.ones_like(x), x])
    return calibrate(Trial(measured=measured, function=cases.straight, **options), parameters), table, measured["force"]


def test_a_line_has_the_covariance_of_linear_least_squares(record_verification):
    result, table, force = line(spread=NOISE, seed=4)
    covariance = NOISE**2 * np.linalg.inv(table.T @ table)
    exact = np.linalg.lstsq(table, force, rcond=None)[0]
    errors = np.sqrt(np.diag(covariance))
    scatter = max(np.sqrt(np.sum((table @ exact - force) ** 2) / 18) / NOISE, 1.0)
    got = [*result.values.values(), *result.errors.values(), result.correlation[0, 1]]
    expected = [*exact, *(scatter * errors), covariance[0, 1] / errors.prod()]
    record_verification(
        claim="calibration of a straight line: height and slope, their standard errors [N], and their correlation",
        source="linear least squares",
        expected=np.round(expected, 6),
        got=np.round(got, 6),
        tolerance="1e-5",
    )
    assert got == pytest.approx(expected, rel=1e-5, abs=1e-5)


def test_an_unknown_spread_is_that_of_the_differences():
    result, table, force = line(seed=2)
    exact = np.linalg.lstsq(table, force, rcond=None)[0]
    scatter = np.sqrt(np.sum((table @ exact - force) ** 2) / 18)
    expected = scatter * np.sqrt(np.diag(np.linalg.inv(table.T @ table)))
    assert list(result.errors.values()) == pytest.approx(expected, rel=1e-4)
    low, high = result.intervals["slope"]
    assert (high - low) / 2 / expected[1] == pytest.approx(2.1009, rel=1e-3)  # Student's t, 18 degrees of freedom


def test_a_prior_is_a_measurement_more():
    prior = Parameter(name="slope", start=0.0, lower=-4.0, upper=4.0, prior=(1.5, 0.04))
    result, table, force = line((HEIGHT, prior), spread=NOISE, seed=1)
    normal = table.T @ table / NOISE**2 + np.diag([0.0, 1 / 0.04**2])
    exact = np.linalg.solve(normal, table.T @ force / NOISE**2 + np.array([0.0, 1.5 / 0.04**2]))
    assert list(result.values.values()) == pytest.approx(exact, rel=1e-4)  # the search ends a little before
    scatter = max(result.estimate.scatter, 1.0)
    assert list(result.errors.values()) == pytest.approx(scatter * np.sqrt(np.diag(np.linalg.inv(normal))), rel=1e-3)


@pytest.mark.slow
def test_intervals_hold_the_true_values(record_verification):
    free = [Parameter(name="C10", start=0.15e6), Parameter(name="C20", start=0.0, lower=-0.05e6, upper=0.05e6)]
    within, values, errors = [], [], []
    for seed in range(DRAWS):
        measured = cases.measured_sphere(noise=1e-3, seed=seed, most=8.5e3)  # far from its limit point
        result = calibrate(Trial(measured=measured, function=cases.thin_sphere, values={"up_to": 1.35}), free)
        assert result.converged
        within.append([low <= cases.TRUE[name] <= high for name, (low, high) in result.intervals.items()])
        values.append([*result.values.values()])
        errors.append([*result.errors.values()])
    shares = np.mean(within, axis=0)
    ratios = np.std(values, axis=0) / np.mean(errors, axis=0)
    record_verification(
        claim="calibration of a Yeoh sphere with noise, 100 draws: share of 95 % intervals that hold C10 and C20",
        source="statistics",
        expected="0.95",
        got=shares,
        tolerance="0.05",
    )
    record_verification(
        claim="the same: standard deviation of the estimates over their standard error, C10 and C20",
        source="statistics",
        expected="1",
        got=np.round(ratios, 3),
        tolerance="0.2",
    )
    assert shares == pytest.approx(0.95, abs=0.05)
    assert ratios == pytest.approx(1.0, abs=0.2)
