"""V10: any bulk modulus, up to infinite, gives the exact radius, and a stiffer one never makes the answer worse.

Problem: the tube of V05 at 0.05 MPa and the sphere of V04 at 0.10 MPa, neo-Hookean (C10 = 0.12 MPa) with the volume
energy ½ κ (J − 1)², κ/μ from 20 to infinite. Value: inner stretch a/A.
Exact: the one-dimensional boundary value problems, solved to seven digits.
Tolerance: 0.02 % on meshes of 3 and 4 elements through the wall. A tolerance of 0.1 % would hide an error of 5 % in κ;
the meshes are good to 0.006 %. Locking: on meshes with one and two elements through the wall the error at any κ may be
at most 5 % more than at κ = 20 μ, beside 1e-6, one unit of the last digit of `STRETCH`; elements that lock lose most of
the motion at κ = 5000 μ.
"""

import numpy as np
import pytest

import meshes
import problems
import turgor as tg

MM, MPA = problems.MM, problems.MPA
RATIOS = (20.0, 74 / 3, 50.0, 100.0, 500.0, 1000.0, 5000.0, np.inf)  # κ/μ
STRETCH = {
    "tube": (1.388814, 1.384854, 1.376254, 1.372066, 1.368713, 1.368294, 1.367958, 1.367874),
    "sphere": (1.303072, 1.298812, 1.289892, 1.285699, 1.282410, 1.282003, 1.281678, 1.281597),
}


def _stretch(body, ratio, through):
    law = problems.NEO_HOOKE
    if body == "tube":
        mesh, pressure, axes = meshes.tube_sector(5 * MM, 7 * MM, 1 * MM, (through, 2 * through, 1)), 0.05 * MPA, (0, 1)
        inner, supports = 5 * MM, problems.PLANE_STRAIN
    else:
        around = (through + 1) // 2
        mesh, pressure, axes = meshes.sphere_octant(10 * MM, 15 * MM, around, through), 0.10 * MPA, (0, 1, 2)
        inner, supports = 10 * MM, ()
    model = problems.one_material(mesh, law, ratio * law.shear_modulus, supports, [tg.Pressure("cavity", pressure)])
    state = problems.solve(model, tg.Static(first_step=0.25, tolerance=1e-8)).states[-1]
    return problems.mean_radius(state, "cavity", axes) / inner


@pytest.mark.parametrize("body", STRETCH)
def test_radius_at_any_bulk_modulus(body, record_verification):
    results = [_stretch(body, ratio, 3 if body == "tube" else 4) for ratio in RATIOS]
    record_verification(
        claim=f"{body}, κ/μ = 20, 24.67, 50, 100, 500, 1000, 5000, ∞: inner stretch",
        source="V10, exact",
        expected=STRETCH[body],
        got=results,
        tolerance="0.02 %",
    )
    assert results == pytest.approx(STRETCH[body], rel=2e-4)


@pytest.mark.parametrize("body", STRETCH)
@pytest.mark.parametrize("through", [1, 2])
def test_coarse_mesh_does_not_lock(body, through, record_verification):
    errors = [abs(_stretch(body, ratio, through) - x) for ratio, x in zip(RATIOS, STRETCH[body], strict=True)]
    allowed = 1.05 * errors[0] + 1e-6
    record_verification(
        claim=f"{body}, {through} through the wall: largest error of the inner stretch over that at κ/μ = 20",
        source="V10, no locking",
        expected="no growth",
        got=max(errors) / errors[0],
        tolerance=allowed / errors[0],
    )
    assert max(errors) < allowed
