"""V05: a thick incompressible tube held at its length follows the exact curve, with the exact axial force and stress.

Problem: inner radius 5 mm, outer 7 mm, a quarter of a slice between two frictionless walls (λz = 1); neo-Hookean
(C10 = 0.12 MPa) and Yeoh (0.11, 0.02 MPa), inflated to three times the inner radius. Neither curve has a limit
point. Mooney–Rivlin of the same shear modulus (0.10, 0.02 MPa) has the same pressure and another axial force, which
only a right second invariant gives.
Exact: P = ∫ Ŵ′(λ) / (λ² − 1) dλ between the stretches of the walls, Ŵ = W(λ, 1/λ, 1); axial force of the wall N.
Source: Green and Zerna. `exact.tube_pressure` must reproduce `TABLE`, computed independently, to seven digits.
Tolerance: 0.1 % of the inner radius at the tabulated pressure with three curved quadratic elements through the wall,
axial force 0.2 %, stress at quadrature points 1 % of the inner hoop stress (N is an integral of stress). At λ = 2.5 and
3 the neo-Hookean curve is nearly flat (P tends to 0.0807533 MPa): there 0.1 % of radius is 0.01 % of pressure.
"""

import numpy as np
import pytest
from thick_tube import INNER, OUTER, inflate

import exact
import meshes
import problems
import turgor as tg
from turgor.core.solvers.procedures.volume_control import VolumeControl

STRETCHES = (1.05, 1.10, 1.20, 1.30, 1.50, 1.75, 2.00, 2.50, 3.00)
TABLE = {  # law, pressure [MPa], axial force [N]
    "neo-Hookean": (
        problems.NEO_HOOKE,
        (0.01078554, 0.01987406, 0.03412093, 0.04452240, 0.05805014, 0.06732012, 0.07235933, 0.07702820, 0.07887216),
        (0.888898, 1.71287, 3.18670, 4.45863, 6.51663, 8.41165, 9.78743, 11.5839, 12.6544),
    ),
    "Yeoh": (
        problems.YEOH,
        (0.009907197, 0.01836356, 0.03221811, 0.04342805, 0.06185821, 0.08229422, 0.1028582, 0.1487562, 0.2032710),
        (0.816509, 1.58268, 3.00886, 4.34836, 6.93909, 10.2618, 13.8608, 22.2075, 32.2770),
    ),
    "Mooney–Rivlin": (
        tg.laws.MooneyRivlin(C10=0.10 * problems.MPA, C01=0.02 * problems.MPA),
        (0.01078554, 0.01987406, 0.03412093, 0.04452240, 0.05805014),
        (0.903906, 1.77148, 3.41079, 4.94228, 7.76385),
    ),
}


@pytest.mark.parametrize("name", TABLE)
def test_exact_curve_reproduces_the_table(name):
    law, pressures, _ = TABLE[name]
    for stretch, pressure in zip(STRETCHES, pressures, strict=False):
        assert exact.tube_pressure(law, stretch, INNER, OUTER) / problems.MPA == pytest.approx(pressure, rel=5e-7)


@pytest.mark.parametrize("name", TABLE)
def test_radius_and_axial_force(name, record_verification):
    law, pressures, forces = TABLE[name]
    mesh = meshes.tube_sector(INNER, OUTER, 1 * problems.MM, (3, 6, 1))
    states = inflate(law, [p * problems.MPA for p in pressures], mesh)
    radius = [problems.mean_radius(state, "cavity", (0, 1)) / INNER for state in states]
    force = [mesh.symmetry_factor * float(problems.reaction(state, "z1")[2]) for state in states]
    record_verification(
        claim=f"thick tube, {name}, 3 elements through the wall: inner stretch at the tabulated pressures",
        source="V05, exact",
        expected=STRETCHES[: len(radius)],
        got=radius,
        tolerance="0.1 %",
    )
    record_verification(
        claim=f"thick tube, {name}: axial force of the wall [N]",
        source="V05, exact",
        expected=forces,
        got=force,
        tolerance="0.2 %",
    )
    assert radius == pytest.approx(STRETCHES[: len(radius)], rel=1e-3)
    assert force == pytest.approx(forces, rel=2e-3)


def test_stress_and_plane_strain(record_verification):
    """Stress at the quadrature points, λ = 1.5, and how plane the slab stays though its middle nodes are free."""
    mesh = meshes.tube_sector(INNER, OUTER, 1 * problems.MM, (3, 6, 1))
    pressure = 0.05805014 * problems.MPA
    state = inflate(problems.NEO_HOOKE, [0.5 * pressure, pressure], mesh)[-1]
    r, radial, hoop = problems.polar_stress(state, (0, 1))
    stretch = r / np.sqrt(r**2 - (1.5 * INNER) ** 2 + INNER**2)
    outside = 8.958236 * problems.MM / OUTER
    mu = problems.NEO_HOOKE.shear_modulus

    def borne(x):
        return mu * (np.log(x) - 0.5 / x**2)

    exact_radial = borne(outside) - borne(stretch)
    exact_hoop = exact_radial + mu * (stretch**2 - stretch**-2)
    error = np.stack([radial - exact_radial, hoop - exact_hoop]) / (0.3752832 * problems.MPA)
    worst = float(np.abs(error).max())
    out_of_plane = float(np.abs(state.displacement[:, 2]).max() / np.abs(state.displacement[:, :2]).max())
    record_verification(
        claim="thick tube, neo-Hookean, λ = 1.5: worst error of σr and σθ over the inner σθ; motion out of plane",
        source="V05, exact",
        expected=[0.0, 0.0],
        got=[worst, out_of_plane],
        tolerance="0.01, 1e-4",
    )
    assert worst < 0.01
    assert out_of_plane < 1e-4


def test_volume_control_finds_the_pressures(record_verification):
    """The other way around: the volume at the tabulated stretches is injected, and the pressure is the answer."""
    law, pressures, _ = TABLE["neo-Hookean"]
    volumes = [np.pi * INNER**2 * problems.MM * (stretch**2 - 1) for stretch in STRETCHES]
    at = tuple(volume / volumes[-1] for volume in volumes[:-1])
    mesh = meshes.tube_sector(INNER, OUTER, 1 * problems.MM, (3, 6, 1))
    model = problems.one_material(mesh, law, supports=problems.PLANE_STRAIN)
    solution = problems.solve(model, VolumeControl(volume=volumes[-1], at=at, tolerance=1e-8))
    results = [problems.state_at(solution, factor).pressures["cavity"] / problems.MPA for factor in (*at, 1.0)]
    record_verification(
        claim="thick tube, neo-Hookean, volume control: pressures at the tabulated stretches [MPa]",
        source="V05, exact",
        expected=pressures,
        got=results,
        tolerance="0.1 %",
    )
    assert results == pytest.approx(pressures, rel=1e-3)
    assert not solution.limit_points
