"""Bodies in motion carry liquid along and are slowed by it: added mass and drag of strip theory, liquid in cavities.

Problems: (1) frequencies of a square cantilever in water and in air; (2) a square bar that coasts across its axis in
water; (3) a hollow cube full of water on springs; (4) differences of the forces of a bent bar.
Exact: (1) for thin beams f² falls by 1 + C ρ/ρ_s; (2) v = v₀ / (1 + c v₀ t / M) with M v' = −c v²,
M = (ρ_s + C ρ) A L and c = ½ ρ C_d (P/π) L; (3) ω² = k A / (mass of the rubber and the water), a stiff cube;
(4) equality.
Tolerance: (1) 0.5 % (rotary inertia, which water around the bar has none of); (2) 1e-3 with 60 steps, second order, and
a balance of the energies; (3) 0.5 % (the cube gives way); (4) 1e-7 of the largest entry.
"""

import numpy as np
import pytest

import meshes
import problems
import turgor as tg
from turgor.core.engine.chamber_volumes import cavity_volume
from turgor.core.engine.liquids.morison import MorisonForces, strips_of
from turgor.core.engine.mass import total_mass
from turgor.core.engine.system import System
from turgor.core.meshing.cells import HEXAHEDRON
from turgor.core.solvers.dynamics.modes import natural_frequencies
from turgor.core.solvers.energies import imbalance
from turgor.core.solvers.procedures.dynamic import Dynamic

LENGTH, SIDE, RUBBER, WATER = 0.1, 0.01, 1070.0, 1000.0


def bar(supports, counts=(6, 1, 1), **water):
    mesh = meshes.box((LENGTH, SIDE, SIDE), counts, kind=HEXAHEDRON)
    mesh = meshes.with_faces(mesh, outside=np.concatenate([mesh.face(name) for name in ("y0", "y1", "z0", "z1")]))
    loads = [tg.loads.Morison(face="outside", density=WATER, axis=(1, 0, 0), **water)] if water else []
    return tg.Model(mesh, {"body": problems.rubber(problems.NEO_HOOKE, density=RUBBER)}, supports, loads)


def test_a_cantilever_in_water(record_verification):
    air, water = (
        natural_frequencies(bar([tg.Fixed("x0")], **added), count=2, options=problems.OPTIONS).frequencies[0]
        for added in ({}, {"added_mass": 1.5})
    )
    exact, got = 1 + 1.5 * WATER / RUBBER, (air / water) ** 2
    record_verification(
        "cantilever with added mass: square of the frequency in air over that in water", "Euler-Bernoulli",
        exact, got, "0.5 %",
    )  # fmt: skip
    assert got == pytest.approx(exact, rel=5e-3)


def coasted(steps):
    speed, duration, drag = 0.05, 1.0, 2.0
    procedure = Dynamic(
        duration=duration, first_step=duration / steps, max_step=duration / steps, adaptive=False,
        velocity=lambda points: np.broadcast_to((0.0, 0.0, speed), points.shape),
    )  # fmt: skip
    model = bar([tg.Fixed("x0", "x"), tg.Fixed("y0", "y")], (1, 1, 1), added_mass=0.8, drag=drag)
    solution = problems.solve(model, procedure)
    last = solution.states[-1]
    assert imbalance(solution.states) < 1 / steps
    rate = 0.5 * WATER * drag * 4 * SIDE / np.pi / ((RUBBER + 0.8 * WATER) * SIDE**2)
    return float(last.velocity[:, 2].mean()), speed / (1 + rate * speed * duration)


def test_a_bar_coasts_across_its_axis(record_verification):
    results = [coasted(steps) for steps in (30, 60)]
    (coarse, exact), (fine, _) = results
    order = np.log2(abs(coarse - exact) / abs(fine - exact))
    record_verification(
        "speed of a bar that coasts in water [m/s]; order in the step", "exact", [exact, 2], [fine, order], "1e-3, 0.3"
    )
    assert fine == pytest.approx(exact, rel=1e-3)
    assert order == pytest.approx(2, abs=0.3)


def test_along_its_axis_water_does_nothing():
    moved = []
    for water in ({}, {"added_mass": 2.0, "drag": 5.0}):
        procedure = Dynamic(
            duration=0.1, first_step=0.05, max_step=0.05, adaptive=False,
            velocity=lambda points: np.broadcast_to((1.0, 0.0, 0.0), points.shape),
        )  # fmt: skip
        model = bar([tg.Fixed("y0", "y"), tg.Fixed("z0", "z")], (1, 1, 1), **water)
        moved.append(problems.solve(model, procedure).states[-1].displacement)
    assert moved[0] == pytest.approx(moved[1], abs=1e-9)
    assert moved[0][:, 0] == pytest.approx(0.1, rel=1e-6)


def test_water_in_a_cavity_has_inertia(record_verification):
    rest = meshes.hollow_box()
    mesh = meshes.with_points(rest, 0.03 * rest.points)
    rubber = problems.rubber(problems.NEO_HOOKE, density=RUBBER)
    springs = 1e3
    supports = [tg.Fixed("x0", "x"), tg.Fixed("y0", "y"), tg.supports.Foundation("z0", springs)]
    water = tg.loads.HydrostaticPressure(face="cavity", density=20 * WATER, level=0.03)
    model = tg.Model(mesh, {"body": rubber}, supports, [water])
    got = natural_frequencies(model, count=1, options=problems.OPTIONS).frequencies[0]
    mass = total_mass(model) + 20 * WATER * cavity_volume(mesh, "cavity")
    exact = np.sqrt(springs * 0.03**2 / mass) / (2 * np.pi)
    record_verification("hollow cube full of a liquid on springs: frequency [Hz]", "exact", exact, got, "0.5 %")
    assert got == pytest.approx(exact, rel=5e-3)


def test_the_tangent_is_the_derivative_of_the_forces():
    system = System(bar([tg.Fixed("x0")], (2, 1, 1), added_mass=1.3, drag=1.7))
    rng = np.random.default_rng(3)
    position = system.points + 0.2 * rng.uniform(-1, 1, system.points.shape)
    offsets = rng.uniform(-1, 1, (2, system.size))
    forces = MorisonForces(system, strips_of(system), position, 1.0, (3.0, offsets[0]), (5.0, offsets[1]))
    unknowns = rng.uniform(-1, 1, system.size)
    exact = np.zeros((system.size, system.size))
    for j in range(system.size):
        step = np.zeros(system.size)
        step[j] = 1e-6
        exact[:, j] = (forces.forces(unknowns + step) - forces.forces(unknowns - step)) / 2e-6
    got = system.layout.base.full(forces.data(unknowns)).toarray()
    assert np.abs(exact).max() > 0
    assert np.abs(got - exact).max() < 1e-7 * np.abs(exact).max()
