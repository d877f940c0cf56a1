"""Chains of rigid links: virtual work, equilibria, and how close they are to a reduced model."""

from dataclasses import replace

import numpy as np
import pytest
from reduced_cases import PRESSURE, reduced
from robot_chains import X, fitted, spatial

import turgor as tg
from refused import refused
from turgor.core.engine.mass import total_mass
from turgor.systems.robots.chains.chain import TipForce


def slope(function, x, step=1e-6):
    return np.array([(function(x + h) - function(x - h)) / (2 * step) for h in step * np.eye(len(x))])


def test_pressures_do_the_work_of_their_volumes():
    chain = spatial()
    assert chain.pressed(X) == pytest.approx(slope(chain.volumes, X).T, rel=1e-6)


def test_forces_moments_and_weight_do_the_work_of_their_motion():
    chain, force = spatial(), np.array([0.1, -0.2, 0.3])
    at = chain.placed(X)
    assert chain.work(at, 2, chain.tip(at), force) == pytest.approx(
        slope(lambda x: force @ chain.tip(chain.placed(x)), X), rel=1e-6
    )
    turned = slope(lambda x: chain.placed(x).turns[2], X)
    spins = np.array([[m[2, 1], m[0, 2], m[1, 0]] for m in turned @ at.turns[2].T])
    assert chain.work(at, 2, chain.tip(at), np.zeros(3), force) == pytest.approx(spins @ force, rel=1e-5, abs=1e-9)

    def potential(x):
        placed = chain.placed(x)
        centers = placed.origins + np.einsum("nab,nb->na", placed.turns, chain.centers)
        return float(chain.masses @ centers @ chain.gravity)

    assert chain.weight(at) == pytest.approx(slope(potential, X), rel=1e-5, abs=1e-9)


def test_forces_balance_at_an_equilibrium_and_its_tangent_is_their_slope():
    chain, pressures, force = spatial(), np.array([2e4, 1e4]), np.array([0.0, 0.02, 0.01])

    def needed(x):
        at = chain.placed(x)
        outer = chain.weight(at) + chain.work(at, 2, chain.tip(at), force)
        return chain.spring_forces(x)[0] - pressures @ chain.pressed(x) - outer

    x = chain.equilibrium(pressures, outside=TipForce(force))
    assert np.abs(needed(x)).max() < 1e-9
    assert chain.tangent(x, pressures, TipForce(force)) == pytest.approx(slope(needed, x), rel=1e-4, abs=1e-4)


def test_a_chain_without_stable_equilibrium_is_refused():
    soft = replace(spatial(gravity=(0, 0, 0)), growth=np.array([1e12, 1e12]))
    with refused("cavity_1.pressure", "20 kPa"):
        soft.equilibrium(np.array([2e4, 1e4]))


def test_a_finger_as_a_chain_reaches_its_tip_and_has_its_stiffness():
    made = fitted()
    assert made.error < 0.006
    assert made.error < 0.04 * made.travel
    assert made.stiffness_error < 0.2
    assert f"{100 * made.error:.2g} %" in made.text
    middles = made.tested[:, 0] / PRESSURE
    assert (middles[0], middles[-1], len(middles)) == pytest.approx((0.025, 0.975, 20)), "none of these was fitted"
    tip = made.chain.tip(made.chain.placed(made.chain.equilibrium(made.tested[7])))
    assert np.linalg.norm(tip - made.wanted[7]) <= made.error * made.length
    moved = made.wanted[7] - made.chain.tip(made.chain.placed(np.zeros(len(made.chain.springs))))
    assert moved == pytest.approx(reduced().solve(float(made.tested[7, 0])).tip, abs=1e-6)


def test_a_chain_weighs_what_moves_of_the_actuator():
    made, model = fitted(), reduced().model
    share = 1 - 0.5 / made.chain.links  # half a link stays at the base
    assert made.chain.masses.sum() == pytest.approx(share * total_mass(model), rel=0.1)


def test_inputs_that_are_no_pressures_alone_are_refused():
    forces = replace(
        reduced(), equations=replace(reduced().equations, pressures=np.zeros_like(reduced().equations.pressures))
    )
    with refused("loads.pressure"):
        tg.robots.chain_of(forces)
