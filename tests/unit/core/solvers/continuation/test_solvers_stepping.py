"""Step control: grows, cuts, hits targets exactly."""

from hypothesis import given
from hypothesis import strategies as st

from turgor.core.solvers.continuation.path_points import lagrange_weights
from turgor.core.solvers.continuation.step_control import StepControl
from turgor.core.solvers.procedures.static import Static


def test_easy_steps_grow_and_hard_steps_shrink():
    control = StepControl.of(Static(first_step=0.1, max_step=0.5))
    assert control.accepted(0.1, 3).length > 0.1
    assert control.accepted(0.1, 12).length < 0.1
    assert control.accepted(0.4, 1).length == 0.5  # never beyond max_step


def test_failed_steps_are_cut_until_the_smallest():
    control = StepControl.of(Static(first_step=0.1, min_step=0.03))
    shorter = control.failed(0.1)
    assert shorter is not None
    assert shorter.length < 0.1
    assert shorter.accepted(shorter.length, 2).length == shorter.length  # no growth right after a failure
    assert shorter.failed(0.04) is None


def test_a_step_shortened_by_a_target_does_not_shrink_the_next():
    control = StepControl.of(Static(first_step=0.2, max_step=0.2, at=(0.05,)))
    assert control.next_load(0.0) == 0.05
    assert control.accepted(0.05, 4).length == 0.2


@given(
    targets=st.lists(st.floats(min_value=0.01, max_value=1.0), max_size=6),
    first=st.floats(min_value=0.02, max_value=1.0),
)
def test_every_target_is_hit_exactly(targets, first):
    control = StepControl.of(Static(first_step=first, max_step=first, at=tuple(targets)))
    load, seen = 0.0, []
    while load < 1.0:
        load = control.next_load(load)
        seen.append(load)
    assert set(targets) <= set(seen)
    assert seen == sorted(set(seen))


def test_extrapolation_is_exact_for_cubics():
    factors = [0.1, 0.25, 0.3, 0.6]
    weights = lagrange_weights(factors, 0.9)
    value = sum(w * (2 * t**3 - t + 1) for w, t in zip(weights, factors, strict=True))
    assert abs(value - (2 * 0.9**3 - 0.9 + 1)) < 1e-12
