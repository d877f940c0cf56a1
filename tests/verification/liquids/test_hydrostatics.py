"""The pressure of a liquid adds up to its weight and to buoyancy, stretches the wall of a tank and lifts a float.

Problems: a block at a random deformation in water; a soft hollow cube filled with water; a cylindrical tank of
incompressible rubber (E = 0.72 MPa, R = 20 mm, wall 1 mm) full of a light liquid, which slides on its bottom; a stiff
block on springs that water lifts.
Exact: buoyancy ρ g V (Archimedes); the support carries the weight of the water; radial displacement of Lamé's thick
tube under the pressure at each height, which in a thin wall needs no bending; balance of weight, buoyancy and springs.
Tolerance: 1e-11 for sums (the integrals are exact), 1e-6 for the reaction and the float (Newton's tolerance), 1 % for
the tank (its strains are up to 0.3 %).
"""

import numpy as np
import pytest

import meshes
import problems
import turgor as tg
from turgor.core.engine.chamber_volumes import cavity_volume
from turgor.core.engine.faces.surfaces import enclosed_volume
from turgor.core.engine.system import System
from turgor.core.engine.term import Configuration
from turgor.core.meshing.cells import HEXAHEDRON, TETRAHEDRON

WATER, GRAVITY = 1000.0, 9.80665


@pytest.mark.parametrize("kind", [TETRAHEDRON, HEXAHEDRON], ids=["tetrahedra", "hexahedra"])
def test_buoyancy_of_a_deformed_block(kind, record_verification):
    mesh = meshes.box((0.02, 0.01, 0.01), (2, 1, 1), kind=kind)
    loads = [
        tg.loads.HydrostaticPressure(face=side, density=WATER, level=0.3, direction=(0, -3, -4))
        for side in meshes.SIDES
    ]
    system = System(problems.one_material(mesh, problems.NEO_HOOKE, supports=[tg.Fixed("x0")], loads=loads))
    rng = np.random.default_rng(5)
    points = mesh.points @ (np.eye(3) + 0.3 * rng.uniform(-1, 1, (3, 3))) + rng.normal(0, 3e-4, mesh.points.shape)
    _, external = system.terms.forces(Configuration(points / system.length, 1.0))
    force = external.sum(axis=0) * system.stress_scale * system.length**2
    volume = enclosed_volume(points, np.concatenate([mesh.face(side) for side in meshes.SIDES]))
    lift = WATER * GRAVITY * volume * np.array([0, 0.6, 0.8])
    record_verification(
        f"force of water on a deformed block of {kind.nodes}-node cells [N]", "Archimedes", lift.tolist(),
        force.tolist(), "1e-11",
    )  # fmt: skip
    assert force == pytest.approx(lift, abs=1e-11 * lift.max())


def test_the_support_carries_the_water_in_a_cavity(record_verification):
    mesh = meshes.with_points(meshes.hollow_box(), 0.03 * meshes.hollow_box().points)
    loads = [tg.loads.HydrostaticPressure(face="cavity", density=20 * WATER, level=0.1), tg.Pressure("cavity", 4e3)]
    model = problems.one_material(mesh, problems.NEO_HOOKE, supports=[tg.Fixed("z0")], loads=loads)
    state = problems.solve(model, tg.Static(tolerance=1e-9)).states[-1]
    at_rest, volume = cavity_volume(mesh, "cavity"), cavity_volume(mesh, "cavity", state.displacement)
    weight = 20 * WATER * GRAVITY * volume
    force = problems.reaction(state, "z0")
    record_verification(
        f"reaction of a cube whose cavity grows by {100 * (volume / at_rest - 1):.2g} %, filled with a liquid [N]",
        "statics", weight, float(force[2]), "1e-6",
    )  # fmt: skip
    assert volume > 1.03 * at_rest
    assert force == pytest.approx([0, 0, weight], abs=1e-6 * weight)


def test_the_wall_of_a_tank(record_verification):
    inner, outer, height = 19.5e-3, 20.5e-3, 0.1
    mesh = meshes.tube_sector(inner, outer, height, (1, 3, 6), kind=HEXAHEDRON)
    loads = [tg.loads.HydrostaticPressure(face="cavity", density=0.1 * WATER, level=height)]
    model = problems.one_material(mesh, problems.NEO_HOOKE, supports=[tg.Fixed("z0", "z")], loads=loads)
    state = problems.solve(model).states[-1]
    inside = mesh.face_nodes("cavity")
    points = mesh.points[inside]
    moved = np.linalg.norm((points + state.displacement[inside])[:, :2], axis=1) - inner
    pressure = 0.1 * WATER * GRAVITY * (height - points[:, 2])
    stiffness = 6 * problems.NEO_HOOKE.C10
    lame = pressure * inner / stiffness * ((inner**2 + outer**2) / (outer**2 - inner**2) + 0.5)
    away = points[:, 2] > 6 * np.sqrt(inner * (outer - inner))  # the bottom keeps the wall from tilting
    off = np.abs(moved - lame)[away].max() / lame.max()
    record_verification(
        "widening of a full tank at half its height [mm]; largest error above the bottom, over the largest widening",
        "Lamé", f"{1e3 * lame.max() / 2:.5g}; 0",
        f"{1e3 * moved[np.isclose(points[:, 2], height / 2)].mean():.5g}; {100 * off:.2g} %", "1 %",
    )  # fmt: skip
    assert off < 0.01


def test_a_float_on_springs(record_verification):
    side, springs, level = 0.1, 2e4, 0.06
    mesh = meshes.box((side, side, side), (1, 1, 2), kind=HEXAHEDRON)
    rubber = problems.rubber(tg.laws.NeoHooke(C10=3e6), density=400.0)
    wet = [tg.loads.HydrostaticPressure(face=f, density=WATER, level=level, free_surface=True) for f in meshes.SIDES]
    supports = [tg.Fixed("x0", "x"), tg.Fixed("y0", "y"), tg.supports.Foundation("z1", springs)]
    model = tg.Model(mesh, {"body": rubber}, supports, [*wet, tg.Gravity()])
    risen = problems.solve(model, tg.Static()).states[-1].displacement[:, 2].mean()
    # ρ g (level − z) = ρ_s g side + springs z
    exact = (WATER * GRAVITY * level - 400.0 * GRAVITY * side) / (WATER * GRAVITY + springs)
    record_verification("rise of a float on springs [mm]", "statics", 1e3 * exact, 1e3 * risen, "0.1 %")
    assert risen == pytest.approx(exact, rel=1e-3)
