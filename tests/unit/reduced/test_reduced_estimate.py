"""The estimated error of an answer is the true one within a factor of three, whatever makes it."""

from dataclasses import replace

import numpy as np
import pytest
from reduced_cases import KEY, PRESSURE, other_path, reduced, reduced_of

from refused import refused
from turgor.reduced.settings import ESTIMATE
from turgor.reduced.states.estimate import KnownErrors
from turgor.reduced.training.compare import errors_of, known_errors


@pytest.mark.parametrize("modes", [2, 6])
def test_estimate_is_the_true_error_within_a_factor_of_three(modes):
    """With two modes the truncation counts, which other sampled points do not see."""
    model, path = reduced_of(modes), other_path()
    answers = [model.at(inputs[1:]) for inputs in path.inputs]
    true = np.array([errors_of(answer, u)[0] for answer, u in zip(answers, path.displacements, strict=True)])
    ratios = np.array([answer.estimate for answer in answers]) / true
    assert np.mean((ratios > 0.3) & (ratios < 3)) >= 0.95
    assert all(answer.doubtful for answer, error in zip(answers, true, strict=True) if error > 0.02)
    if modes == 2:
        assert true.max() > 0.02
        assert np.median([answer.indicator for answer in answers] / true) < 0.3


def test_answers_of_a_good_model_have_small_estimates():
    estimates = [reduced().solve(pressure).estimate for pressure in np.linspace(0, PRESSURE, 20)]
    assert max(estimates) < 0.002
    assert not reduced().solve(PRESSURE / 2).doubtful
    assert reduced().counts["training paths"] == 2  # a path to the worst input checks, with one input too


def test_estimate_is_known_where_the_error_is_and_grows_between():
    known = KnownErrors(places=np.array([[0.0, 0.0], [0.0, 1.0]]), errors=np.array([1e-3, 1e-3]), sizes=np.ones(2),
                        indicators=np.full(2, 1e-4))  # fmt: skip
    near, between = (known.at(np.array([0.0, x]), 1.0, 1e-4) for x in (0.0, 0.5))
    assert near == pytest.approx(1e-3, rel=0.05)
    assert between > near
    small, soft = known.at(np.array([0.0, 0.0]), 0.0, 1e-5), known.at(np.array([0.0, 0.0]), 1.0, 1e-3)
    assert small < 0.2 * near  # of a small answer
    assert soft > 4 * near  # where other points move the answer by more
    assert KnownErrors().at(np.array([0.0, 0.0]), 1.0, 1e-4) == 1e-4


def test_ends_that_the_full_model_did_not_reach_are_flagged():
    stopped = replace(other_path(), reached=False, inputs=other_path().inputs * np.array([0.5, 1.0]))
    known = known_errors(reduced(), [stopped])
    assert known.places[-1] == pytest.approx([0.0, 2 * 0.97])
    assert known.indicators[-1] == known.indicators[:-1].max()
    assert known.at(known.places[-1], 1.0, known.indicators[-1]) > 0.3
    usual = float(np.median(known.indicators))
    assert known.at(known.places[-1], 1.0, usual) * ESTIMATE.factor > ESTIMATE.doubt


def test_inputs_far_outside_are_refused():
    with refused(KEY, "480 kPa"):
        reduced().solve(40 * PRESSURE)
