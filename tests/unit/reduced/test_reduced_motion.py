"""A reduced model follows histories of its inputs: at rest in every state, and in motion as `Dynamic` does."""

from dataclasses import replace

import numpy as np
import pytest
from reduced_cases import KEY, finger, moving, reduced, system

import turgor as tg
from refused import refused
from turgor.core.engine.damping import StrainRateDamping
from turgor.core.engine.mass import mass_data
from turgor.core.engine.runtime import EngineOptions
from turgor.core.solvers.dynamics.generalized_alpha import Motion, TimeStep, Weights
from turgor.core.solvers.energies import imbalance
from turgor.reduced.parts.inertia import Inertia
from turgor.reduced.states.following import Moving

RANDOM = np.random.default_rng(4)
PRESSURE, RISE, END, STEP, DAMPING = 6e3, 0.02, 0.08, 0.004, 0.005


def part(tau: float) -> Inertia:
    """Inertia in a step from somewhere."""
    r = moving().modes.shape[1]
    before = Motion(0.1 * RANDOM.standard_normal(r), *(RANDOM.standard_normal(r) for _ in range(3)))
    return Inertia(moving().masses, TimeStep(Weights.of(0.8), before, STEP, np.ones(r)), 3.0, tau)


def test_equilibria_along_a_history_are_those_of_single_answers():
    times, pressures = [0.0, 1.0, 3.0, 4.0], [0.0, 9e3, 4e3, 11e3]
    followed = reduced().follow(times, {"pressure": pressures})
    for answer, pressure in zip(followed.answers, pressures, strict=True):
        assert answer.inputs == pytest.approx([pressure])
        assert answer.q == pytest.approx(reduced().solve(pressure).q, abs=1e-4 * reduced().size)
    assert followed.tip.shape == (4, 3)


def test_mass_and_damping_are_the_projected_full_ones():
    made, r = moving(), moving().modes.shape[1]
    modes = made.modes.astype(float)
    inertia = part(0.02)
    q = made.trained[5, :r] + 0.02 * RANDOM.standard_normal(r)
    velocity = inertia.rule.velocity(q)
    rest = np.zeros(system().element.mean_count)
    unknowns, rate = np.concatenate([modes @ q, rest]), np.concatenate([modes @ velocity, rest])
    full = StrainRateDamping(system(), 0.02, 0.0, rate).forces(unknowns)[: len(modes)]
    by_mass = system().layout.base.product(mass_data(system()), rate)[: len(modes)]
    expected = modes.T @ (full + 3.0 * by_mass)
    assert inertia.at(q).damping == pytest.approx(expected, abs=1e-6 * np.abs(expected).max())


def test_tangent_of_inertia_is_its_derivative():
    inertia = part(0.02)
    q, step = moving().trained[4, : len(inertia.masses.mass)], 1e-6
    way = RANDOM.standard_normal(len(q))
    ends = [inertia.at(q + sign * step * way).forces() for sign in (1, -1)]
    difference = (ends[0] - ends[1]) / (2 * step)
    assert inertia.at(q).tangent(None) @ way == pytest.approx(difference, abs=1e-6 * np.abs(difference).max())


def test_step_of_pressure_moves_the_tip_as_dynamic_does():
    model = finger()
    history = ((0.0, 0.0), (RISE / END, 1.0), (1.0, 1.0))
    loads = [replace(load, pressure=PRESSURE, history=history) for load in model.loads]
    procedure = tg.Dynamic(
        duration=END, stiffness_damping=DAMPING, first_step=STEP, max_step=STEP, adaptive=False
    )  # fmt: skip
    full = tg.solve(replace(model, loads=loads), procedure, options=EngineOptions(threads=1)).states
    times = np.array([state.time for state in full])
    pressures = np.interp(times, [0.0, RISE, END], [0.0, PRESSURE, PRESSURE])
    followed = moving().follow(times, {"pressure": pressures}, Moving(step=STEP, stiffness_damping=DAMPING))
    tips = np.array([tg.tip_displacement(state) for state in full])
    errors = np.abs(np.linalg.norm(followed.tip, axis=1) - tips)
    assert tips.max() > 1.1 * np.linalg.norm(moving().solve(PRESSURE).tip)  # it swings
    assert errors.max() < 0.02 * tips.max()
    for name in ("strain", "dissipated", "work"):
        value, expected = getattr(followed.energies[-1], name), getattr(full[-1].energies, name)
        assert value == pytest.approx(expected, rel=0.01)


def test_energy_is_balanced_in_short_steps():
    times, pressures = [0.0, RISE, 0.04], [0.0, PRESSURE, PRESSURE]
    given = Moving(step=0.0005, stiffness_damping=DAMPING, spectral_radius=1.0)
    followed = moving().follow(times, {"pressure": pressures}, given)

    class Of:
        def __init__(self, energies: object) -> None:
            self.energies = energies

    assert imbalance([Of(each) for each in followed.energies]) < 2e-3


def test_histories_that_are_none_are_refused():
    with refused("motion"):
        reduced().follow([0.0, 1.0], {"pressure": [0.0, 1e3]}, Moving())
    with refused(KEY, "13 kPa"):
        reduced().follow([0.0, 1.0], {"pressure": [0.0, 13e3]})
    with refused("2 times", "3 values"):
        reduced().follow([0.0, 1.0], {"pressure": [0.0, 1e3, 2e3]})
    with refused("later"):
        reduced().follow([0.0, 0.0], {"pressure": [0.0, 1e3]})
    with refused("step", "0 s"):
        Moving(step=0.0)
