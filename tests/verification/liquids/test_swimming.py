"""A slender body that bends in water at rest pushes itself away from its tail.

Problems: (1) forces on a bar in a prescribed traveling wave of small amplitude; (2) a clamped bar that a tip force
shakes.
Exact: Lighthill 1960 (doi 10.1017/S0022112060001110) for a body that does not advance: the mean thrust towards the head
is ½ m ⟨(∂h/∂t)²⟩ at the tail, with the added mass m per length, less the same at the head; here (2) with the motion of
its own tail.
Tolerance: (1) 2 %: strips of a wave of finite amplitude and eight cells; (2) 5 %: mean of 64 steps in a cycle, and the
rotation of the thick end.
"""

from dataclasses import replace

import numpy as np
import pytest

import meshes
import problems
import turgor as tg
from refused import refused
from turgor.core.engine.liquids.morison import MorisonForces, strips_of
from turgor.core.engine.system import System
from turgor.core.meshing.cells import HEXAHEDRON
from turgor.core.results.measures.work.thrust_measures import cycle_of
from turgor.core.solvers.procedures.dynamic import Dynamic

LENGTH, SIDE, RUBBER, WATER, ADDED = 0.1, 0.005, 1070.0, 1000.0, 1.5
PER_LENGTH = ADDED * WATER * SIDE**2


def bar(count, *loads, law=problems.NEO_HOOKE, drag=0.0):
    mesh = meshes.box((LENGTH, SIDE, SIDE), (count, 1, 1), kind=HEXAHEDRON)
    mesh = meshes.with_faces(mesh, outside=np.concatenate([mesh.face(name) for name in ("y0", "y1", "z0", "z1")]))
    water = tg.loads.Morison(face="outside", density=WATER, axis=(1, 0, 0), added_mass=ADDED, drag=drag)
    return tg.Model(mesh, {"body": problems.rubber(law, density=RUBBER)}, [tg.Fixed("x0")], [water, *loads])


def test_a_traveling_wave_in_water(record_verification):
    model, wave, rate, height = bar(8), 2 * np.pi / LENGTH, 2 * np.pi, 1e-3
    system = System(model)
    strips, x = strips_of(system), model.mesh.points[:, 0]

    def nodal(values):
        """Unknowns of a motion along z that grows towards the tail, at rate 1."""
        moved = np.zeros_like(model.mesh.points)
        moved[:, 2] = height * x / LENGTH * values
        return moved, system.rates(np.zeros(system.size), moved)

    forces = []
    for time in np.arange(16) / 16:
        phase = wave * x - rate * time
        moved, _ = nodal(np.cos(phase))
        velocity, acceleration = nodal(rate * np.sin(phase))[1], nodal(-(rate**2) * np.cos(phase))[1]
        position, nothing = system.points + moved / system.length, np.zeros(system.size)
        of_step = MorisonForces(system, strips, position, 1.0, (0.0, velocity), (0.0, acceleration))
        against = system.by_node(of_step.forces(nothing))[:, 0].sum()
        forces.append(against * system.stress_scale * system.length**2)
    got = float(np.mean(forces))  # against the motion: towards the head
    exact = 0.5 * PER_LENGTH * (rate * height) ** 2 / 2
    record_verification("traveling wave in water: mean thrust [N]", "Lighthill 1960", exact, got, "2 %")
    assert got == pytest.approx(exact, rel=0.02)


def test_a_shaken_bar_pushes_towards_its_root(record_verification):
    stiff = tg.laws.NeoHooke(C10=2e6)
    shaking = tg.loads.Force("x1", (0.0, 0.0, 0.02), history="sin(3*pi*s)**2")
    procedure = Dynamic(
        duration=1.2, first_step=1.2 / 192, max_step=1.2 / 192, adaptive=False, tolerance=1e-9,
        stiffness_damping=5e-3, spectral_radius=0.2,
    )  # fmt: skip
    solution = problems.solve(bar(4, shaking, law=stiff), procedure)
    response = tg.measure(solution, tg.measures.thrust_x)
    got = response.column("thrust_x")
    tail = solution.model.mesh.face_nodes("x1")
    speed = np.array([state.velocity[tail, 2].mean() for state in solution.states[-64:]])
    exact = -0.5 * PER_LENGTH * float((speed**2).mean())
    record_verification("shaken bar: mean thrust over its last cycle [N]", "Lighthill 1960", exact, got[-1], "5 %")
    assert got[-1] == pytest.approx(exact, rel=0.05)
    assert np.isnan(got[:64]).all() and np.isfinite(got[64:]).all()


def test_thrust_needs_a_motion_and_a_cycle():
    push = tg.loads.Force("x1", (0.0, 0.0, 1e-4))
    model, repeated = bar(1, push), bar(1, replace(push, history="sin(2*pi*s)**2"))
    with refused("thrust_x", "dynamic"):
        tg.measure(problems.solve(repeated, tg.Static()), tg.measures.thrust_x)
    moving = problems.solve(model, Dynamic(duration=0.1, first_step=0.05, max_step=0.05))
    with refused("thrust_x", "over a cycle", "history_over_time"):
        tg.measure(moving, tg.measures.thrust_x)


def test_coarse_and_unlike_cycles_have_no_thrust():
    shaking = tg.loads.Force("x1", (0.0, 0.0, 1e-4), history="sin(2*pi*s)**2")  # two cycles
    for count, known in ((14, False), (16, True)):
        step = 0.1 / count
        procedure = Dynamic(duration=0.1, first_step=step, max_step=step, adaptive=False)
        thrust = tg.measure(problems.solve(bar(1, shaking), procedure), tg.measures.thrust_x).column("thrust_x")
        assert np.isfinite(thrust[-1]) == known
    unlike = bar(1, replace(shaking, history="sin(4*pi*s)"), replace(shaking, history="sin(6*pi*s)"))
    with refused("cycles of 0.5 and 0.3333"):
        cycle_of(unlike)
    assert cycle_of(bar(1, shaking, replace(shaking, history="sin(8*pi*s)"))) == pytest.approx(0.5)
