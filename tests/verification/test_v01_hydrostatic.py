"""V01.3: the same follower pressure on all faces of a body squeezes it evenly and does not deform an incompressible one.

Problem: a cube, and a hollow cube with the same pressure in its cavity; held at three nodes against rigid motion only.
Exact: σ = −p 1 everywhere; incompressible: no displacement; with the volume energy ½ κ (J − 1)²: J = 1 − p/κ, so
u = (J^⅓ − 1) X.
Source: verification case V01. Tolerance: 1e-9 (stress relative to p, displacement relative to the side): round-off and
the Newton tolerance of 1e-12.
"""

import numpy as np
import pytest
import turgor as tg

import meshes
import problems

P = 5e4


def _pinned(mesh):
    """Supports at three nodes that stop the six rigid motions and nothing else; the node at the origin stays."""
    names = {f"pin{k}": meshes.single_node(meshes.node_at(mesh, c)) for k, c in enumerate(np.vstack([0 * np.eye(3)[:1], np.eye(3)[:2]]))}
    supports = [tg.Fixed("pin0", "xyz"), tg.Fixed("pin1", "yz"), tg.Fixed("pin2", "z")]
    return meshes.with_faces(mesh, **names), supports


@pytest.mark.parametrize("mesh", [meshes.box((1.0, 1.0, 1.0), (2, 2, 2)), meshes.hollow_box()], ids=["cube", "hollow"])
@pytest.mark.parametrize("kappa", [np.inf, 100 * problems.YEOH.shear_modulus])
def test_even_pressure_squeezes_evenly(mesh, kappa, record_verification):
    mesh, supports = _pinned(mesh)
    loads = [tg.Pressure(name, P) for name in mesh.faces if not name.startswith("pin")]
    model = problems.one_material(mesh, problems.YEOH, kappa, supports, loads)
    state = problems.solve(model, tg.Static(first_step=0.5, max_step=0.5, tolerance=1e-12)).states[-1]
    J = 1.0 if np.isinf(kappa) else 1 - P / kappa
    displacement = np.abs(state.displacement - (J ** (1 / 3) - 1) * mesh.points).max()
    stress = problems.fields(state).cauchy
    record_verification(
        claim=f"even pressure on all faces of a {'hollow ' if 'cavity' in mesh.faces else ''}cube, κ/μ = {kappa / 0.22e6:g}: σ₁₁ [Pa]",
        source="V01, σ = −p 1",
        expected=-P,
        got=float(stress[..., 0, 0].mean()),
        tolerance="1e-9",
    )
    assert displacement < 1e-9
    assert np.abs(stress + P * np.eye(3)).max() < 1e-9 * P
    assert state.mean_stress == pytest.approx(-P, rel=1e-9)
    assert np.abs(state.nodal_force).max() < 1e-9 * P
