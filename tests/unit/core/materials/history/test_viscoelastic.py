"""The algorithm of a viscoelastic point: against integrals, against differences of its energy, and in its limits."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from refused import refused
from turgor.core.materials.history.isochoric import isochoric_stress, isochoric_tangent, scaled_stress
from turgor.core.materials.history.viscoelastic import (
    Prony,
    hereditary,
    memory_at_rest,
    next_memory,
    remembered_stress,
    step_factor,
)
from turgor.core.materials.laws.laws import Hooke, NeoHooke
from turgor.core.materials.material import Material

SERIES = Prony(g=(0.25, 0.15, 0.1), tau=(0.3, 2.0, 40.0), moduli="instantaneous")
TWICE = np.array([1, 1, 1, 2, 2, 2])


def follow(series, times, stresses):
    """Stress at the times, step by step."""
    memory = memory_at_rest(series, stresses.shape[1:-1])
    results = []
    for step, stress in zip(np.diff(times, prepend=times[0]), stresses, strict=True):
        results.append(step_factor(series, step) * stress + remembered_stress(series, step, memory))
        memory = next_memory(series, step, memory, stress)
    return np.array(results)


def some_tensors(seed, shape):
    """Positive definite C of any volume, and symmetric h, as six components."""
    random = np.random.default_rng(seed)
    F = np.eye(3) + 0.3 * random.normal(size=(*shape, 3, 3))
    C = F.swapaxes(-1, -2) @ F + 0.2 * np.eye(3)
    return C[..., [0, 1, 2, 0, 1, 0], [0, 1, 2, 1, 2, 2]], random.normal(size=(*shape, 6))


def energy(h, C):
    """½ h : C̄."""
    full = C[..., [[0, 3, 5], [3, 1, 4], [5, 4, 2]]]
    return 0.5 * np.linalg.det(full) ** (-1 / 3) * ((h * C) @ TWICE)


def test_a_linear_ramp_is_exact_whatever_the_steps():
    """S₀ = t a: the hereditary integral is (1 − Σ g) t + Σ g τ (1 − exp(−t/τ))."""
    times = np.array([0.0, 0.01, 0.5, 0.6, 7.0, 100.0])
    a = np.array([1.0, -0.5, -0.5, 0.2, 0.0, 0.3])
    g, tau = np.array(SERIES.g), np.array(SERIES.tau)
    exact = SERIES.relaxed * times + (g * tau * -np.expm1(-times[:, None] / tau)).sum(axis=1)
    assert follow(SERIES, times, times[:, None] * a) == pytest.approx(exact[:, None] * a, rel=1e-12)


def test_a_jump_relaxes_as_the_modulus_says():
    times = np.array([0.0, 0.1, 1.0, 30.0, 1e6])
    result = follow(SERIES, times, np.ones((5, 6)))
    assert result == pytest.approx(SERIES.modulus(times)[:, None] * np.ones(6), rel=1e-12)
    assert SERIES.modulus(1e9) == pytest.approx(0.5)


def test_steps_of_no_length_and_of_infinite_length():
    _, stress = some_tensors(0, (4,))
    memory = next_memory(SERIES, 0.7, memory_at_rest(SERIES, (4,)), stress)
    assert step_factor(SERIES, 0.0) == 1.0
    later = remembered_stress(SERIES, 0.0, memory) + stress
    before = step_factor(SERIES, 0.7) * stress
    assert later == pytest.approx(before, rel=1e-12), "nothing happens in no time"
    assert step_factor(SERIES, np.inf) == pytest.approx(SERIES.relaxed)
    assert np.abs(remembered_stress(SERIES, np.inf, memory)).max() == 0
    assert (next_memory(SERIES, np.inf, memory, stress)[1:] == 0).all()


def test_long_term_constants_are_those_of_the_end():
    slow = Prony(g=SERIES.g, tau=SERIES.tau, moduli="long_term")
    assert slow.modulus([0.0, np.inf]) == pytest.approx([2.0, 1.0])
    times, stresses = np.linspace(0, 3, 7), np.random.default_rng(1).normal(size=(7, 2, 6))
    assert follow(slow, times, stresses) == pytest.approx(2 * follow(SERIES, times, stresses), rel=1e-12)


def test_many_points_are_each_their_own():
    times, stresses = np.linspace(0, 3, 7), np.random.default_rng(1).normal(size=(7, 3, 2, 6))
    together = follow(SERIES, times, stresses)
    assert together[:, 1, 1] == pytest.approx(follow(SERIES, times, stresses[:, 1, 1]), rel=1e-13)


def test_the_recursion_along_a_history_is_the_same():
    times, stresses = np.array([1.0, 1.0, 1.5, 3.0, 20.0]), np.random.default_rng(2).normal(size=(5, 6))
    parts = [g * hereditary(times, stresses, tau) for g, tau in zip(SERIES.g, SERIES.tau, strict=True)]
    assert SERIES.relaxed * stresses + sum(parts) == pytest.approx(follow(SERIES, times, stresses), rel=1e-12)


def test_stress_and_tangent_are_the_derivatives_of_the_energy():
    C, h = some_tensors(3, (5,))
    S, D = isochoric_stress(h, C), isochoric_tangent(h, C)
    step, slopes, turns = 1e-5, np.empty((5, 6)), np.empty((5, 6, 6))
    for v in range(6):
        dC = step * np.eye(6)[v]
        slopes[:, v] = (energy(h, C + dC) - energy(h, C - dC)) / step / TWICE[v]
        turns[:, :, v] = (isochoric_stress(h, C + dC) - isochoric_stress(h, C - dC)) / step / TWICE[v]
    assert pytest.approx(slopes, abs=1e-8) == S
    assert pytest.approx(np.zeros(5), abs=1e-12) == (S * C) @ TWICE, "no part of it is mean stress"
    lower = np.tril_indices(6)
    assert pytest.approx(turns[:, *lower], abs=1e-7) == D
    assert turns == pytest.approx(turns.swapaxes(1, 2), abs=1e-7)


def test_a_neo_hookean_stress_is_that_of_the_identity():
    """2 C10 1 : C̄ / 2 is the neo-Hookean energy, so its stress must come out, and scaling must undo J."""
    C, _ = some_tensors(4, (5,))
    S = isochoric_stress(2e5 * np.array([1.0, 1, 1, 0, 0, 0]), C)
    again = isochoric_stress(scaled_stress(S, C), C)
    assert again == pytest.approx(S, rel=1e-12)


@settings(max_examples=50, deadline=None)
@given(st.lists(st.tuples(st.floats(0.01, 10), st.floats(-1, 1)), min_size=1, max_size=20))
def test_a_linear_history_never_gives_back_more_than_it_took(path):
    """For S₀ in proportion to a strain, the work from rest to any state is not negative."""
    steps, strain = np.array([s for s, _ in path]), np.array([0.0, *(e for _, e in path)])
    times = np.concatenate([[0.0], np.cumsum(steps)])
    fine = np.unique(np.concatenate([np.linspace(a, b, 50) for a, b in pairwise(times)]))
    e = np.interp(fine, times, strain)
    stress = follow(SERIES, fine, e[:, None] * np.ones(6))[:, 0]
    work = np.cumsum(0.5 * (stress[1:] + stress[:-1]) * np.diff(e))
    assert work.min() >= -1e-9


@pytest.mark.parametrize(
    ("wrong", "facts"),
    [
        ({"g": (0.6, 0.4)}, ("sum of g", 1, "below 1")),
        ({"g": (0.6, -0.1)}, ("g is (0.6, -0.1)", "more than 0")),
        ({"tau": (1.0, 0.0)}, ("tau is (1.0, 0.0)", "more than 0")),
        ({"g": (0.2,)}, ("g", "1 terms", "tau 2", "least one")),
        ({"g": 0.2}, ("g is 0.2", "sequence")),
        ({"moduli": "long term"}, ("moduli 'long term'", "'long_term'")),
    ],
)
def test_mistakes_are_named(wrong, facts):
    with refused(*facts):
        Prony(**{"g": (0.2, 0.1), "tau": (1.0, 10.0), "moduli": "long_term"} | wrong)


def test_a_step_back_in_time_is_refused():
    with refused("-1 s", "0 s or more"):
        step_factor(SERIES, -1.0)


def test_only_rubbers_relax():
    assert Material(name="a", law=NeoHooke(C10=1e5), viscoelasticity=SERIES).viscoelasticity is SERIES
    with refused("paper", "viscoelasticity", "stress_softening"):
        Material(name="paper", law=Hooke(E=1e9, nu=0.3), viscoelasticity=SERIES)
