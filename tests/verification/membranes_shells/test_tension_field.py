"""A sheet that wrinkles bears the tension field of its boundary: an annulus pulled inwards, a strip in shear.

Both sheets lie on a rubber so thin and soft that it bears less than 0.3 % of the force, and stay in their plane.

Annulus of radii a and b, ν = 0: the outer edge is held, the inner one pulled inwards by a tenth of its radius. The hoop
strain is negative everywhere, so wrinkles run along the radii. Exact: only the radial stretch λ(r) bears force, with
Green's strain Y h λ (λ² − 1)/2 = C / r; C follows from ∫ (λ − 1) dr = −u(a). In a membrane that bears compression hoops
resist too, and the outer edge gets 15 % less of the force (measured; the test fails).

Strip sheared by γ = 0.3, ν = 0.3: principal strains e = γ²/4 ± γ √(1 + γ²/4)/2, the second below −ν times the first.
Exact: S = Y h e₁ n ⊗ n, hence a traction S₁₂ + γ S₂₂ along the edge and S₂₂ across it.

Source: Pipkin 1986; Steigmann 1990. Tolerance: 1 % of the force.
"""

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq

import meshes
import problems
import turgor as tg
from turgor.core.meshing.cells import HEXAHEDRON, TETRAHEDRON
from turgor.units import MPa, deg, kPa, mm

THIN, YOUNG, THICKNESS = 0.05 * mm, 1 * MPa, 0.1 * mm
FLAT = tg.Fixed("z0", "z")


def _film(nu):
    film = tg.Material(name="film", law=tg.laws.Hooke(E=YOUNG, nu=nu))
    return tg.Membrane(film, THICKNESS, compression=0.0)


def _solved(mesh, film, supports):
    materials = {"body": problems.rubber(tg.laws.NeoHooke(C10=0.5 * kPa)), "z1": film}
    return problems.solve(tg.Model(mesh, materials, [FLAT, *supports], []))


A, B, INWARDS = 10 * mm, 30 * mm, 1 * mm


def _radial(points, factor):
    radius = np.linalg.norm(points[:, :2], axis=1, keepdims=True)
    return -INWARDS * factor * points * (1, 1, 0) / radius


def _stretch(force):
    """λ of λ (λ² − 1)/2 = force."""
    return brentq(lambda s: s * (s**2 - 1) / 2 - force, 1, 2)


def _annulus():
    """C of the exact tension field [N]."""
    stiffness = YOUNG * THICKNESS
    longer = lambda C: quad(lambda r: _stretch(C / (stiffness * r)) - 1, A, B)[0]  # noqa: E731
    return brentq(lambda C: longer(C) - INWARDS, 1e-6, 1)


def _pull():
    """Force per radian on the outer edge of a quarter of the annulus [N]."""
    mesh = meshes.tube_sector(A, B, THIN, (6, 8, 1))
    cuts = [tg.supports.Symmetry("symmetry_x"), tg.supports.Symmetry("symmetry_y")]
    supports = [*cuts, tg.Displacement("cavity", _radial, "xy"), tg.Fixed("outside", "xy")]
    solution = _solved(mesh, _film(0.0), supports)
    return float(problems.reaction(solution.states[-1], "outside")[0]), solution  # ∫ cos over a quarter is 1


def test_annulus_pulled_inwards(record_verification):
    expected, (got, solution) = _annulus(), _pull()
    record_verification(
        claim="wrinkled annulus pulled inwards: radial force per angle [N]",
        source="tension field, exact",
        expected=expected,
        got=got,
        tolerance="1 %",
    )
    assert got == pytest.approx(expected, rel=0.01)
    assert sum(step.iterations for step in solution.steps) < 40


GAMMA = 0.3


def _sheared(points, factor):
    return GAMMA * factor * points[:, [1, 0, 0]] * (1, 0, 0)


@pytest.mark.parametrize("kind", [TETRAHEDRON, HEXAHEDRON], ids=["tetrahedra", "hexahedra"])
def test_strip_in_shear(kind, record_verification):
    """All edges follow the homogeneous shear; what is inside is free."""
    size = (40 * mm, 20 * mm)
    mesh = meshes.box((*size, THIN), (6, 3, 1), kind=kind)
    edges = [tg.Displacement(side, _sheared, "xy") for side in ("x0", "x1", "y0", "y1")]
    state = _solved(mesh, _film(0.3), edges).states[-1]
    mean, radius = GAMMA**2 / 4, GAMMA * np.sqrt(1 + GAMMA**2 / 4) / 2
    angle = 0.5 * np.arctan2(GAMMA / 2, -mean)  # of the first principal strain
    S12, S22 = YOUNG * THICKNESS * (mean + radius) * np.sin(angle) * np.array([np.cos(angle), np.sin(angle)])
    expected = [S12 + GAMMA * S22, S22]
    got = _traction(state, size)
    record_verification(
        claim=f"strip in shear by 0.3, {kind.name}: force per width along and across the edge [N/m]",
        source="tension field, exact",
        expected=expected,
        got=got,
        tolerance="1 %",
    )
    assert got == pytest.approx(expected, rel=0.01)


def _traction(state, size):
    """Mean nominal force per width on the edges normal to y, (2,) [N/m]: ∫ y f / area over all edges."""
    mesh = state.model.mesh
    nodes = np.unique(np.concatenate([mesh.face_nodes(side) for side in ("x0", "x1", "y0", "y1")]))
    return (state.nodal_force[nodes][:, :2] * mesh.points[nodes, 1:2]).sum(axis=0) / (size[0] * size[1])


@pytest.mark.slow
def test_a_stiff_film_does_not_stop_the_path(record_verification):
    """A chamber of 8 × 8 mm in Ecoflex above a film of 0.5 mm and 4.1 GPa, as in Moseley et al. 2016, up to 30 kPa.

    The film is 20,000 times as stiff as the rubber of one edge. As a membrane it wrinkles from 3 kPa on: modes become
    unstable, and half a thousand iterations end at 15 kPa. As a tension field it takes 45 iterations, where 97 were
    needed if it is linearized about its strain alone, and 68 if its stress and strain
    start from a quartic. The reference is the angle with a toe of 1e-4, a hundredth of
    the usual one. Tolerance: 2 % for the longer toe.
    """
    walls = dict.fromkeys(("wall", "side_wall", "top_wall", "end_wall"), 7 * mm)
    channel = dict.fromkeys(("channel_width", "channel_height"), 2 * mm)
    sizes = {"floor": 1 * mm, "base": 1 * mm, "chambers": 1, "length": 16 * mm, "width": 22 * mm, "height": 17 * mm}
    part = tg.actuators.SlowPneuNet(**walls, **channel, **sizes)
    ecoflex = tg.from_library("ecoflex-00-30", record="ogden-moseley-2016")
    silk = tg.Membrane(tg.Material(name="silk", law=tg.laws.Hooke(E=4100 * MPa, nu=0.3)), 0.5 * mm, compression=0.0)
    materials = {"body": ecoflex, "base": ecoflex, "strain_limiting_layer": silk}
    loads = [tg.Pressure("cavity", 30 * kPa)]
    solution = problems.solve(tg.Model(tg.mesh(part.build(), size=4 * mm), materials, [tg.Fixed("fixed")], loads))
    angle = float(tg.measure(solution, tg.bending_angle, mesh_error=False).column("bending_angle")[-1] / deg)
    record_verification(
        claim="chamber above a stiff film that wrinkles: bending angle at 30 kPa [deg]",
        source="the same with a toe of 1e-4",
        expected=2.169,
        got=angle,
        tolerance="2 %",
    )
    assert angle == pytest.approx(2.169, rel=0.02)
    assert sum(step.iterations for step in solution.steps) < 60
