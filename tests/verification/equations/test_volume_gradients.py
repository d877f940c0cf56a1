"""V24: volumes of cavities change with the displacement as their gradients say, whatever closes the cavities."""

import numpy as np
import pytest

import meshes
from turgor.core.engine.chamber_volumes import Chambers
from turgor.core.engine.system import System
from turgor.core.materials.laws.laws import NeoHooke
from turgor.core.materials.material import Material
from turgor.core.meshing.mesh import Mesh
from turgor.core.model.model import Model
from turgor.core.model.supports import Displacement, Fixed

RUBBER = Material(name="rubber", law=NeoHooke(C10=0.1e6))


def slice_of_tube():
    """A quarter of a slice, 1 mm of it above a mirror plane; the cavity ends at the plane z1."""
    made = meshes.tube_sector(5e-3, 7e-3, 1e-3, (2, 3, 1))
    faces = {"symmetry_z" if name == "z0" else name: sides for name, sides in made.faces.items()}
    return Mesh(points=made.points, cells=made.cells, regions=made.regions, faces=faces)


def moved(points, load_factor):
    return points * [0, 0, 0.3 * load_factor]


CASES = {  # mesh, cavities, supports, volumes [m³]
    "sphere": (meshes.sphere_octant(10e-3, 15e-3, 2, 2), ["cavity"], [], [4 / 3 * np.pi * 1e-6]),
    "slice": (slice_of_tube(), ["cavity"], [Displacement("z1", moved, "z")], [np.pi * 25e-6 * 2e-3]),
    "blind tube": (meshes.blind_tube(), ["cavity"], [Fixed("x1")], [3.0]),
    "two": (meshes.two_cavities(), ["cavity_1", "cavity_2"], [Fixed("x0")], [2.4e-7, 2.4e-7]),
}


@pytest.fixture(params=CASES)
def case(request):
    mesh, names, supports, volumes = CASES[request.param]
    system = System(Model(mesh, {"body": RUBBER}, supports, []), tuple(names))
    return request.param, system, Chambers(system, names), volumes


def test_volumes_are_those_of_the_whole_actuator(case, record_verification):
    name, system, chambers, volumes = case
    result = chambers.volumes(np.zeros(system.size)) * system.length**3
    record_verification(f"{name}: volumes of the cavities at rest [m³]", "V24, exact", volumes, result, "1e-3")
    assert result == pytest.approx(volumes, rel=1e-3)


def test_gradients_are_the_slopes_of_the_volumes(case, record_verification):
    """Mirror planes and fixed faces stay; planes that are moved by a support do move."""
    name, system, chambers, _ = case
    rng = np.random.default_rng(1)
    stay = system.prescribed & np.isclose(_prescribed(system), 0.0)
    unknowns, change = (np.where(stay, 0.0, rng.normal(size=system.size)) for _ in range(2))
    step = 1e-5
    there = 0.02 * unknowns
    slope = (chambers.volumes(there + step * change) - chambers.volumes(there - step * change)) / (2 * step)
    error = np.abs(chambers.gradients(there) @ change / slope - 1).max()
    claim = f"{name}: gradients of the volumes along a random direction against differences"
    record_verification(claim, "V24", 0.0, error, "1e-7")
    assert error < 1e-7


@pytest.mark.parametrize("name", ["sphere", "slice", "two"])
def test_a_pressure_pushes_along_the_gradient(name, record_verification):
    """Not so at an opening whose rim is free: the cap over it moves with the rim, and no pressure acts on it."""
    mesh, names, supports, _ = CASES[name]
    system = System(Model(mesh, {"body": RUBBER}, supports, []), tuple(names))
    gradients = Chambers(system, names).gradients(np.zeros(system.size))
    forces = system.terms.unit_forces(system.points, len(names))
    pushed = np.array([mesh.symmetry_factor * system.joined(force) for force in forces])
    worst = np.abs(pushed - gradients)[:, ~system.prescribed].max()
    claim = f"{name}: force of a unit pressure against the gradient of the volume, largest difference"
    record_verification(claim, "V24, exact", 0.0, worst, "1e-12")
    assert worst < 1e-12


def _prescribed(system):
    out = np.zeros(system.size)
    out[system.prescribed] = system.prescribed_values(1.0)
    return out
