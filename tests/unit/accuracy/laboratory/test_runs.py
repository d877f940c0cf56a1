"""Branches of a drive, and the mean and spread of repeated runs."""

import numpy as np
import pytest

from refused import refused
from turgor.accuracy.laboratory.runs import average_runs, branches, interpolated, loading, unloading, within_ranges
from turgor.foundation.response import Column, Response
from turgor.foundation.source import Source


def run(pressure, angle, text: str = "a test") -> Response:
    columns = Column("pressure", "kPa", np.asarray(pressure, float)), Column("angle", "deg", np.asarray(angle, float))
    return Response(columns=columns, source=Source(text=text))


def test_noise_makes_no_branch() -> None:
    time = np.linspace(0, 1, 400)
    drive = 1 - np.abs(2 * time - 1) + 0.01 * np.random.default_rng(3).standard_normal(400)
    result = branches(drive)
    assert len(result) == 2
    assert drive[result[0][1]] == drive.max()


def test_loading_and_unloading_share_no_row_but_the_turn() -> None:
    pressure = [0, 1, 2, 3, 2, 1, 0, 1, 2]
    cycle = run(pressure, range(9))
    np.testing.assert_allclose(loading(cycle)["angle"], [0, 1, 2, 3, 6, 7, 8])
    np.testing.assert_allclose(unloading(cycle)["angle"], [3, 4, 5, 6])
    with refused("'pressure'", "falls"):
        unloading(run([0, 1, 2], [0, 1, 2]))


def test_mean_and_spread_of_lines() -> None:
    rng = np.random.default_rng(0)
    slopes = np.array([1.0, 2.0, 4.0])
    runs = []
    for slope in slopes:
        at = np.sort(rng.uniform(0, 10, 50))
        runs.append(run(at, slope * at))
    mean = average_runs(runs, rows=5)
    np.testing.assert_allclose(mean["angle"], slopes.mean() * mean["pressure"], rtol=1e-12)
    np.testing.assert_allclose(mean["angle_spread"], slopes.std(ddof=1) * mean["pressure"], rtol=1e-12)
    assert mean["pressure"][0] == max(each["pressure"].min() for each in runs)


def test_runs_that_cannot_be_averaged() -> None:
    with refused("average_runs", "two", 1):
        average_runs([run([0, 1], [0, 1])])
    with refused("'pressure'", 2, 1):
        average_runs([run([0, 1], [0, 1]), run([2, 3], [0, 1])])
    with refused("'pressure'", "loading(...)", "unloading(...)"):
        average_runs([run([0, 2, 0], [0, 1, 0]), run([0, 1], [0, 1])])


def test_equal_readings_of_the_drive_are_averaged() -> None:
    result = interpolated(run([0, 1, 1, 2], [0, 1, 3, 4]), "pressure", "angle", np.array([0.5, 1.0, 3.0]))
    np.testing.assert_allclose(result[:2], [1.0, 2.0])
    assert np.isnan(result[2])


def test_ranges_of_columns_leave_rows_out() -> None:
    test = run([0e3, 5e3, 10e3, 20e3, 30e3], np.deg2rad([0, 10, 20, 40, 60]))
    np.testing.assert_allclose(within_ranges(test, ["pressure=5000 Pa..20 kPa"])["pressure"], [5e3, 10e3, 20e3])
    both = within_ranges(test, ["pressure=5..30 kPa", "angle = 15..45 deg"])
    np.testing.assert_allclose(both["pressure_kPa"], [10, 20])


@pytest.mark.parametrize(
    ("text", "facts"),
    [
        ("pressure", ("NAME=FROM..TO", "'pressure'")),
        ("presure=0..30 kPa", ("'presure'", "pressure")),
        ("pressure=0..30 mm", ("'pressure'", "'mm'", "kPa")),
        ("pressure=0..x kPa", ("'pressure'", "'x kPa'")),
        ("pressure=40..60 kPa", ("'pressure=40..60 kPa'", "0 of 2", "0 to 10 kPa")),
    ],
)
def test_ranges_that_cannot_be(text: str, facts: tuple[str, ...]) -> None:
    with refused(*facts):
        within_ranges(run([0, 10e3], [0, 1]), [text])
