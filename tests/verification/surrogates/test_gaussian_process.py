"""Gaussian processes: the rate of their error, the scatter that they find, and the coverage of their intervals.

Problem: a smooth function of one and of two inputs; the second with normal noise of 5 % of its standard deviation.
Exact: with a Gaussian kernel the error of a function that is analytic falls faster than any power of the number of
points (Rasmussen and Williams 2006, sec. 7; Wendland 2005, ch. 11); with kernels whose numbers are given the mean is
(K + noise)⁻¹ of the textbook, as scikit-learn has it. Of normal noise, 68.27 and 95 % lie in the intervals.
Tolerance: twice as many points must reduce the error a hundredfold. 100 rows know a standard deviation to 7 %; three
times that. The share of 2000 fresh values in an interval is known to 1 %, the interval of 100 rows itself to 7 % of its
width, which is 5 % in share at 68 and 1.5 % at 95 %.
"""

import numpy as np
import pytest
from scipy.stats import qmc
from sklearn.gaussian_process import GaussianProcessRegressor
from sklearn.gaussian_process.kernels import RBF, ConstantKernel, Matern

from turgor.foundation.response import Column
from turgor.studies.surrogates.fit_gaussian_process import GaussianProcessTrainer
from turgor.studies.surrogates.gaussian_process import conditioned
from turgor.studies.surrogates.held_out import held_out


def wave(at):
    """An analytic function of one input."""
    return np.sin(6 * at) + 0.5 * np.cos(11 * at)


def hill(at):
    """An analytic function of two inputs."""
    return np.sin(3 * at[:, 0]) * np.exp(-at[:, 1]) + 0.3 * at[:, 0] * at[:, 1]


def test_the_error_falls_faster_than_any_power(record_verification):
    at = np.linspace(0, 1, 301)[:, None]
    errors = []
    for count in (6, 12, 24):
        points = np.linspace(0, 1, count)[:, None]
        model = GaussianProcessTrainer().fit(points, wave(points), np.zeros((count, 1)))
        errors.append(float(np.abs(model.mean(at) - wave(at)).max()))
    record_verification(
        claim="Gaussian process of a smooth function through 6, 12 and 24 points: largest error",
        source="falls a hundredfold and more for twice the points",
        expected="< 1/100 of the one before",
        got=np.array(errors),
        tolerance="1/100",
    )
    assert errors[0] > 0.01
    assert errors[1] < errors[0] / 100
    assert errors[2] < errors[1] / 10  # round-off of the scatter that every fit keeps ends the fall


@pytest.mark.parametrize("smooth", [True, False])
def test_mean_and_deviation_are_those_of_the_textbook(smooth):
    points, at = qmc.Sobol(2, seed=0).random(32), qmc.Sobol(2, seed=1).random(16)
    noise = np.full((32, 1), 0.02)
    lengths = np.array([0.4, 0.9])
    y = hill(points)
    model = conditioned(
        points, y[:, None], noise, amplitude=np.array([1.3]), lengths=lengths[None], smooth=np.array([smooth]),
        scatter=np.array([0.05]),
    )  # fmt: skip
    shape = RBF(lengths) if smooth else Matern(lengths, nu=2.5)
    variance = (0.02 / y.std()) ** 2 + 0.05**2
    other = GaussianProcessRegressor(ConstantKernel(1.3**2) * shape, alpha=variance, optimizer=None)
    mean, deviation = other.fit(points, (y - y.mean()) / y.std()).predict(at, return_std=True)
    result = model.spread(at)
    assert result[0][:, 0] == pytest.approx(y.mean() + y.std() * mean, abs=1e-9)
    assert result[1][:, 0] == pytest.approx(y.std() * np.hypot(deviation, 0.05), rel=1e-6)
    assert np.sqrt(np.diag(model.covariance(at)[0])) == pytest.approx(y.std() * deviation, rel=1e-6)
    step = 1e-6
    slope = [(model.mean(at[:1] + step * e) - model.mean(at[:1] - step * e))[0, 0] / (2 * step) for e in np.eye(2)]
    assert model.slope(at[0])[0] == pytest.approx(slope, rel=1e-6)


def test_intervals_hold_what_they_say(record_verification):
    draw = np.random.default_rng(3)
    points, fresh = qmc.Sobol(2, seed=0).random(128)[:100], draw.random((2000, 2))
    sigma = 0.05 * float(hill(fresh).std())
    y = hill(points) + sigma * draw.standard_normal(100)
    trainer, none = GaussianProcessTrainer(), np.zeros((100, 1))
    model = trainer.fit(points, y[:, None], none)
    (error,) = held_out(trainer, model, points, [Column("y", "", y)], none, np.arange(100))
    mean, deviation = model.spread(fresh)
    off = np.abs(hill(fresh) + sigma * draw.standard_normal(2000) - mean[:, 0]) / (deviation[:, 0] * error.factor)
    covered = float(np.mean(off < 1)), float(np.mean(off < 1.96))
    record_verification(
        claim="Gaussian process of 100 noisy rows: scatter over that of the noise; share of 2000 fresh values in the "
        "intervals of 68 and 95 %",
        source="the noise that was added",
        expected=[1, 0.6827, 0.95],
        got=np.round([float(model.scatter[0] * model.scale[0]) / sigma, *covered], 3),
        tolerance="20 %, 8 and 3 % of the rows",
    )
    assert float(model.scatter[0] * model.scale[0]) == pytest.approx(sigma, rel=0.2)
    assert error.rms == pytest.approx(sigma, rel=0.25)
    assert covered[0] == pytest.approx(0.6827, abs=0.08)
    assert covered[1] == pytest.approx(0.95, abs=0.03)
    assert error.coverage == pytest.approx(covered, abs=0.12)


def test_intervals_that_are_too_narrow_are_widened():
    """A trainer that believes in a hundredth of the scatter gets intervals that hold what they should."""
    draw = np.random.default_rng(4)
    points = qmc.Sobol(2, seed=0).random(128)[:100]
    y = hill(points) + 0.05 * draw.standard_normal(100)
    trainer, none = _Sure(), np.zeros((100, 1))
    (error,) = held_out(
        trainer, trainer.fit(points, y[:, None], none), points, [Column("y", "", y)], none, np.arange(100)
    )
    assert error.factor > 2
    assert error.coverage[1] == pytest.approx(0.95, abs=0.06)


class _Sure(GaussianProcessTrainer):
    """A trainer that does not see scatter."""

    def fit(self, inputs, targets, noise):
        return conditioned(
            inputs, targets, noise, amplitude=np.ones(1), lengths=np.full((1, 2), 0.5), smooth=np.array([False]),
            scatter=np.array([1e-3]),
        )  # fmt: skip

    def from_there(self, fitted):
        return self
