"""V01.3: the same follower pressure on all faces of a body squeezes it evenly, an incompressible one not at all.

Problem: a cube, and a hollow cube with the same pressure in its cavity; held at three nodes against rigid motion
only.
Exact: σ = −p 1 everywhere; incompressible: no displacement; with the volume energy ½ κ (J − 1)²: J = 1 − p/κ, so u
= (J^⅓ − 1) X.
Tolerance: 1e-9 (stress relative to p, displacement relative to the side): round-off and the Newton tolerance of 1e-12.
"""

import numpy as np
import pytest

import meshes
import problems
import turgor as tg

P = 5e4


@pytest.mark.parametrize("name", ["cube", "hollow cube"])
@pytest.mark.parametrize("kappa", [np.inf, 100 * problems.YEOH.shear_modulus])
def test_even_pressure_squeezes_evenly(name, kappa, record_verification):
    body = meshes.box((1.0, 1.0, 1.0), (2, 2, 2)) if name == "cube" else meshes.hollow_box()
    mesh, supports = problems.pinned(body)
    loads = [tg.Pressure(face, P) for face in mesh.faces if not face.startswith("pin")]
    model = problems.one_material(mesh, problems.YEOH, kappa, supports, loads)
    state = problems.solve(model, tg.Static(first_step=0.5, max_step=0.5, tolerance=1e-12)).states[-1]
    J = 1.0 if np.isinf(kappa) else 1 - P / kappa
    displacement = float(np.abs(state.displacement - (J ** (1 / 3) - 1) * mesh.points).max())
    stress = float(np.abs(problems.fields(state).cauchy + P * np.eye(3)).max()) / P
    record_verification(
        claim=f"even pressure on all faces of a {name}, κ/μ = {kappa / 0.22e6:g}: worst u / side, worst stress / p",
        source="V01, σ = −p 1",
        expected=[0.0, 0.0],
        got=[displacement, stress],
        tolerance="1e-9",
    )
    assert displacement < 1e-9
    assert stress < 1e-9
    assert state.mean_stress == pytest.approx(-P, rel=1e-9)
    assert np.abs(state.nodal_force).max() < 1e-9 * P
