"""Sequences that follow f + C h^p give back f and p; those that do not are not extrapolated."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from refused import refused
from turgor.core.results.convergence.extrapolation import extrapolate
from turgor.core.results.convergence.settings import EXTRAPOLATION

UNEVEN = np.array([4.0, 2.9, 2.2])


@pytest.mark.parametrize("sizes", [[4.0, 2.0, 1.0], UNEVEN, [1e-3, 0.9e-3, 0.5e-3], [9.0, 4.0, 2.0, 1.0]])
@pytest.mark.parametrize("order", [1.0, 2.0, 3.0, 3.9])
@pytest.mark.parametrize("factor", [0.3, -0.3])
def test_manufactured_sequences_give_their_limit_and_order(sizes, order: float, factor: float) -> None:
    h = np.array(sizes) / max(sizes)
    result = extrapolate(h, 10 + factor * h**order)
    assert result.trust == "converging"
    assert result.reliable
    assert result.order == pytest.approx(order, rel=1e-6)
    assert result.value == pytest.approx(10, rel=1e-8)
    assert result.error == pytest.approx(EXTRAPOLATION.safety * abs(factor) * h[-1] ** order, rel=1e-5)


@given(
    st.floats(EXTRAPOLATION.least_order + 0.01, EXTRAPOLATION.most_order),
    st.floats(1.1, 3),
    st.floats(1.1, 3),
    st.floats(-5, 5),
)
def test_any_order_and_any_ratios(order: float, first: float, second: float, limit: float) -> None:
    h = np.array([1.0, 1 / first, 1 / first / second])
    result = extrapolate(h, limit + h**order)
    assert result.order == pytest.approx(order, rel=1e-4)
    assert result.value == pytest.approx(limit, abs=1e-4)


def test_only_the_last_three_values_count() -> None:
    h = np.array([8.0, 4.0, 2.0, 1.0])
    assert extrapolate(h, [-77.0, *(10 + h[1:] ** 2)]) == extrapolate(h[1:], 10 + h[1:] ** 2)


def test_values_that_go_up_and_down_are_not_extrapolated() -> None:
    result = extrapolate(UNEVEN, [1.0, 3.0, 2.0])
    assert (result.value, result.error, result.order, result.trust) == (2.0, 2.0, None, "not monotone")
    assert not result.reliable


def test_differences_that_grow_have_no_limit() -> None:
    result = extrapolate([4, 2, 1], [1.0, 2.0, 4.0])
    assert (result.value, result.error, result.order, result.trust) == (4.0, 3.0, None, "diverging")
    assert extrapolate([4, 2, 1], [1.0, 1.0, 2.0]).trust == "diverging"


def test_an_order_near_zero_is_no_order() -> None:
    h = np.array([4.0, 2.0, 1.0])
    result = extrapolate(h, 10 + h**0.3)
    assert result.trust == "slow"
    assert result.order == pytest.approx(0.3)
    assert result.value == 11
    assert result.error == pytest.approx(4**0.3 - 1)


def test_a_sequence_that_is_too_fast_is_not_believed() -> None:
    h = np.array([4.0, 2.0, 1.0])
    result = extrapolate(h, 10 + h**8)
    assert result.trust == "fast"
    assert result.order == pytest.approx(8)
    assert result.error >= EXTRAPOLATION.safety * abs(result.value - 11)
    lucky = extrapolate(h, [1.0, 2.0, 2.0])  # the last two agree by chance: the error is not zero
    assert lucky.order is None
    assert lucky.value == 2
    assert lucky.error == pytest.approx(EXTRAPOLATION.safety * 1 / (4**4 - 2**4))


def test_equal_values_have_no_order_and_no_error() -> None:
    result = extrapolate(UNEVEN, [5.0, 5.0, 5.0])
    assert (result.value, result.error, result.order, result.trust) == (5.0, 0.0, None, "equal")
    assert extrapolate(UNEVEN, [0.0, 0.0, 0.0]).trust == "equal"
    assert extrapolate(UNEVEN, [5.0, 5.0 + 1e-8, 5.0 - 1e-8]).trust == "equal"  # rounding of a solver, not a trend


@pytest.mark.parametrize(
    ("sizes", "values", "facts"),
    [
        ([2, 1], [1, 2], ("2 meshes", "2 values")),
        ([3, 2, 1], [1, 2], ("3 meshes", "2 values")),
        ([1, 2, 3], [1, 2, 3], ("sizes are [1.0, 2.0, 3.0]", "positive")),
        ([2, 1, 0], [1, 2, 3], ("sizes are [2.0, 1.0, 0.0]", "positive")),
        ([3, 2, 1], [1, 2, np.nan], ("values [1.0, 2.0, nan]", "finite")),
    ],
)
def test_what_cannot_be_compared_is_refused(sizes, values, facts: tuple) -> None:
    with refused(*facts):
        extrapolate(sizes, values)
