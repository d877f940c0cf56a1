"""The inverse of a surrogate gives back the inputs of exact outputs; a surrogate of many rows predicts fresh ones.

Problem: the tip of an arc that two pressures bend in two planes; a finger that bends with pressure over stiffness and
wall; both in closed form.
Exact: the pressures that the tip was computed with; the formula of the finger.
Tolerance: 0.2 % of the range, where the held-out error of the surrogate is below 0.1 %; 0.1 % of the range for many
rows.
"""

import numpy as np
import pytest
from scipy.stats import qmc

import surrogate_cases as cases
from turgor.foundation.response import Column
from turgor.studies.surrogates.fit import surrogate
from turgor.studies.surrogates.fit_gaussian_process import GaussianProcessTrainer
from turgor.studies.surrogates.held_out import held_out
from turgor.studies.surrogates.invert import invert
from turgor.units import kPa


def test_pressures_of_a_shape(record_verification):
    fitted = surrogate(cases.study_of(cases.two_chambers, [cases.FIRST, cases.SECOND], 32))
    assert max(each.share for each in fitted.held_out) < 1e-3
    worst = spread = 0.0
    for first, second in 40 * kPa * (0.02 + 0.96 * qmc.Sobol(2, seed=7).random(16)):
        tip = cases.two_chambers(first, second)
        result = invert(fitted, {name: float(tip[name][0]) for name in ("tip_y", "tip_z")})
        assert result.reached
        assert result.others == ()
        off = np.array([result.values["first"] - first, result.values["second"] - second])
        worst = max(worst, float(np.abs(off).max()))
        spread = max(spread, *result.deviations.values())
    record_verification(
        claim="inverse of a surrogate, 16 shapes of two pressures: largest error of a pressure [kPa]",
        source="the pressures that the shapes were computed with",
        expected=0.0,
        got=round(worst / kPa, 4),
        tolerance="0.08 kPa, 0.2 % of the range",
    )
    assert worst < 0.08 * kPa
    assert worst < 4 * spread  # the deviation that it tells is of the size of the error


def test_a_surrogate_of_many_rows(record_verification):
    def bent(at):
        pressure, stiffness, wall = at[:, 0], 0.5 + at[:, 1], 1 + at[:, 2]
        return np.arctan(2 * pressure / (stiffness * wall**1.2))

    points, fresh = qmc.Sobol(3, seed=0).random(1024), qmc.Sobol(3, seed=5).random(512)
    y, none = bent(points), np.zeros((1024, 1))
    trainer = GaussianProcessTrainer(parts=3)
    model = trainer.fit(points, y[:, None], none)
    (error,) = held_out(trainer, model, points, [Column("angle", "", y)], none, np.arange(1024))
    mean, deviation = model.spread(fresh)
    off = np.abs(mean[:, 0] - bent(fresh))
    share = float(np.sqrt(np.mean(off**2))) / float(np.ptp(y))
    covered = float(np.mean(off < 1.96 * error.factor * deviation[:, 0]))
    record_verification(
        claim="surrogate of 1024 rows of a finger: RMS error of 512 fresh rows over the range; share within 95 %",
        source="the formula",
        expected=[0, 0.95],
        got=[float(f"{share:.2g}"), round(covered, 3)],
        tolerance="0.001; 0.04",
    )
    assert share < 0.001
    assert error.share < 0.001
    assert covered == pytest.approx(0.95, abs=0.04)
    step = 1e-3  # round-off of the mean, 1e-9, over a smaller step would be seen
    slope = [
        (model.mean(fresh[:1] + step * e) - model.mean(fresh[:1] - step * e))[0, 0] / (2 * step) for e in np.eye(3)
    ]
    assert model.slope(fresh[0])[0] == pytest.approx(slope, rel=1e-4)
