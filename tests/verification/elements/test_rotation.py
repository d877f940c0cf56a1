"""V01.2: a rotation on top of any deformation turns the internal forces and leaves the energy alone.

Problem: a twisted, sheared, pressurized block, incompressible, Yeoh or Ogden, with a membrane on one side; every
position is then turned by 37° about (1, 2, 3).
Exact: force vectors turn with it, their norms, the volume constraints and the energy do not change (objectivity).
Tolerance: 1e-12 relative, round-off of sums over about a thousand terms.
"""

import numpy as np
import pytest

import meshes
import problems
import turgor as tg
from turgor.core.engine.system import System


@pytest.mark.parametrize(("name", "law"), [("Yeoh", problems.YEOH), ("Ogden", problems.OGDEN)])
def test_rotation_turns_forces_and_keeps_energy(name, law, record_verification):
    mesh = meshes.box((0.02, 0.01, 0.01), (2, 1, 1))
    paper = tg.Material(name="paper", law=tg.laws.Hooke(E=6.5e9, nu=0.2))
    model = tg.Model(
        mesh,
        materials={"body": problems.rubber(law), "z0": tg.Membrane(paper, 1e-5)},
        supports=[tg.Fixed("x0")],
        loads=[tg.Pressure("z1", 2e4)],
    )
    rng = np.random.default_rng(3)
    X = mesh.points
    u = 0.3 * np.column_stack([X[:, 1], X[:, 0] * X[:, 2] / 0.02, X[:, 0] ** 2 / 0.02]) + rng.normal(0, 2e-4, X.shape)
    p = rng.normal(0, 5e4, mesh.vertex_count)
    Q = problems.rotation((1, 2, 3), np.radians(37))
    turned = (X + u) @ Q.T - X

    system = System(model)
    forces, energies, volumes = [], [], []
    for displacement in (u, turned):
        unknowns = np.concatenate([displacement.ravel() / system.length, p / system.stress_scale])
        residual = system.residual(unknowns, 1.0)
        forces.append(residual[: 3 * len(X)].reshape(-1, 3))
        volumes.append(residual[3 * len(X) :])
        state = tg.solutions.State(
            model=model, load_factor=1.0, displacement=displacement, mean_stress=p, nodal_force=0 * u
        )
        energies.append(problems.energy(state))

    scale = np.abs(forces[0]).max()
    record_verification(
        claim=f"energy of a deformed block of {name} after a rotation by 37° [J]",
        source="V01, objectivity",
        expected=energies[0],
        got=energies[1],
        tolerance="1e-12",
    )
    assert np.abs(forces[0] @ Q.T - forces[1]).max() < 1e-12 * scale
    assert np.abs(volumes[0] - volumes[1]).max() < 1e-12 * np.abs(volumes[0]).max()
    assert abs(energies[1] / energies[0] - 1) < 1e-12
