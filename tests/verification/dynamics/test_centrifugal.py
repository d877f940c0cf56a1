"""Centrifugal force stretches a turning bar as its equation says, and grows with the stretch.

Problem: bar of length 1 between frictionless walls across it (uniaxial strain), its inner end at distance ½ from the
axis; neo-Hookean with κ = 20 μ, density ρ. Equilibrium along the bar: dP/dX + ρ ω² x = 0 with P(1) = 0, P from the
stretch x'. It is solved here as a boundary value problem for ρ ω² = 4 μ, where the end moves by some tenths; the force
at rest alone would give less.
Source: balance of momentum in uniaxial strain; solved by `scipy.integrate.solve_bvp` to 1e-10.
Tolerance: 1e-5 of the end displacement with six hexahedra along the bar, and 2e-3 with six layers of tetrahedra, which
are coarser across it. The force at rest alone would move the end 10 % less.
"""

import numpy as np
import pytest
from scipy.integrate import solve_bvp

import meshes
import problems
import turgor as tg
from refused import refused
from turgor.core.meshing.cells import HEXAHEDRON, TETRAHEDRON

MU, KAPPA, DENSITY = problems.NEO_HOOKE.shear_modulus, 20 * problems.NEO_HOOKE.shear_modulus, 1000.0
SPEED = float(np.sqrt(4 * MU / DENSITY))


def stress(stretch):
    """Nominal stress of uniaxial strain: μ J^(-2/3) (λ² − 1) 2/3 / λ + κ (J − 1), J = λ."""
    return 2 / 3 * MU * stretch ** (-5 / 3) * (stretch**2 - 1) + KAPPA * (stretch - 1)


def slope(stretch):
    """Derivative of `stress`."""
    step = 1e-6
    return (stress(stretch + step) - stress(stretch - step)) / (2 * step)


def exact_end() -> float:
    """Displacement of the outer end."""
    positions = np.linspace(0.5, 1.5, 41)

    def rates(_, y):
        return np.stack([y[1], -DENSITY * SPEED**2 * y[0] / slope(y[1])])

    def ends(inner, outer):
        return np.array([inner[0] - 0.5, outer[1] - 1.0])

    solution = solve_bvp(rates, ends, positions, np.stack([positions, np.ones(41)]), tol=1e-10)
    assert solution.success
    return float(solution.y[0, -1] - 1.5)


@pytest.mark.parametrize(
    ("kind", "tolerance"), [(TETRAHEDRON, 2e-3), (HEXAHEDRON, 1e-5)], ids=["tetrahedra", "hexahedra"]
)
def test_a_turning_bar_is_stretched_as_its_equation_says(kind, tolerance, record_verification):
    mesh = meshes.box((1.0, 0.2, 0.2), (6, 1, 1), lambda points: points + [0.5, 0.0, 0.0], kind=kind)
    supports = [tg.Fixed("x0", "x"), *(tg.Fixed(f"{axis}{end}", axis) for axis in "yz" for end in "01")]
    material = problems.rubber(problems.NEO_HOOKE, KAPPA, DENSITY)
    load = tg.loads.Centrifugal(speed=SPEED, axis=(0, 0, 2))
    solution = problems.solve(tg.Model(mesh, {"body": material}, supports, load), tg.Static(tolerance=1e-11))
    end = float(solution.states[-1].displacement[mesh.face_nodes("x1"), 0].mean())
    expected = exact_end()
    record_verification(
        f"Bar that turns about an axis, {kind.name}s: displacement of its end",
        "boundary value problem",
        f"{expected:.7g} m",
        f"{end:.7g} m",
        f"{tolerance:g}",
    )
    assert end == pytest.approx(expected, rel=tolerance)


def test_a_half_model_needs_its_axis_in_the_mirror_plane():
    mesh = meshes.box((1.0, 0.2, 0.2), (1, 1, 1))
    mesh = meshes.with_faces(mesh, symmetry_y=mesh.face("y0"))
    material = problems.rubber(problems.NEO_HOOKE, KAPPA, DENSITY)
    tg.Model(mesh, {"body": material}, "x0", tg.loads.Centrifugal(speed=1.0, axis=(0, 1, 0), through=(0, 5, 0)))
    tg.Model(mesh, {"body": material}, "x0", tg.loads.Centrifugal(speed=1.0, axis=(0, 0, 1)))
    with refused("mirror plane", "y = 0 mm"):
        tg.Model(mesh, {"body": material}, "x0", tg.loads.Centrifugal(speed=1.0, axis=(0, 0, 1), through=(0, 0.1, 0)))


def test_motion_and_modes_of_a_part_that_turns_are_refused(tmp_path):
    mesh = meshes.box((1.0, 0.2, 0.2), (1, 1, 1))
    material = problems.rubber(problems.NEO_HOOKE, KAPPA, DENSITY)
    model = tg.Model(mesh, {"body": material}, "x0", tg.loads.Centrifugal(speed=1.0, axis=(0, 0, 1)))
    motion = tg.Dynamic(duration=1.0)
    for attempt in (
        lambda: tg.natural_frequencies(model, count=1),
        lambda: tg.solve(model, motion),
        lambda: tg.files.write_inp(model, tmp_path / "a.inp", procedure=motion),
    ):
        with refused("Coriolis"):
            attempt()
