"""The tangent of rods is the derivative of their residual, and the maps of frames are inverse to each other."""

from dataclasses import replace

import numpy as np
import pytest
from turgor.obstacles import Plane
from turgor.rods import ChamberPressure, LineLoad, Place, PlateForce, Rod, RodChamber, RodModel, RodSection

from turgor.fast_models.rod.frames import LARGEST_ANGLE, commutator, exponential, logarithm, tangent_map, wrench_matrix
from turgor.fast_models.rod.system import RodSystem

RNG = np.random.default_rng(3)


def test_logarithm_undoes_exponential():
    twists = RNG.normal(size=(50, 6))
    angles = np.concatenate([[0, 1e-9, 1e-5, 1e-3, 1.0001e-3], np.linspace(0.01, LARGEST_ANGLE - 0.01, 45)])
    twists[:, 3:] *= (angles / np.linalg.norm(twists[:, 3:], axis=1))[:, None]
    assert logarithm(*exponential(twists)) == pytest.approx(twists, abs=1e-12)


def test_tangent_map_is_the_derivative():
    twist, change = RNG.normal(size=6), 1e-6 * RNG.normal(size=6)
    (turn, place), (turn_2, place_2) = exponential(twist), exponential(twist + change)
    moved = logarithm(turn.T @ turn_2, turn.T @ (place_2 - place))
    assert moved == pytest.approx(tangent_map(twist) @ change, abs=1e-11)


def test_wrench_matrix_is_the_commutator_seen_from_the_wrench():
    twist, wrench = RNG.normal(size=(2, 6))
    assert commutator(twist).T @ wrench == pytest.approx(wrench_matrix(wrench) @ twist, abs=1e-14)


def _system():
    """Two rods with every kind of load, a bent joint, and a plane that some nodes press."""
    stiffness = np.diag([10.0, 5, 4, 1, 2, 1.5]) + 0.1
    section = RodSection(stiffness=stiffness, chambers=(RodChamber(area=0.2, offset=(0.1, 0.3)),))
    bent = Place(position=(0.1, 0.2, 0.3), turn=(0.2, 0.3, 0.4))
    rods = [
        Rod(name="a", section=section, length=1.0, elements=3, end="middle", end_at=bent),
        Rod(name="b", section=section, length=0.7, elements=2, start="middle", rest_strain=(0, 0, 0, 0.5, 1, 0)),
    ]
    loads = [
        PlateForce(force=(0.1, 0.1, 0.3), moment=(0.1, 0.2, 0.3), at=(0.1, 0.2, 0.3)),
        PlateForce(plate="middle", force=(0.2, 0.1, 0.3), moment=(0.1, 0, 0.3), at=(0.1, 0.2, 0.3), follows=True),
        LineLoad(force=(0.3, 0.2, 0.1)),
        LineLoad(force=(0.3, 0.2, 0.1), rod="b", follows=True),
        ChamberPressure(pressure=2.0),
    ]
    return RodSystem(RodModel(rods=rods, loads=loads, planes=[Plane(point=(0.6, 0, 0.0), normal=(1, 0, 2))]))


def _relaxed(system, state):
    """The state with the internal forces that its strains call for."""
    still = np.zeros((len(state.force), 6))
    for _ in range(20):
        state = replace(state, force=state.force + system.evaluate(state).elements.new_force(still, still))
    return state


def test_tangent_is_the_derivative_of_the_residual():
    system = _system()
    state = system.start()
    shape = (len(state.turn), 6)
    state = state.moved(0.1 * RNG.normal(size=shape), 0 * state.force)
    depth = system.penetration(state)
    # forces that are those of the penalty: then all of them turn with the nodes
    pressing = np.maximum(system.penalty * depth, 0.0)
    state = _relaxed(system, replace(state, load_factor=0.8))
    at = system.evaluate(state)
    turning = system.evaluate(replace(state, contact=pressing)).own - at.own
    band, step = system.band, 1e-6
    tangent = band.dense(at.blocks, at.own + turning)
    columns = np.zeros_like(tangent)
    for k, place in enumerate(band.of_node):
        twist = np.zeros(np.prod(shape))
        twist[place] = step
        ahead, behind = (
            system.evaluate(_relaxed(system, state.moved(sign * twist.reshape(shape), 0 * state.force))).residual
            for sign in (1, -1)
        )
        columns[band.number[band.of_node], band.number[place]] = (ahead - behind).ravel()[band.of_node] / (2 * step)
        assert k < tangent.shape[0]
    assert (at.touches).any() and not at.touches.all()
    assert tangent == pytest.approx(columns, abs=1e-6 * np.abs(tangent).max())


def test_banded_solver_solves():
    system = _system()
    at = system.evaluate(_relaxed(system, replace(system.start(), load_factor=0.3)))
    side = RNG.normal(size=at.residual.shape)
    (result,) = system.band.factor(at.blocks, at.own).solve(side)
    order = system.band.number[system.band.of_node]
    product = system.band.dense(at.blocks, at.own) @ result.ravel()[system.band.of_node][np.argsort(order)]
    assert product == pytest.approx(side.ravel()[system.band.of_node][np.argsort(order)], abs=1e-10)
    assert np.abs(result[~system.layout.free]).max() == 0
