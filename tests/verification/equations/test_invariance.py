"""V22: answers do not depend on the units, the size, the orientation, the numbering or the number of steps.

Problem: a block of Yeoh rubber, κ = 500 μ, 3 × 1 × 1 with a bent axis, clamped at one end, pressure from below and
gravity.
Exact: (1) moduli, pressures and densities times s: same displacements; (2) size times s, density over s: same
stretches; (3) everything turned: the answer turns; (5) nodes and cells in another order: same; (6) numbers in mm, MPa,
N, tonne: the same as in SI; (7) 4, 10 or 40 steps: same end; (8) half of a body and the whole of it: same. (4), the
handedness of fibers, is tested in tests/validation/targets/test_targets_single_wrap.py.
Tolerance: 1e-9 relative for scaling, units, order and half of a body, 1e-8 for rotation and for the number of steps:
what the Newton tolerance of 1e-11 leaves.
"""

import numpy as np
import pytest

import meshes
import problems
import turgor as tg

LAW = tg.Yeoh(C10=0.11e6, C20=0.02e6)
KAPPA, DENSITY, PRESSURE = 500 * LAW.shear_modulus, 1070.0, 3e3


def _solve(mesh, law=LAW, kappa=KAPPA, density=DENSITY, pressure=PRESSURE, gravity=None, procedure=None):
    gravity = gravity or tg.Gravity()
    material = problems.rubber(law, kappa, density)
    model = tg.Model(mesh, {"body": material}, [tg.Fixed("x0")], [tg.Pressure("z0", pressure), gravity])
    return problems.solve(model, procedure or tg.Static(first_step=0.25, tolerance=1e-11)).states[-1]


@pytest.fixture(scope="module")
def base():
    state = _solve(meshes.bent_block())
    assert np.abs(state.displacement).max() > 0.005  # a sixth of the length: far from linear
    return state


def _check(record, claim, got, expected, tolerance):
    error = float(np.abs(got - expected).max() / np.abs(expected).max())
    record(claim=claim, source="V22, exact", expected=0.0, got=error, tolerance=tolerance)
    assert error < tolerance


def test_stiffness_scale(base, record_verification):
    s = 37.0
    law = tg.Yeoh(C10=s * LAW.C10, C20=s * LAW.C20)
    state = _solve(meshes.bent_block(), law, s * KAPPA, s * DENSITY, s * PRESSURE)
    _check(record_verification, "moduli and loads × 37: displacement", state.displacement, base.displacement, 1e-9)
    _check(record_verification, "moduli and loads × 37: mean stress", state.mean_stress / s, base.mean_stress, 1e-9)


def test_size_scale(base, record_verification):
    s, mesh = 0.01, meshes.bent_block()
    state = _solve(meshes.with_points(mesh, s * mesh.points), density=DENSITY / s)
    _check(record_verification, "size × 0.01: displacement over size", state.displacement / s, base.displacement, 1e-9)
    stretch, expected = problems.fields(state).stretch, problems.fields(base).stretch
    _check(record_verification, "size × 0.01: stretch", stretch, expected, 1e-9)
    _check(record_verification, "size × 0.01: force over area", state.nodal_force / s**2, base.nodal_force, 1e-9)


def test_units_of_millimeter_tonne_and_newton(base, record_verification):
    """Any coherent system of units may be fed in: mm, MPa, N, s, tonne gives the numbers of SI times 1000."""
    mesh = meshes.bent_block()
    law = tg.Yeoh(C10=LAW.C10 / 1e6, C20=LAW.C20 / 1e6)
    gravity = tg.Gravity(acceleration=tg.Gravity().acceleration * 1e3)
    millimeter = meshes.with_points(mesh, mesh.points * 1e3)
    state = _solve(millimeter, law, KAPPA / 1e6, DENSITY / 1e12, PRESSURE / 1e6, gravity)
    _check(record_verification, "mm, MPa, tonne: displacement", state.displacement / 1e3, base.displacement, 1e-9)
    _check(record_verification, "mm, MPa, tonne: mean stress", state.mean_stress * 1e6, base.mean_stress, 1e-9)


def test_orientation(base, record_verification):
    Q, mesh = problems.rotation((1, 2, 3), np.radians(37)), meshes.bent_block()
    gravity = tg.Gravity(direction=tuple(Q @ tg.Gravity().direction))
    state = _solve(meshes.with_points(mesh, mesh.points @ Q.T + [0.3, -0.2, 0.1]), gravity=gravity)
    _check(
        record_verification, "turned by 37° and moved: displacement", state.displacement, base.displacement @ Q.T, 1e-8
    )
    _check(record_verification, "turned by 37° and moved: forces", state.nodal_force, base.nodal_force @ Q.T, 1e-8)
    stress, expected = problems.fields(state).cauchy, Q @ problems.fields(base).cauchy @ Q.T
    _check(record_verification, "turned by 37° and moved: Cauchy stress", stress, expected, 1e-8)


def test_numbering(base, record_verification):
    mesh, number = meshes.shuffled(meshes.bent_block(), np.random.default_rng(11))
    state = _solve(mesh)
    _check(record_verification, "other numbering: displacement", state.displacement[number], base.displacement, 1e-9)
    vertices = number[: mesh.vertex_count]
    _check(record_verification, "other numbering: mean stress", state.mean_stress[vertices], base.mean_stress, 1e-9)


@pytest.mark.parametrize("count", [10, 40])
def test_number_of_steps(base, count, record_verification):
    procedure = tg.Static(first_step=1 / count, max_step=1 / count, tolerance=1e-11)
    state = _solve(meshes.bent_block(), procedure=procedure)
    _check(record_verification, f"{count} steps: displacement", state.displacement, base.displacement, 1e-8)
    _check(record_verification, f"{count} steps: mean stress", state.mean_stress, base.mean_stress, 1e-8)


def test_half_model_equals_full_model(record_verification):
    """A half with a mirror plane deforms as the whole does; the whole is built of two mirrored blocks."""

    names = {"x0": "x0", "x1": "x1", "y1": "y1", "z0": "z0", "z1": "z1"}
    size = np.array([0.03, 0.005, 0.01])
    one = meshes.glued([meshes.Block((6, 2, 2), lambda p: p * size, {**names, "y0": "symmetry_y"})])
    right = meshes.Block((6, 2, 2), lambda p: p * size, names)
    left = meshes.Block((6, 2, 2), lambda p: p * size * [1, -1, 1], names, mirrored=True)
    two = meshes.glued([right, left])
    states = [_solve(mesh) for mesh in (one, two)]
    nodes = [meshes.node_at(two, point) for point in one.points]
    expected = states[1].displacement[nodes]
    _check(record_verification, "half model against full model: displacement", states[0].displacement, expected, 1e-9)
    force = 2 * problems.reaction(states[0], "x0")[[0, 2]]
    _check(
        record_verification,
        "half model against full: reaction",
        force,
        problems.reaction(states[1], "x0")[[0, 2]],
        1e-9,
    )
