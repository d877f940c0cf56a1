"""V02: the finite elements give the exact stress of homogeneous tests, for every law.

Problem: cube of irregular cells in uniaxial, equibiaxial and planar tension and compression and in simple shear; the
pull is the reaction on the moved face over the initial area. Elastosil M4601: neo-Hookean C10 = 0.12 MPa, or Yeoh 0.11
and 0.02 MPa; Dragon Skin 30: Mooney–Rivlin 1.190 and 23.028 kPa, nearly all of it in the second invariant; Smooth-Sil
950 and Ecoflex 00-10: generalized Rivlin; Ecoflex 00-30: Ogden of three terms, its constants read in both conventions.
Gent, Arruda–Boyce and the extended tube are not in `TABLE`: for them `materials.homogeneous` is the exact answer.
Exact: nominal stresses in `TABLE` (review Eqs. 11 to 15 with Eq. 16), shear 12, 11 and 22 Cauchy stresses.
Source: `TABLE` and `SHEAR` were computed by two independent routes.
Tolerance: 5e-6 against `TABLE`, half a unit of its sixth digit; 1e-8 against `materials.homogeneous`, since the
elements hold linear fields exactly. In planar tension the force that holds the width is tested as well.
"""

import numpy as np
import pytest

import meshes
import problems
import turgor as tg
from turgor.core.materials.laws.homogeneous import (
    cauchy_stress,
    equibiaxial,
    nominal_stress,
    planar,
    simple_shear,
    uniaxial,
)
from turgor.core.materials.laws.laws import ArrudaBoyce, ExtendedTube, GeneralizedRivlin, Gent, Ogden, YeohN

A, B = problems.NEO_HOOKE, problems.YEOH
C = tg.laws.MooneyRivlin(C10=1.190e3, C01=23.028e3)
E = GeneralizedRivlin.from_names({"C10": 279.3e3, "C01": 10.5e3, "C20": 59.1e3})
F = GeneralizedRivlin.from_names({"C10": -7.48e3, "C01": 19.6e3, "C20": -198.0, "C02": -539.0, "C11": 3.21e3})
PRINTED = {"mu": (24361.0, 66.703, 453.81), "alpha": (1.7138, 7.0679, -3.3659)}
G_ABAQUS, G_CANONICAL = Ogden.from_abaqus(**PRINTED), Ogden(**PRINTED)
TUBE = ExtendedTube(Gc=4e4, Ge=6e4, delta=0.1, beta=0.4)
FOUR_TERMS = YeohN(coefficients=(4e4, -900.0, 60.0, -0.5))
UNLISTED = [Gent(mu=8e4, Jm=30.0), ArrudaBoyce(mu=8e4, locking_stretch=2.5), TUBE, FOUR_TERMS]
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
    (E, uniaxial, ("x1",), (), [-0.899238, 0.303999, 0.749972, 1.82333, 6.18684]),
    (F, uniaxial, ("x1",), (), [-0.0609015, 0.00941825, 0.0162793, 0.0282686, 0.0717335]),
    (F, planar, ("x1",), ("y1",), [-0.0653355, 0.0158865, 0.0374466, 0.0871819, 0.280246]),
    (G_ABAQUS, uniaxial, ("x1",), (), [-0.0342539, 0.0123488, 0.0251093, 0.0404641, 0.0739755]),
    (G_ABAQUS, equibiaxial, ("x1", "y1"), (), [-0.121291, 0.0203997, 0.0361799, 0.0608894, 0.223290]),
    (G_CANONICAL, uniaxial, ("x1",), (), [-0.0268876, 0.0102456, 0.0213130, 0.0369949, 0.101633]),
]
SHEAR = [
    (A, [(0.12, 0.06, 0.0), (0.24, 0.24, 0.0), (0.48, 0.96, 0.0)]),
    (B, [(0.12, 0.06, 0), (0.30, 0.30, 0), (1.08, 2.16, 0)]),
    (E, [(0.31935, 0.154425, -0.00525), (0.816, 0.795, -0.021), (3.0504, 6.0168, -0.084)]),
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


def _sheared_states(law, amounts):
    """Equilibria at the given amounts of shear, the sides moved, on one path."""
    final = amounts[-1]
    sides = [
        tg.Displacement(face, lambda X, t: final * t * X[:, [1]] * [1.0, 0, 0], "xy")
        for face in ("x0", "x1", "y0", "y1")
    ]
    model = problems.one_material(_irregular_cube(), law, supports=[*sides, tg.Fixed("z0", "z")])
    at = tuple(amount / final for amount in amounts)
    solution = problems.solve(model, tg.Static(at=at, tolerance=1e-10))
    return {amount: problems.state_at(solution, factor) for amount, factor in zip(amounts, at, strict=True)}


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


@pytest.mark.parametrize("law", UNLISTED, ids=lambda law: type(law).__name__)
@pytest.mark.parametrize(
    ("deformation", "moved", "held"),
    [(uniaxial, ("x1",), ()), (equibiaxial, ("x1", "y1"), ()), (planar, ("x1",), ("y1",))],
)
def test_pull_of_laws_that_the_table_leaves_out(law, deformation, moved, held, record_verification):
    stretches = [1.2, 1.5, 2.0]
    got = [problems.reaction(s, "x1")[0] for s in _states(law, moved, held, stretches)]
    exact = nominal_stress(law, deformation(stretches))[:, 0, 0]
    record_verification(
        claim=f"{deformation.__name__} nominal stress of {type(law).__name__} at 1.2, 1.5, 2 [MPa]",
        source="derived from the energy",
        expected=(exact / problems.MPA).tolist(),
        got=[float(s) / problems.MPA for s in got],
        tolerance="1e-8",
    )
    assert got == pytest.approx(exact, rel=1e-8)


@pytest.mark.parametrize(
    "law", [G_ABAQUS, F, *UNLISTED], ids=["Ogden", "Rivlin", "Gent", "ArrudaBoyce", "ExtendedTube", "YeohN"]
)
def test_simple_shear_of_laws_that_the_table_leaves_out(law, record_verification):
    """Shear stress and both normal stresses, the third direction being free in both."""
    stress = problems.fields(_sheared_states(law, (1.0,))[1.0]).cauchy
    exact = cauchy_stress(law, simple_shear(1.0))
    worst = np.abs(stress - exact).max() / np.abs(exact).max()
    claim = f"simple shear of {type(law).__name__}, γ = 1: worst error of the stress over the largest"
    record_verification(claim, "derived from the energy", 0.0, worst, "1e-8")
    assert worst < 1e-8


@pytest.mark.parametrize(("law", "expected"), SHEAR)
def test_simple_shear(law, expected, record_verification):
    amounts = (0.5, 1.0, 2.0)
    states = _sheared_states(law, amounts)
    for amount, (shear, first, second) in zip(amounts, expected, strict=True):
        stress = problems.fields(states[amount]).cauchy / problems.MPA
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
