"""What rubber remembers: every procedure carries it along, states keep it, fields, energies and modes read it there."""

from dataclasses import replace

import numpy as np
import pytest

import turgor as tg
from refused import refused
from turgor.core.engine.cells.internal_variables import right_cauchy_green
from turgor.core.engine.cells.known_stress import add_known_stress
from turgor.core.engine.system import System
from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
from turgor.core.materials.history.isochoric import isochoric_stress, isochoric_tangent
from turgor.core.materials.history.softening import Mullins
from turgor.core.materials.history.viscoelastic import Prony
from turgor.core.results.fields.state_fields import StateFields
from turgor.core.solvers.dynamics.modes import natural_frequencies
from turgor.core.solvers.procedures.arc_length import ArcLength
from turgor.core.solvers.procedures.auto import Auto
from turgor.core.solvers.procedures.dynamic import Dynamic
from turgor.core.solvers.procedures.stabilized import Stabilized
from turgor.core.solvers.procedures.static import Static
from turgor.core.solvers.procedures.volume_control import VolumeControl

OPTIONS = tg.EngineOptions(linear_solver="rslab", threads=1)
LAW = tg.laws.MooneyRivlin(C10=0.4e5, C01=0.1e5)
PLAIN = tg.Material(name="rubber", law=LAW, density=1e3)
SLOW = replace(PLAIN, viscoelasticity=Prony(g=(0.3,), tau=(0.05,), moduli="long_term"))
QUICK = replace(PLAIN, viscoelasticity=Prony(g=(0.3,), tau=(0.05,), moduli="instantaneous"))
SOFT = replace(PLAIN, stress_softening=Mullins(r=1.5, m=50.0))
UP_AND_DOWN = ((0, 0), (0.5, 1), (1, 0))
CYCLED = [Static(max_step=0.025), Stabilized(max_step=0.025), Dynamic(duration=5.0, first_step=0.125, adaptive=False)]


@pytest.fixture(scope="module")
def finger():
    mesh = tg.mesh(FastPneuNet(chambers=1, length=10e-3).build(), size=4e-3)

    def make(rubber, pressure=2e3, history=((0, 0), (1, 1))):
        loads = [tg.Pressure("cavity", pressure, history)] if pressure else []
        return tg.Model(mesh, {"body": rubber, "base": rubber}, [tg.Fixed("fixed")], loads)

    return make


def solve(model, procedure):
    return tg.solve(model, procedure, options=OPTIONS)


def moved(solution, place=-1):
    return np.abs(solution.states[place].displacement).max()


def test_the_compiled_loop_has_the_formulas_of_the_material():
    rng = np.random.default_rng(5)
    F = np.eye(3) + rng.uniform(-0.3, 0.3, (4, 2, 3, 3))
    rows, known = np.array([1, 3]), rng.normal(size=(2, 2, 6))
    stress, tangent = np.ones((4, 2, 6)), np.ones((4, 2, 21))
    add_known_stress(F, rows, known, 2.0, stress, tangent)
    C = right_cauchy_green(F[rows])
    assert stress[rows] == pytest.approx(1 + isochoric_stress(known / 2, C), rel=1e-12)
    assert tangent[rows] == pytest.approx(1 + isochoric_tangent(known / 2, C), rel=1e-12)
    assert (stress[[0, 2]] == 1).all() and (tangent[[0, 2]] == 1).all()


def test_rubber_that_forgets_keeps_no_memory(finger):
    solution = solve(finger(PLAIN), Static(duration=1.0))
    assert [state.memory for state in solution.states] == [None] * len(solution.states)
    assert [state.time for state in solution.states] == [state.load_factor for state in solution.states]
    assert solve(finger(PLAIN), Static()).states[-1].time is None


@pytest.mark.parametrize("duration", [0.0, -1.0, np.inf, np.nan])
def test_a_wrong_duration_is_refused(duration):
    with refused("procedure.duration", f"{duration:g} s", "more than 0"):
        Static(duration=duration)


@pytest.mark.parametrize(
    ("procedure", "pressure"),
    [
        (Static(), 2e3),
        (Stabilized(stabilization=1e-8), 2e3),
        (ArcLength(), 2e3),
        (Auto(), 2e3),
        (VolumeControl(volume=5e-8), 0.0),
    ],
    ids=lambda value: type(value).__name__,
)
def test_without_time_the_long_term_law_holds(finger, procedure, pressure):
    slow, plain = (solve(finger(rubber, pressure), procedure) for rubber in (SLOW, PLAIN))
    for place in (1, -1):
        assert moved(slow, place) == pytest.approx(moved(plain, place), rel=1e-4)
    assert slow.states[-1].memory.stress["body"].shape[0] == 2


@pytest.mark.parametrize("procedure", CYCLED, ids=lambda each: type(each).__name__)
def test_a_first_cycle_loses_what_softening_takes(finger, procedure):
    solution = solve(finger(SOFT, 2e3, UP_AND_DOWN), procedure)
    response = tg.measure(solution, tg.cavity_volume, mesh_error=False)
    pressure, volume = response.column("pressure"), response.column("cavity_volume")
    area = float((0.5 * (pressure[1:] + pressure[:-1]) * np.diff(volume)).sum())
    model, last = solution.model, solution.states[-1]
    system = System(model)
    lost = system.dV * system.length**3 * system.materials.softening_loss(last.memory)
    assert area == pytest.approx(2 * lost.sum(), rel=0.05)
    assert isinstance(procedure, Stabilized) or all(step.accepted for step in solution.steps)
    if last.energies is not None:
        assert last.energies.dissipated == pytest.approx(lost.sum(), rel=0.05)
        assert max(abs(state.energies.missing) for state in solution.states) < 0.02 * lost.sum()


def test_softening_stays_where_a_volume_drives(finger):
    """The cavity hardly grows, and the outside is pressed and let go again."""
    middle, end = [], []
    for rubber in (SOFT, PLAIN):
        model = finger(rubber, 0.0)
        load = tg.Pressure("outside", 1e3, ((0, 0), (0.5, 1), (1, 0.5)))
        solution = solve(replace(model, loads=(load,)), VolumeControl(volume=1e-10, at=(0.5,)))
        turn = next(k for k, state in enumerate(solution.states) if state.load_factor == 0.5)
        middle.append(moved(solution, turn))
        end.append(moved(solution))
        if rubber is SOFT:
            largest = [solution.states[k].memory.largest["body"] for k in (turn, -1)]
    assert (largest[1] >= largest[0]).all()
    assert middle[0] == pytest.approx(middle[1], rel=1e-6)
    assert end[0] > 1.1 * end[1]


def test_a_slow_motion_is_static(finger):
    """Both know the time; inertia is small in half a second."""
    procedure = Static(duration=0.5, max_step=0.04)
    still = solve(finger(QUICK), procedure)
    motion = solve(finger(QUICK), Dynamic(duration=0.5, first_step=0.02, adaptive=False))
    relaxed, sudden = solve(finger(QUICK), Static()), solve(finger(PLAIN), Static())
    assert moved(motion) == pytest.approx(moved(still), rel=5e-3)
    assert 1.1 * moved(sudden) < moved(still) < 0.99 * moved(relaxed)
    assert not motion.findings
    energies = motion.states[-1].energies
    assert energies.dissipated > 0.05 * energies.work


@pytest.mark.parametrize(
    ("rubber", "duration", "max_step", "codes"),
    [
        (QUICK, 1.0, 0.25, ["L07"]),
        (QUICK, 1.0, 0.02, []),
        (QUICK, 100.0, 0.25, []),  # so slow that it relaxes in every step
        (QUICK, None, 0.25, []),
        (PLAIN, 1.0, 0.25, []),
    ],
)
def test_steps_that_are_long_for_the_rubber_are_noticed(finger, rubber, duration, max_step, codes):
    procedure = Static(duration=duration, max_step=max_step, first_step=min(0.05, max_step))
    findings = [finding for finding in solve(finger(rubber), procedure).findings if finding.code == "L07"]
    assert [finding.code for finding in findings] == codes
    if findings:
        assert "relaxes in 0.05 s" in findings[0].message
        assert "max_step = 0.01" in findings[0].advice


def test_fields_are_those_of_the_state(finger):
    """Held in equilibrium, the Cauchy stresses of the state balance its loads; without memory they do not."""
    state = solve(finger(QUICK), Static(duration=0.1)).states[-1]
    system = System(state.model)
    unknowns = system.unknowns(state.displacement, state.mean_stress)
    at = system.evaluate(unknowns, 1.0, history=system.history(state.memory))
    free = ~system.prescribed
    assert np.linalg.norm(at.residual[free]) < 1e-5 * np.linalg.norm(at.external)
    with_memory, without = (StateFields(each).cells.von_mises for each in (state, replace(state, memory=None)))
    assert np.abs(with_memory - without).max() > 0.05 * with_memory.max()


def test_vibrations_meet_the_instantaneous_stiffness(finger):
    plain, quick, slow = (
        natural_frequencies(finger(rubber), count=2, options=OPTIONS).frequencies for rubber in (PLAIN, QUICK, SLOW)
    )
    assert quick == pytest.approx(plain, rel=1e-6)
    assert slow == pytest.approx(plain / np.sqrt(0.7), rel=1e-6)
    state = solve(finger(SLOW), Static()).states[-1]
    about = natural_frequencies(finger(SLOW), state, count=2, options=OPTIONS).frequencies
    assert about == pytest.approx(slow, rel=0.1)
