"""Laws with directions: the finite elements give the stress of fibers in bodies and of prints in homogeneous tests.

Problem: cube of irregular tetrahedra. Holzapfel, Gasser and Ogden's law with one family along the pull in uniaxial
tension, and with two families at ±35° in planar tension; a printed body in uniaxial tension along its strands, and
turned as a whole. Tubes held at their length under pressure, with directions around their axis.
Exact: the derivative of the energy along the path; of a turned body the turned stress; of a tube the integral of
the stress through the wall.
Tolerance: 1e-8, since the elements hold linear fields exactly; 0.2 % of the pressure of a tube.
"""

from math import cos, radians, sin

import numpy as np
import pytest

import meshes
import problems
import turgor as tg
from turgor.core.materials.orientation import Orientation
from turgor.core.materials.oriented import oriented_stress

HGO = tg.laws.HolzapfelGasserOgden(C10=3.8e3, k1=2.4e3, k2=0.84, kappa=0.1)
PRINT = tg.laws.Orthotropic(C10=1e6, C20=2e4, a1=0.4e6, a2=0.1e6, a3=0.1e6)
STRAIGHT = Orientation(along=(1, 0, 0), across=(0, 1, 0))


def _material(law, orientation):
    return tg.Material(name="body", law=law, orientation=orientation)


def _cube():
    mesh = meshes.box((1.0, 1.0, 1.0), (2, 2, 2))
    inside = np.setdiff1d(np.arange(len(mesh.points)), meshes.surface(mesh))
    points = mesh.points.copy()
    points[inside] += np.random.default_rng(7).uniform(-0.03, 0.03, (len(inside), 3))
    return meshes.with_points(mesh, points)


def _pulled(material, stretch, held=()):
    supports = [tg.Fixed("x0", "x"), tg.Fixed("y0", "y"), tg.Fixed("z0", "z")]
    supports += [tg.Fixed(face, face[0]) for face in held]
    supports += [tg.Displacement("x1", lambda X, t: (stretch - 1) * t * X, "x")]
    model = tg.Model(_cube(), {"body": material}, supports, [])
    return problems.solve(model, tg.Static(tolerance=1e-10)).states[-1]


def _slope(law, E, by_stretch):
    """Derivative of the energy of a family by the stretch."""
    return law.k1 * E * np.exp(law.k2 * E**2) * by_stretch


@pytest.mark.parametrize("stretch", [0.7, 1.3, 1.8])
def test_one_family_along_the_pull(stretch, record_verification):
    """Compressed fibers bear nothing: at 0.7 the body alone does, since E < 0."""
    k = HGO.kappa
    E = k * (stretch**2 + 2 / stretch - 3) + (1 - 3 * k) * (stretch**2 - 1)
    own = 2 * HGO.C10 * (stretch - stretch**-2)
    exact = own + (_slope(HGO, E, k * (2 * stretch - 2 / stretch**2) + (1 - 3 * k) * 2 * stretch) if E > 0 else 0.0)
    got = problems.reaction(_pulled(_material(HGO, STRAIGHT), stretch), "x1")[0]
    record_verification(
        claim=f"Holzapfel–Gasser–Ogden, one family along the pull, at {stretch}: nominal stress [kPa]",
        source="derivative of the energy",
        expected=exact / 1e3,
        got=float(got) / 1e3,
        tolerance="1e-8",
    )
    assert got == pytest.approx(exact, rel=1e-8)


def test_two_families_in_planar_tension(record_verification):
    angle, stretch, k = radians(35), 1.6, HGO.kappa
    E = k * (stretch**2 + stretch**-2 - 2) + (1 - 3 * k) * (stretch**2 * cos(angle) ** 2 + sin(angle) ** 2 - 1)
    by = k * (2 * stretch - 2 * stretch**-3) + (1 - 3 * k) * 2 * stretch * cos(angle) ** 2
    exact = 2 * HGO.C10 * (stretch - stretch**-3) + 2 * _slope(HGO, E, by)
    material = _material(HGO, Orientation(along=(1, 0, 0), across=(0, 1, 0), angle=angle))
    got = problems.reaction(_pulled(material, stretch, ("y1",)), "x1")[0]
    record_verification(
        claim="Holzapfel–Gasser–Ogden, two families at ±35°, planar tension of 1.6: nominal stress [kPa]",
        source="derivative of the energy",
        expected=exact / 1e3,
        got=float(got) / 1e3,
        tolerance="1e-8",
    )
    assert got == pytest.approx(exact, rel=1e-8)


def test_a_print_along_its_strands(record_verification):
    """Across the strands it is alike in both directions, so that it contracts alike in them."""
    stretch = 1.4
    I4, across = stretch**2, 1 / stretch
    rubber = (2 * PRINT.C10 + 4 * PRINT.C20 * (stretch**2 + 2 / stretch - 3)) * (stretch - stretch**-2)
    strands = PRINT.a1 * (I4 - 1) * 2 * stretch + 2 * PRINT.a2 * (across - 1) * -(stretch**-2)
    state = _pulled(_material(PRINT, STRAIGHT), stretch)
    got = problems.reaction(state, "x1")[0]
    record_verification(
        claim="print along its strands, uniaxial tension of 1.4: nominal stress [MPa]",
        source="derivative of the energy",
        expected=(rubber + strands) / problems.MPA,
        got=float(got) / problems.MPA,
        tolerance="1e-8",
    )
    assert got == pytest.approx(rubber + strands, rel=1e-8)
    fields = problems.fields(state)
    F = np.diag([stretch, stretch**-0.5, stretch**-0.5])
    assert fields.cauchy[..., 0, 0] == pytest.approx(oriented_stress(_material(PRINT, STRAIGHT), F)[0, 0], rel=1e-8)


def test_stress_turns_with_the_body(record_verification):
    """A sheared block of which shape, shear and directions are turned by 50° has the turned stress."""
    Q, stresses = problems.rotation((0, 0, 1), radians(50)), []
    shear = np.array([[1.0, 0.5, 0], [0, 1, 0], [0, 0, 1]])
    for turn in (np.eye(3), Q):
        along, across = (tuple(turn @ each) for each in ((1.0, 0.4, 0.0), (0.0, 1.0, 0.0)))
        material = _material(PRINT, Orientation(along=along, across=across))
        mesh, H = _cube(), turn @ shear @ turn.T - np.eye(3)
        moved = [tg.Displacement(each, lambda X, t, H=H: t * X @ H.T, "xy") for each in ("x0", "x1", "y0", "y1")]
        model = tg.Model(mesh, {"body": material}, [*moved, tg.Fixed("z0", "z")], [])
        stresses.append(problems.fields(problems.solve(model, tg.Static(tolerance=1e-10)).states[-1]).cauchy)
    worst = float(np.abs(Q @ stresses[0] @ Q.T - stresses[1]).max() / np.abs(stresses[0]).max())
    record_verification("sheared print and the same turned by 50°: worst stress", "objectivity", 0.0, worst, "1e-8")
    assert worst < 1e-8
    assert stresses[0][..., 0, 0] == pytest.approx(
        oriented_stress(_material(PRINT, Orientation(along=(1, 0.4, 0), across=(0, 1, 0))), shear)[0, 0], rel=1e-8
    )


@pytest.mark.parametrize(("law", "angle"), [(HGO, 40.0), (HGO, 0.0), (PRINT, 0.0)])
def test_a_wound_tube_under_pressure(law, angle, record_verification):
    """A tube of constant length: P = ∫ (λ ∂W/∂λ) dr/r through the wall, fibers wound at an angle to the axis."""
    orientation = Orientation(along=(0, 0, 1), around=(0, 0, 0), angle=f"{angle} deg")
    material, pressure = _material(law, orientation), 1.5e3 if law is HGO else 0.3e6
    mesh = meshes.tube_sector(5e-3, 7e-3, 1e-3, (3, 6, 1))
    walls = [tg.Fixed("z0", "z"), tg.Fixed("z1", "z")]
    model = tg.Model(mesh, {"body": material}, walls, [tg.Pressure("cavity", pressure)])
    state = problems.solve(model, tg.Static(tolerance=1e-9)).states[-1]
    inner = problems.mean_radius(state, "cavity", (0, 1))

    R = np.linspace(5e-3, 7e-3, 4001)
    r = np.sqrt(R**2 + inner**2 - R[0] ** 2)
    F = np.zeros((len(R), 3, 3))  # radial, around, along, at a point on the x axis
    F[:, 0, 0], F[:, 1, 1], F[:, 2, 2] = R / r, r / R, 1.0
    sigma = oriented_stress(material, F, (6e-3, 0, 0))
    stress = sigma[:, 1, 1] - sigma[:, 0, 0]
    exact = float(np.trapezoid(stress / r, r))
    record_verification(
        claim=f"tube of {type(law).__name__}, fibers at {angle:g}° to the axis: pressure [Pa]",
        source="integral through the wall",
        expected=exact,
        got=pressure,
        tolerance="0.2 %",
    )
    assert inner > 1.05 * 5e-3
    assert exact == pytest.approx(pressure, rel=2e-3)
