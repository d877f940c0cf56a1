"""Percentiles by weight are those of all values in order, although few are sorted."""

import numpy as np
import pytest

from turgor.core.engine.percentiles import ONE_OF, weighted_percentile


def of_all(values: np.ndarray, weights: np.ndarray, percent: float) -> float:
    """The first value at which the sum of the weights reaches the share."""
    reached = 0.0
    for k in np.argsort(values, kind="stable"):
        reached += weights[k]
        if reached >= percent / 100 * weights.sum() * (1 - 1e-12):
            return float(values[k])
    raise AssertionError


@pytest.mark.parametrize("count", [1, 2, ONE_OF, 300])
@pytest.mark.parametrize("percent", [1.0, 50.0, 93.0, 95.0, 99.0, 99.9, 100.0])
def test_it_is_that_of_all_values_in_order(count: int, percent: float) -> None:
    random = np.random.default_rng(count)
    values, weights = random.normal(size=count), random.uniform(0.1, 5.0, size=count)
    assert weighted_percentile(values, weights, percent) == of_all(values, weights, percent)


def test_a_few_heavy_values_at_the_top_hold_more_than_the_share() -> None:
    values, weights = np.arange(160.0), np.ones(160)
    weights[-1] = 1e6
    assert weighted_percentile(values, weights) == 159.0


def test_light_values_at_the_top_leave_the_percentile_among_the_others() -> None:
    values, weights = np.arange(160.0), np.ones(160)
    weights[-40:] = 1e-9
    assert weighted_percentile(values, weights) == of_all(values, weights, 99.0) == 118.0
