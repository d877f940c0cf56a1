"""Dynamic, Stabilized, mass and modes: what they refuse, how steps adapt, what they say.

The numbers are in V14 and V15 of `tests/verification`.
"""

from pathlib import Path

import numpy as np
import pytest

import turgor as tg
from refused import refused
from turgor.core.engine.algebra.additions import Linear, Together
from turgor.core.engine.damping import StrainRateDamping
from turgor.core.engine.energy import stored_energy
from turgor.core.engine.fields import strain_energy
from turgor.core.engine.mass import mass_data, total_mass
from turgor.core.engine.system import System
from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
from turgor.core.results.files.modes_vtu import write_modes
from turgor.core.results.measures.energies import energy_columns
from turgor.core.solvers.continuation.settings import STEP_CONTROL
from turgor.core.solvers.dynamics.generalized_alpha import Motion, TimeStep, Weights
from turgor.core.solvers.dynamics.modes import natural_frequencies
from turgor.core.solvers.dynamics.time_step_control import TimeControl
from turgor.core.solvers.energies import Energies, imbalance, too_viscous, unbalanced
from turgor.core.solvers.procedures.dynamic import Dynamic
from turgor.core.solvers.procedures.stabilized import Stabilized
from turgor.core.solvers.solution import State, Status

OPTIONS = tg.EngineOptions(linear_solver="rslab", threads=1)
RUBBER = tg.Material(name="rubber", law=tg.laws.NeoHooke(C10=0.5e5), density=1e3)


def finger(pressure: float = 2e3, history: object = ((0, 0), (1, 1)), symmetric: bool = True) -> tg.Model:
    shape = FastPneuNet(chambers=1, length=10e-3, symmetric=symmetric).build()
    mesh = tg.mesh(shape, size=4e-3)
    loads = [tg.Pressure("cavity", pressure, history)]
    return tg.Model(mesh, {"body": RUBBER, "base": RUBBER}, [tg.Fixed("fixed")], loads)


@pytest.fixture(scope="module")
def model() -> tg.Model:
    return finger()


@pytest.mark.parametrize(
    ("values", "facts"),
    [
        ({"duration": 0.0}, ("procedure.duration", "0 s", "more than 0")),
        ({"duration": 1.0, "first_step": 2.0}, ("procedure.first_step", "2 s", "more than 0", "1 s")),
        (
            {"duration": 1.0, "first_step": 0.1, "max_step": 0.05},
            ("procedure.first_step", "0.1 s", "min_step", "1e-06 s", "max_step", "0.05 s"),
        ),
        ({"duration": 1.0, "spectral_radius": 1.1}, ("procedure.spectral_radius", 1.1, "0 to 1")),
        ({"duration": 1.0, "accuracy": 0.0}, ("procedure.accuracy", 0, "1e-09 to 0.1")),
        ({"duration": 1.0, "mass_damping": -1.0}, ("procedure.mass_damping", -1, "0 or more")),
        ({"duration": 1.0, "keep": 0}, ("procedure.keep", 0, "1 or more")),
        ({"duration": 1.0, "at": (1.5,)}, ("procedure.at", 1.5, "(0, 1]")),
    ],
)
def test_a_wrong_motion_is_refused(values: dict, facts: tuple) -> None:
    with refused(*facts):
        Dynamic(**values)


def test_a_wrong_stabilization_is_refused() -> None:
    with refused("procedure.stabilization", 0, "more than 0 up to 0.1"):
        Stabilized(stabilization=0.0)
    with refused("procedure.max_step", 2, "more than 0 up to 1"):
        Stabilized(max_step=2.0)


def test_without_density_nothing_moves() -> None:
    light = tg.Material(name="light rubber", law=tg.laws.NeoHooke(C10=0.5e5))
    shape = finger()
    model = tg.Model(shape.mesh, {"body": RUBBER, "base": light}, shape.supports, shape.loads)
    with refused("materials.base", "'light rubber'", "density", "kg/m³"):
        tg.solve(model, Dynamic(duration=0.1), options=OPTIONS)
    assert tg.solve(model, Stabilized(), options=OPTIONS).converged  # its mass is a measure of volume only


def test_mass_is_that_of_the_whole_actuator() -> None:
    half, whole = finger(), finger(symmetric=False)
    system = System(half)
    data = mass_data(system)
    for axis in range(3):
        even = np.zeros(system.size)
        even[axis : 3 * system.node_count : 3] = 1.0
        moved = even @ system.pattern.product(data, even) * system.stress_scale * system.length
        assert 2 * moved == pytest.approx(total_mass(half), rel=1e-12)
    assert total_mass(half) == pytest.approx(total_mass(whole), rel=1e-9)


@pytest.mark.parametrize("formulation", ["mixed", "displacement"])
def test_damping_knows_rigid_motions_and_takes_energy(formulation: str) -> None:
    half = finger()
    rubber = tg.Material(name="rubber", law=tg.Yeoh(C10=1e5, C20=1e3, C30=1e2), bulk_modulus=1e7, density=1e3)
    model = tg.Model(half.mesh, {"body": rubber, "base": rubber}, half.supports, [], formulation)
    system, rng = System(model), np.random.default_rng(0)
    x = 0.02 * rng.normal(size=system.size)
    u, _ = system.split(x)
    turning = np.zeros(system.size)
    turning[: 3 * system.node_count] = np.cross([1.0, 2.0, 3.0], system.points + u).ravel()
    assert np.abs(StrainRateDamping(system, 1.0, 0.0, turning).forces(x)).max() < 1e-12
    moving = rng.normal(size=system.size)
    assert StrainRateDamping(system, 1.0, 0.0, moving).forces(x) @ moving > 0
    at_rest, nothing = StrainRateDamping(system, 1.0, 1.0, -x), np.zeros(system.size)
    matrix = at_rest.data(x)  # where the velocity vanishes, the derivative is exact
    change = (at_rest.forces(x + 1e-6 * moving) - at_rest.forces(x - 1e-6 * moving)) / 2e-6
    assert system.pattern.product(matrix, moving) == pytest.approx(change, abs=1e-6 * np.abs(change).max())
    assert np.abs(system.pattern.product(matrix, turning)).max() < 1e-12
    displacement, mean_stress = system.physical(x)
    assert stored_energy(system, x, 0.0) == pytest.approx(strain_energy(model, displacement, mean_stress), rel=1e-12)
    assert system.unknowns(displacement, mean_stress) == pytest.approx(x, abs=1e-14)
    both = Together([Linear(system.pattern, matrix, nothing), Linear(system.pattern, matrix, moving)])
    assert both.forces(x) == pytest.approx(2 * system.pattern.product(matrix, x) + moving)
    assert both.data(x) == pytest.approx(2 * matrix)


def test_a_step_is_exact_where_the_acceleration_is_even() -> None:
    a, v = np.array([1.0, -2.0, 0.5]), np.array([0.3, 0.1, 0.0])
    before = Motion(np.zeros(3), v, a, a)
    rule = TimeStep(Weights.of(0.7), before, 0.2, np.ones(3))
    end = rule.motion(v * 0.2 + 0.5 * a * 0.04)
    assert end.velocity == pytest.approx(v + 0.2 * a)
    assert end.acceleration == pytest.approx(a)
    assert rule.prediction() == pytest.approx(end.unknowns)
    assert rule.error(end.unknowns) == pytest.approx(0.0, abs=1e-12)
    h = 1e-6
    slope = (rule.velocity(end.unknowns + h) - rule.velocity(end.unknowns - h)) / (2 * h)
    assert slope == pytest.approx(rule.rate)
    slope = (rule.acceleration(end.unknowns + h) - rule.acceleration(end.unknowns - h)) / (2 * h)
    assert slope == pytest.approx(rule.stiffness)


def test_time_steps_hit_what_was_asked_for() -> None:
    control = TimeControl.of(Dynamic(duration=1.0, first_step=0.03, max_step=0.03, at=(0.1,)), kinks=(0.25,))
    times = [0.0]
    while times[-1] < 1.0:
        times.append(control.next_time(times[-1]))
    assert {0.1, 0.25, 1.0} <= set(times)
    assert max(np.diff(times)) <= 0.03 * 1.051
    assert control.failed(1e-9) is None
    assert control.failed(0.02).length == pytest.approx(0.02 * STEP_CONTROL.step_cut)


def test_a_motion_follows_its_load_and_says_so(model: tg.Model) -> None:
    seen = []
    moving = finger(history="sin(pi * s)")
    procedure = Dynamic(duration=0.2, stiffness_damping=2e-3, at=(0.3,), keep=1000, accuracy=5e-3)
    solution = tg.solve(moving, procedure, options=OPTIONS, progress=lambda it, state: seen.append(state))
    assert [state.load_factor for state in solution.states] == pytest.approx([0.0, 0.3, 1.0])
    assert [state.time for state in solution.states] == pytest.approx([0.0, 0.06, 0.2])
    accepted = [state for state in seen if state is not None]
    assert len(accepted) == sum(step.accepted for step in solution.steps) > 20
    assert max(np.abs(state.displacement).max() for state in accepted) > 5 * np.abs(accepted[-1].displacement).max()
    assert solution.message.startswith("Reached 0.2 s in")
    assert solution.findings == ()
    assert imbalance(accepted) < 1e-2
    response = tg.measure(solution, tg.cavity_volume)
    assert response.names[:3] == ("load_factor", "time", "pressure")
    assert response.names[-5:] == (
        "kinetic_energy", "strain_energy", "dissipated_energy", "external_work", "missing_energy",
    )  # fmt: skip
    columns = {column.name: column.values for column in energy_columns(solution)}
    assert columns["external_work"][-1] == 2 * solution.states[-1].energies.work  # both halves
    assert energy_columns(tg.solve(model, options=OPTIONS)) == ()


def test_a_motion_can_be_stopped_and_can_fail(model: tg.Model) -> None:
    stopped = tg.solve(
        model,
        Dynamic(duration=0.1),
        options=OPTIONS,
        throw=False,
        stop=lambda s: "far enough" if s.time > 1e-3 else None,
    )
    assert stopped.status is Status.STOPPED
    assert "far enough" in stopped.message
    few = tg.solve(model, Dynamic(duration=0.1, max_steps=2), options=OPTIONS, throw=False)
    assert few.status is Status.STEP_LIMIT
    assert "max_steps" in few.advice
    stuck = tg.solve(model, Dynamic(duration=0.1, max_iterations=1, tolerance=1e-12), options=OPTIONS, throw=False)
    assert stuck.status is Status.STEP_TOO_SMALL
    assert "No motion was found beyond 0 s" in stuck.message


def test_a_velocity_keeps_the_volume_and_the_supports() -> None:
    still = finger(0.0)
    procedure = Dynamic(duration=1e-3, velocity=lambda points: np.tile([0.0, 0.0, 1.0], (len(points), 1)))
    solution = tg.solve(still, procedure, options=OPTIONS)
    first = solution.states[0]
    assert np.abs(first.velocity[still.mesh.face_nodes("fixed")]).max() == 0
    assert first.energies.kinetic > 0
    assert imbalance(solution.states) < 0.05


def _with(energies: Energies) -> State:
    nothing = np.zeros((1, 3))
    return State(
        model=None, load_factor=1.0, displacement=nothing, mean_stress=nothing, nodal_force=nothing, energies=energies
    )


def test_lost_energy_is_a_finding() -> None:
    good = _with(Energies(kinetic=1.0, strain=1.0, dissipated=1.0, work=3.01))
    bad = _with(Energies(kinetic=1.0, strain=1.0, dissipated=1.0, work=3.1))
    assert unbalanced([good]) == ()
    assert [finding.code for finding in unbalanced([good, bad])] == ["L05"]
    assert "3.3 %" in unbalanced([bad])[0].message
    assert unbalanced([]) == too_viscous([]) == ()
    assert too_viscous([_with(Energies(kinetic=0.0, strain=1.0, dissipated=0.009, work=1.0))]) == ()
    viscous = too_viscous([_with(Energies(kinetic=0.0, strain=1.0, dissipated=0.02, work=1.0))])
    assert [finding.code for finding in viscous] == ["L06"]
    assert "2 %" in viscous[0].message


def test_modes_are_written_for_paraview(model: tg.Model, tmp_path: Path) -> None:
    modes = natural_frequencies(model, count=2, options=OPTIONS)
    file = write_modes(tmp_path, modes)
    assert file.name == "mode.pvd"
    assert sorted(path.name for path in tmp_path.iterdir()) == ["mode.pvd", "mode_0000.vtu", "mode_0001.vtu"]
    assert f'timestep="{modes.frequencies[1]:.12g}"' in file.read_text()
    assert "mode_shape" in (tmp_path / "mode_0001.vtu").read_text()
