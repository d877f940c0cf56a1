"""Foams: the finite elements give the exact stress and the exact width of homogeneous tests.

Problem: cube of irregular tetrahedra or of hexahedra in uniaxial, equibiaxial and planar tension and compression
and in simple shear; the pull is the reaction on the moved face over the initial area. Foam of Blatz and Ko, and
hyperfoam of one and of two terms, with Poisson's ratios of 0 and 0.2.
Exact: of one term, uniaxial stress (2 μ/(α λ)) (λ^α − J^(−αβ)) with J = λ^(1 − 2ν), and width λ^(−ν); Blatz–Ko
μ (λ^(−1/2) − λ^(−3)), shear stress μ γ. Otherwise `materials.released`, where the traction across is zero.
Tolerance: 1e-8, since the elements hold linear fields exactly.
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
from turgor.core.materials.laws.laws import BlatzKo, CompressibleNeoHooke, Hyperfoam
from turgor.core.meshing.cells import HEXAHEDRON

BLATZ_KO = BlatzKo(mu=30e3)
ONE_TERM = Hyperfoam.from_abaqus(mu=(20e3,), alpha=(6.0,), nu=(0.2,))
TWO_TERMS = Hyperfoam.from_abaqus(mu=(20e3, 5e3), alpha=(8.0, -2.0), nu=(0.0, 0.2))
LAWS = [BLATZ_KO, ONE_TERM, TWO_TERMS]
MODES = [(uniaxial, ("x1",), ()), (equibiaxial, ("x1", "y1"), ()), (planar, ("x1",), ("y1",))]


def _cube(kind):
    if kind is HEXAHEDRON:  # curved cells of this kind are integrated approximately
        return meshes.box((1.0, 1.0, 1.0), (2, 2, 2), kind=kind)
    mesh = meshes.box((1.0, 1.0, 1.0), (2, 2, 2))
    inside = np.setdiff1d(np.arange(len(mesh.points)), meshes.surface(mesh))
    points = mesh.points.copy()
    points[inside] += np.random.default_rng(7).uniform(-0.02, 0.02, (len(inside), 3))
    return meshes.with_points(mesh, points)


def _state(law, moved, held, stretch, kind=None):
    supports = [tg.Fixed("x0", "x"), tg.Fixed("y0", "y"), tg.Fixed("z0", "z")]
    supports += [tg.Fixed(face, face[0]) for face in held]
    supports += [tg.Displacement(face, lambda X, t: (stretch - 1) * t * X, face[0]) for face in moved]
    solution = problems.solve(problems.one_material(_cube(kind), law, supports=supports), tg.Static(tolerance=1e-10))
    return solution.states[-1]


def _width(state):
    points = state.model.mesh.points
    top = points[:, 2].argmax()
    return float(points[top, 2] + state.displacement[top, 2])


@pytest.mark.parametrize("kind", [None, HEXAHEDRON], ids=["tetrahedra", "hexahedra"])
@pytest.mark.parametrize(("law", "mu", "alpha", "nu"), [(BLATZ_KO, 30e3, -2.0, 0.25), (ONE_TERM, 20e3, 6.0, 0.2)])
@pytest.mark.parametrize("stretch", [0.5, 1.6])
def test_uniaxial_test_has_the_closed_form(law, mu, alpha, nu, stretch, kind, record_verification):
    state = _state(law, ("x1",), (), stretch, kind)
    J, beta = stretch ** (1 - 2 * nu), nu / (1 - 2 * nu)
    exact = 2 * mu / (alpha * stretch) * (stretch**alpha - J ** (-alpha * beta))
    got = problems.reaction(state, "x1")[0]
    record_verification(
        claim=f"uniaxial nominal stress of {type(law).__name__} at {stretch} [MPa], and width",
        source="closed form",
        expected=[exact / problems.MPA, stretch**-nu],
        got=[got / problems.MPA, _width(state)],
        tolerance="1e-8",
    )
    assert got == pytest.approx(exact, rel=1e-8)
    assert _width(state) == pytest.approx(stretch**-nu, rel=1e-8)


@pytest.mark.parametrize(("deformation", "moved", "held"), MODES)
@pytest.mark.parametrize("stretch", [0.6, 1.5])
def test_pull_of_two_terms(deformation, moved, held, stretch, record_verification):
    state = _state(TWO_TERMS, moved, held, stretch)
    exact = nominal_stress(TWO_TERMS, deformation(stretch))
    got = problems.reaction(state, "x1")[0]
    record_verification(
        claim=f"{deformation.__name__} nominal stress of a hyperfoam of two terms at {stretch} [MPa]",
        source="derived from the energy",
        expected=exact[0, 0] / problems.MPA,
        got=got / problems.MPA,
        tolerance="1e-8",
    )
    assert got == pytest.approx(exact[0, 0], rel=1e-8)
    for face in (*moved[1:], *held):
        assert problems.reaction(state, face)[1] == pytest.approx(exact[1, 1], rel=1e-8)


@pytest.mark.parametrize("stretch", [0.6, 1.5])
def test_strain_along_one_axis_of_the_compressible_neo_hookean_law(stretch, record_verification):
    """No side moves across: P = μ (λ − 1/λ) + Λ ln λ/λ with Λ = 2 μν/(1 − 2ν)."""
    law, nu = CompressibleNeoHooke(mu=20e3, nu=0.3), 0.3
    state = _state(law, ("x1",), ("y1", "z1"), stretch)
    lame = 2 * 20e3 * nu / (1 - 2 * nu)
    along = 20e3 * (stretch - 1 / stretch) + lame * np.log(stretch) / stretch
    got = [problems.reaction(state, "x1")[0], problems.reaction(state, "y1")[1]]
    record_verification(
        claim=f"nominal stresses of the compressible neo-Hookean law at a strain along one axis, {stretch} [MPa]",
        source="closed form",
        expected=[along / problems.MPA, lame * np.log(stretch) / problems.MPA],
        got=[each / problems.MPA for each in got],
        tolerance="1e-8",
    )
    assert got == pytest.approx([along, lame * np.log(stretch)], rel=1e-8)


def test_simple_shear_and_its_fields(record_verification):
    """The shear stress of Blatz and Ko's law is μ γ; the mean stress of the fields is that of the law."""
    sides = [tg.Displacement(face, lambda X, t: t * X[:, [1]] * [1.0, 0, 0], "xy") for face in ("x0", "x1", "y0", "y1")]
    model = problems.one_material(_cube(None), BLATZ_KO, supports=[*sides, tg.Fixed("z0", "z")])
    state = problems.solve(model, tg.Static(tolerance=1e-10)).states[-1]
    fields, exact = problems.fields(state), cauchy_stress(BLATZ_KO, simple_shear(1.0))
    worst = np.abs(fields.cauchy - exact).max() / np.abs(exact).max()
    record_verification("simple shear of Blatz–Ko, γ = 1: worst error of the stress", "energy", 0.0, worst, "1e-8")
    assert worst < 1e-8
    assert nominal_stress(BLATZ_KO, simple_shear(1.0))[0, 1] == pytest.approx(30e3, rel=1e-9)
    assert fields.mean_stress == pytest.approx(np.trace(exact) / 3, rel=1e-8)
    assert fields.von_mises == pytest.approx(
        np.sqrt(1.5 * ((exact - np.trace(exact) / 3 * np.eye(3)) ** 2).sum()), rel=1e-8
    )


def test_work_of_a_squeezed_block_is_its_energy():
    """A foam block pressed between plates that it sticks to: the work of the plate is the stored energy."""
    mesh = meshes.box((1.0, 1.0, 0.5), (2, 2, 2), kind=HEXAHEDRON)
    at = tuple(np.linspace(0.05, 1.0, 20))
    push = tg.Displacement("z1", lambda X, t: -0.2 * t * np.ones((len(X), 1)) * [0, 0, 1.0], "xyz")
    model = problems.one_material(mesh, TWO_TERMS, supports=[tg.Fixed("z0"), push])
    states = problems.solve(model, tg.Static(at=at)).states
    forces = [
        0.0,
        *(problems.reaction(problems_state, "z1")[2] for problems_state in states if problems_state.load_factor),
    ]
    depths = [0.0, *(-0.2 * each.load_factor for each in states if each.load_factor)]
    work = np.trapezoid(forces, depths)
    assert problems.energy(states[-1]) == pytest.approx(work, rel=2e-3)
