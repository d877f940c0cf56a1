"""V23: forces balance, weights are carried, volumes are right, and the work of the pressure is the stored energy.

Exact statements, checked on coarse meshes because they hold on any: (1) pressure in a closed cavity that does not
touch the support has no resultant, so the support carries no force and no moment; (2) where the cavity opens on the
clamped face the support carries pressure times the opening; (3) the support carries the weight; (4) volumes of a
cube and a sphere, wherever they lie; (5) ∫ P dV = stored energy; (6) the tangent of a closed cavity is symmetric.
Tolerance: 1e-8 P·A for reactions (Newton tolerance 1e-11 times the internal forces), 1e-12 for volumes of cubes and
symmetry, 0.1 % for the work over 40 steps by the trapezoidal rule (its own error, tested to fall four times when the
steps are halved).
"""

import numpy as np
import pytest

import meshes
import problems
import turgor as tg
from turgor.core.engine.faces.surfaces import enclosed_volume, vector_area
from turgor.core.engine.system import System

P = 4e4
EXACT = tg.Static(first_step=0.2, tolerance=1e-11)


def _moment(state, face):
    nodes = state.model.mesh.face_nodes(face)
    return np.cross(problems.current(state)[nodes], state.nodal_force[nodes]).sum(axis=0)


def test_closed_cavity_leaves_the_support_alone(record_verification):
    mesh = meshes.hollow_box()
    model = problems.one_material(mesh, problems.YEOH, supports=[tg.Fixed("x0")], loads=[tg.Pressure("cavity", P)])
    states = problems.solve(model, EXACT).states[1:]
    scale = P / 9  # pressure times the wall of the cavity, a third of the side squared
    worst = max(float(np.abs(problems.reaction(state, "x0")).max()) / scale for state in states)
    turning = max(float(np.abs(_moment(state, "x0")).max()) / scale for state in states)
    record_verification(
        claim="closed cavity: force and moment on the support over P·A, at every load",
        source="V23, exact",
        expected=[0.0, 0.0],
        got=[worst, turning],
        tolerance="1e-8",
    )
    assert worst < 1e-8
    assert turning < 1e-8
    assert np.abs(states[-1].nodal_force).max() > 0.01 * scale  # the single nodes of the support do carry force


def test_cavity_open_on_the_support(record_verification):
    mesh = meshes.blind_tube()
    model = problems.one_material(mesh, problems.YEOH, supports=[tg.Fixed("x0")], loads=[tg.Pressure("cavity", P)])
    state = problems.solve(model, EXACT).states[-1]
    opening = vector_area(problems.current(state), mesh.face("cavity"))
    force = problems.reaction(state, "x0")
    record_verification(
        claim="cavity open on the clamped face: axial reaction over pressure times opening",
        source="V23, exact",
        expected=-1.0,
        got=force[0] / P,
        tolerance="1e-8",
    )
    assert force == pytest.approx([-P, 0, 0], abs=1e-8 * P)  # the pressure pushes the blind end towards +x
    assert opening == pytest.approx([-1, 0, 0], abs=1e-12)  # and the opening, clamped, keeps its area of 1


def test_open_cavity_whose_rim_moves(record_verification):
    """Clamped at the far end instead: the opening deforms, and the reaction is pressure times its current area."""
    mesh = meshes.blind_tube()
    model = problems.one_material(mesh, problems.YEOH, supports=[tg.Fixed("x1")], loads=[tg.Pressure("cavity", P)])
    state = problems.solve(model, EXACT).states[-1]
    opening = vector_area(problems.current(state), mesh.face("cavity"))
    force = problems.reaction(state, "x1")
    record_verification(
        claim="cavity open at the free end: axial reaction over pressure times current opening",
        source="V23, exact",
        expected=1.0,
        got=force[0] / (P * opening[0]),
        tolerance="1e-8",
    )
    assert force == pytest.approx(P * opening, abs=1e-8 * P)
    assert abs(opening[0]) > 1.05


def test_support_carries_the_weight(record_verification):
    mesh = meshes.box((0.03, 0.01, 0.02), (3, 1, 2), lambda X: X + 0.1 * X[:, [1, 2, 0]])
    material = problems.rubber(problems.YEOH, density=1070.0)
    model = tg.Model(mesh, {"body": material}, [tg.Fixed("x0")], [tg.Gravity()])
    force = problems.reaction(problems.solve(model, EXACT).states[-1], "x0")
    weight = 1070.0 * 0.03 * 0.01 * 0.02 * np.linalg.det(np.eye(3) + 0.1 * np.eye(3)[[1, 2, 0]]) * 9.80665
    record_verification(
        claim="support reaction under gravity over the weight",
        source="V23, exact",
        expected=1.0,
        got=force[2] / weight,
        tolerance="1e-9",
    )
    assert force == pytest.approx([0, 0, weight], rel=1e-9, abs=1e-9 * weight)


def test_volumes(record_verification):
    cube = meshes.box((1.0, 1.0, 1.0), (2, 2, 2))
    hollow = meshes.hollow_box()
    for shift in ([0, 0, 0], [3, -2, 7]):
        volumes = [
            enclosed_volume(cube.points + shift, meshes.surface(cube)),
            -enclosed_volume(hollow.points + shift, hollow.face("cavity")),
        ]
        assert volumes == pytest.approx([1, 1 / 27], rel=1e-12)
    shells = [meshes.sphere_octant(1.0, 1.5, around, 1) for around in (2, 4)]
    exact = 4 / 3 * np.pi * 1.5**3
    balls = [8 * enclosed_volume(shell.points, shell.face("outside")) for shell in shells]
    record_verification(
        claim="volume of a ball of radius 1.5 from its curved faces, 192 and 768 triangles",
        source="V23, geometry error of quadratic sides",
        expected=exact,
        got=balls,
        tolerance="5e-4, sixteenfold smaller when halved",
    )
    assert balls == pytest.approx([exact, exact], rel=5e-4)
    assert 12 < (balls[0] - exact) / (balls[1] - exact) < 20


def _work_over_energy(count):
    mesh = meshes.sphere_octant(0.01, 0.015, 1, 2)
    model = problems.one_material(
        mesh, problems.YEOH, 1000 * problems.YEOH.shear_modulus, loads=[tg.Pressure("cavity", 2e5)]
    )
    factors = tuple(k / count for k in range(1, count + 1))
    states = problems.solve(
        model, tg.Static(first_step=1 / count, max_step=1 / count, at=factors, tolerance=1e-9)
    ).states
    volume = np.array([-enclosed_volume(problems.current(state), mesh.face("cavity")) for state in states])
    pressure = np.array([2e5 * state.load_factor for state in states])
    return float(np.trapezoid(pressure, volume)) / problems.energy(states[-1])


def test_work_of_the_pressure_is_the_stored_energy(record_verification):
    ratios = {count: _work_over_energy(count) for count in (20, 40)}
    record_verification(
        claim="sphere inflated to twice its radius in 40 steps: ∫ P dV over the stored energy",
        source="V23, exact",
        expected=1.0,
        got=ratios[40],
        tolerance="0.1 %",
    )
    assert ratios[40] == pytest.approx(1, abs=1e-3)
    assert 3.5 < (ratios[20] - 1) / (ratios[40] - 1) < 4.5


def test_tangent_of_a_closed_cavity_is_symmetric(record_verification):
    mesh = meshes.hollow_box()
    model = problems.one_material(mesh, problems.YEOH, supports=[tg.Fixed("x0")], loads=[tg.Pressure("cavity", P)])
    state = problems.solve(model, tg.Static()).states[-1]
    system = System(model)
    unknowns = np.concatenate([state.displacement.ravel() / system.length, state.mean_stress / system.stress_scale])
    derivative = _pressure_tangent(system, unknowns)
    skew = float(np.abs(derivative - derivative.T).max() / np.abs(derivative).max())
    record_verification(
        claim="pressure tangent of a closed cavity, by differences of forces: unsymmetric part over largest entry",
        source="V23, exact",
        expected=0.0,
        got=skew,
        tolerance="1e-12",
    )
    assert skew < 1e-12


def _pressure_tangent(system, unknowns):
    """Derivative of the pressure forces at the cavity's nodes; they are quadratic, so central differences are exact."""
    nodes = system.model.mesh.face_nodes("cavity")
    rows = (3 * nodes[:, None] + np.arange(3)).ravel()
    columns = []
    for row in rows:
        step = np.zeros_like(unknowns)
        step[row] = 0.1
        ahead, behind = (system.evaluate(unknowns + sign * step, 1.0) for sign in (1, -1))
        columns.append((ahead.external - behind.external)[rows] / 0.2)
    return np.array(columns)
