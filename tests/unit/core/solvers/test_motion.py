"""The start of a motion keeps the volume, moving supports do work, and a motion can begin in any state."""

import numpy as np
import pytest

import turgor as tg
from turgor.core.engine.algebra.tangent import Tangent
from turgor.core.engine.mass import mass_data
from turgor.core.engine.runtime import use_threads
from turgor.core.engine.system import System
from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
from turgor.core.solvers.dynamics.initial_motion import Accelerations
from turgor.core.solvers.dynamics.time_stepping import follow_motion
from turgor.core.solvers.energies import imbalance
from turgor.core.solvers.problem import Problem
from turgor.core.solvers.procedures.dynamic import Dynamic
from turgor.core.solvers.restart import Restart

OPTIONS = tg.EngineOptions(linear_solver="rslab", threads=1)


def finger(loads: tuple = (), supports: tuple = (), bulk_modulus: float = np.inf) -> tg.Model:
    mesh = tg.mesh(FastPneuNet(chambers=1, length=10e-3).build(), size=4e-3)
    rubber = tg.Material(name="rubber", law=tg.laws.NeoHooke(C10=0.5e5), density=1e3, bulk_modulus=bulk_modulus)
    return tg.Model(mesh, {"body": rubber, "base": rubber}, [tg.Fixed("fixed"), *supports], loads)


def test_velocity_and_acceleration_keep_the_volume() -> None:
    system = System(finger())
    at = system.evaluate(np.zeros(system.size), 0.0)
    start = Accelerations(system, at, mass_data(system))
    wanted = system.joined(np.cross([0.0, 300.0, 0.0], system.points) + 100.0 * system.points[:, [0, 2, 1]])
    velocity = start.velocity(wanted)
    acceleration, _ = start.acceleration(velocity, np.zeros(system.size))
    assert np.abs(velocity[system.prescribed]).max() == 0
    assert np.linalg.norm(velocity - wanted) < 0.9 * np.linalg.norm(wanted)

    def volume_error(time: float, share: float) -> float:
        moved = system.evaluate(time * velocity + share * 0.5 * time**2 * acceleration, 0.0)
        return float(np.linalg.norm(moved.residual[3 * system.node_count :]))

    ratios = [volume_error(2e-5, share) / volume_error(1e-5, share) for share in (0.0, 1.0)]
    assert ratios == pytest.approx([4.0, 8.0], rel=0.05)  # a straight motion errs with t², one that turns with t³


def test_compressible_rubber_takes_any_velocity() -> None:
    system = System(finger(bulk_modulus=1e6))
    at = system.evaluate(np.zeros(system.size), 0.0)
    wanted = system.joined(system.points)
    result = Accelerations(system, at, mass_data(system)).velocity(wanted)
    assert result[~system.prescribed] == pytest.approx(np.where(system.prescribed, 0.0, wanted)[~system.prescribed])


def test_a_moving_support_does_work() -> None:
    def lift(points: np.ndarray, load_factor: float) -> np.ndarray:
        return np.tile([0.0, 0.0, 3e-3 * np.sin(np.pi * load_factor) ** 2], (len(points), 1))

    model = finger(supports=(tg.Displacement("tip", lift),))
    procedure = Dynamic(duration=0.1, stiffness_damping=2e-3, accuracy=0.02)
    solution = tg.solve(model, procedure, options=OPTIONS)
    largest = max(state.energies.strain for state in solution.states)
    assert largest > 20 * solution.states[-1].energies.strain
    assert imbalance(solution.states) < 1e-2
    assert 0.001 * largest < solution.states[-1].energies.dissipated < largest


def test_a_motion_begins_in_a_state() -> None:
    """Let go of from where a static load holds it, the finger swings: strain energy becomes kinetic energy."""
    held = tg.solve(finger((tg.Gravity((0, 0, -1), 50.0),)), options=OPTIONS).states[-1]
    free = finger()
    procedure = Dynamic(duration=0.01, first_step=1e-5, spectral_radius=0.9, max_steps=2000)
    states = []
    with use_threads(1):
        system = System(free)
        outcome = follow_motion(
            Problem(
                system=system, tangent=Tangent(system, "rslab", 1), restart=Restart.of(system, held), states=states
            ),
            procedure,
        )
    assert "Reached 0.01 s" in outcome.message
    assert states[0].displacement == pytest.approx(held.displacement)
    first = states[0].energies
    assert first.kinetic == 0
    assert first.strain > 0
    assert max(state.energies.kinetic for state in states) > 0.5 * first.strain
    assert imbalance(states) < 0.02
