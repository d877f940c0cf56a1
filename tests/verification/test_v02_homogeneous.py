"""V02: the finite elements give the exact stress of homogeneous tests, for three laws.

Problem: cube of irregular cells in uniaxial, equibiaxial and planar tension and compression and in simple shear;
the pull is the reaction on the moved face over the initial area. Elastosil M4601: neo-Hookean C10 = 0.12 MPa, or
Yeoh 0.11 and 0.02 MPa; Dragon Skin 30: Mooney–Rivlin 1.190 and 23.028 kPa, nearly all of it in the second
invariant.
Exact: nominal stresses of the table (review Eqs. 14 and 15 with Eq. 16), shear 12, 11 and 22 Cauchy stresses.
Source: verification case V02, computed there by two routes.
Tolerance: 5e-6 against the table, half a unit of its sixth digit; 1e-8 against `materials.homogeneous`, since the
elements hold linear fields exactly. In planar tension the force that holds the width is tested as well.
"""

import numpy as np
import pytest

import meshes
import problems
import turgor as tg
from turgor.materials.homogeneous import equibiaxial, nominal_stress, planar, uniaxial

A, B = problems.NEO_HOOKE, problems.YEOH
C = tg.MooneyRivlin(C10=1.190e3, C01=23.028e3)
TENSION = np.array([1.2, 1.5, 2.0, 3.0])
TABLE = [  # law, name, moved faces, held faces, stress [MPa] at 0.7, then at TENSION
    (A, uniaxial, ("x1",), (), [-0.321796, 0.121333, 0.253333, 0.420000, 0.693333]),
    (A, equibiaxial, ("x1", "y1"), (), [-1.25998, 0.191549, 0.328395, 0.472500, 0.719012]),
    (A, planar, ("x1",), ("y1",), [-0.531708, 0.149111, 0.288889, 0.450000, 0.711111]),
    (B, uniaxial, ("x1",), (), [-0.332216, 0.115536, 0.281481, 0.665000, 2.17630]),
    (B, equibiaxial, ("x1", "y1"), (), [-2.05583, 0.198717, 0.486849, 1.23047, 4.25712]),
    (B, planar, ("x1",), ("y1",), [-0.581479, 0.143368, 0.331687, 0.750000, 2.33745]),
    (C, uniaxial, ("x1",), (), [-0.0914092, 0.0206064, 0.0349220, 0.0444640, 0.0512258]),
    (C, equibiaxial, ("x1", "y1"), (), [-0.130972, 0.0548315, 0.145049, 0.367377, 1.24894]),
    (C, planar, ("x1",), ("y1",), [-0.107308, 0.0300931, 0.0583026, 0.0908175, 0.143514]),
]
SHEAR = [
    (A, [(0.12, 0.06, 0.0), (0.24, 0.24, 0.0), (0.48, 0.96, 0.0)]),
    (B, [(0.12, 0.06, 0), (0.30, 0.30, 0), (1.08, 2.16, 0)]),
    (C, [(0.024218, 0.000595, -0.011514), (0.048436, 0.00238, -0.046056), (0.096872, 0.00952, -0.184224)]),
]


def _irregular_cube():
    mesh = meshes.box((1.0, 1.0, 1.0), (2, 2, 2))
    inside = np.setdiff1d(np.arange(len(mesh.points)), meshes.surface(mesh))
    points = mesh.points.copy()
    points[inside] += np.random.default_rng(7).uniform(-0.03, 0.03, (len(inside), 3))
    return meshes.with_points(mesh, points)


def _states(law, moved, held, stretches):
    """Equilibria at the given stretches of the moved faces, all on one path."""
    final = stretches[-1]
    mesh = _irregular_cube()
    supports = [tg.Fixed("x0", "x"), tg.Fixed("y0", "y"), tg.Fixed("z0", "z")]
    supports += [tg.Fixed(face, face[0]) for face in held]
    supports += [tg.Displacement(face, lambda X, t: (final - 1) * t * X, face[0]) for face in moved]
    at = tuple((s - 1) / (final - 1) for s in stretches)
    solution = problems.solve(problems.one_material(mesh, law, supports=supports), tg.Static(at=at, tolerance=1e-10))
    return [problems.state_at(solution, factor) for factor in at]


@pytest.mark.parametrize(("law", "deformation", "moved", "held", "expected"), TABLE)
def test_pull_of_tension_and_compression(law, deformation, moved, held, expected, record_verification):
    states = _states(law, moved, held, [0.7]) + _states(law, moved, held, list(TENSION))
    stretches = [0.7, *TENSION]
    got = np.array([problems.reaction(state, "x1")[0] for state in states])
    exact = nominal_stress(law, deformation(stretches))
    record_verification(
        claim=f"{deformation.__name__} nominal stress of {type(law).__name__} at 0.7, 1.2, 1.5, 2, 3 [MPa]",
        source="V02, exact",
        expected=expected,
        got=[round(float(s), 7) for s in got / problems.MPA],
        tolerance="5e-6",
    )
    assert got / problems.MPA == pytest.approx(expected, rel=5e-6)
    assert got == pytest.approx(exact[:, 0, 0], rel=1e-8)
    for face in (*moved[1:], *held):
        lateral = [problems.reaction(state, face)[1] for state in states]
        assert lateral == pytest.approx(exact[:, 1, 1], rel=1e-8)


@pytest.mark.parametrize(("law", "expected"), SHEAR)
def test_simple_shear(law, expected, record_verification):
    amounts = (0.5, 1.0, 2.0)
    sides = [
        tg.Displacement(face, lambda X, t: 2 * t * X[:, [1]] * [1.0, 0, 0], "xy") for face in ("x0", "x1", "y0", "y1")
    ]
    model = problems.one_material(_irregular_cube(), law, supports=[*sides, tg.Fixed("z0", "z")])
    solution = problems.solve(model, tg.Static(at=(0.25, 0.5), tolerance=1e-10))
    for amount, (shear, first, second) in zip(amounts, expected, strict=True):
        stress = problems.fields(problems.state_at(solution, amount / 2)).cauchy / problems.MPA
        record_verification(
            claim=f"simple shear of {type(law).__name__}, γ = {amount}: σ₁₂, σ₁₁, σ₂₂ [MPa]",
            source="V02, exact",
            expected=[shear, first, second],
            got=[round(float(stress[..., i, j].mean()), 8) + 0.0 for i, j in ((0, 1), (0, 0), (1, 1))],
            tolerance="1e-8 at every quadrature point",
        )
        exact = np.array([[first, shear, 0], [shear, second, 0], [0, 0, 0]])
        assert np.abs(stress - exact).max() < 1e-8
        assert np.abs(stress[..., 0, 0] - stress[..., 1, 1] - amount * stress[..., 0, 1]).max() < 1e-8
