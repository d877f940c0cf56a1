"""Steps that Newton's method alone gets wrong or never finds: far too long, past buckling, or without stiffness.

Turns and twists of a bar in one step have other equilibria, which a finer path shows to be wrong. A bowed column
follows the elastica only where a step does not jump over the loss of its stability. A strip of film, flat at first,
has no stiffness against pressure, and inflates to a circular arc (exact where bending does not matter).
"""

import numpy as np
import pytest
from scipy.optimize import brentq
from scipy.special import ellipk

import meshes
import problems
import turgor as tg
from turgor.core.engine.algebra.tangent import Tangent
from turgor.core.engine.system import System
from turgor.core.meshing.cells import HEXAHEDRON
from turgor.core.solvers.constraints.loads import load_control
from turgor.core.solvers.newton.convergence import relative_residual
from turgor.core.solvers.newton.newton_values import NewtonSettings
from turgor.core.solvers.newton.pseudo_transient import pseudo_transient
from turgor.core.solvers.step_reasons import Cause
from turgor.units import kPa, mm

LAW = tg.laws.NeoHooke(C10=0.12e6)
YOUNG = 6 * 0.12e6
ONE_STEP = tg.Static(first_step=1.0, max_step=1.0)


def block(*supports, loads=(), sizes=(20, 10, 10), counts=(4, 2, 2)) -> tg.Model:
    """A block from the origin [mm]."""
    return problems.one_material(meshes.box(tuple(np.array(sizes) * mm), counts), LAW, supports=supports, loads=loads)


def turned(degrees: float):
    """Displacement of points that turn about the axis of the block."""

    def moved(points, load_factor):
        center = np.array([0, 5 * mm, 5 * mm])
        turn = problems.rotation((1, 0, 0), np.deg2rad(degrees) * load_factor)
        return (points - center) @ turn.T + center - points

    return moved


def along_x(distance: float):
    """Displacement along x [mm]."""
    return lambda points, factor: np.tile([distance * factor * mm, 0, 0], (len(points), 1))


@pytest.mark.parametrize("distance", [-12, 40])
def test_face_ends_where_it_is_moved(distance):
    """Where the first update would turn cells inside out it is shortened, and the rest of the way must follow."""
    model = block(tg.Fixed("x0"), tg.Displacement("x1", along_x(distance)))
    end = problems.solve(model, ONE_STEP).states[-1]
    np.testing.assert_allclose(end.displacement[model.mesh.face_nodes("x1"), 0], distance * mm, rtol=1e-12)


def test_turned_in_one_step(record_verification):
    model = block(*(tg.Displacement(face, turned(170)) for face in ("x0", "x1")))
    stress = float(np.abs(problems.fields(problems.solve(model, ONE_STEP).states[-1]).cauchy).max()) / YOUNG
    record_verification(
        claim="block turned by 170° in one step: largest stress over Young's modulus [-]",
        source="rigid motion", expected=0.0, got=stress, tolerance=1e-9,
    )  # fmt: skip
    assert stress < 1e-9


@pytest.mark.parametrize("degrees", [180, 300, 360])
def test_twisted_in_one_step(degrees):
    """One step could end turned either way round, or not at all; it must end where many small steps do."""
    model = block(tg.Fixed("x0"), tg.Displacement("x1", turned(degrees)))
    quick = problems.solve(model, ONE_STEP).states[-1].displacement
    slow = problems.solve(model, tg.Static(first_step=0.05, max_step=0.05)).states[-1].displacement
    assert np.linalg.norm(quick - slow) < 1e-6 * np.linalg.norm(slow)


#: The nearer to straight, the sharper the turn of the path at Euler's load.
BOWS = [(1e-3, tg.Static()), (2e-5, tg.Static()), (1.2e-5, tg.Static()), (1e-5, tg.Static()), (1e-2, ONE_STEP)]

LENGTH, SIDE = 100 * mm, 1 * mm
EULER = np.pi**2 * YOUNG * SIDE**4 / 12 / (4 * LENGTH**2)


def elastica(tip_degrees: float) -> tuple[float, float]:
    """Force over Euler's and deflection over length of a buckled cantilever, from the angle of its tip."""
    m = np.sin(np.deg2rad(tip_degrees) / 2) ** 2
    return float((2 * ellipk(m) / np.pi) ** 2), float(2 * np.sqrt(m) / ellipk(m))


@pytest.mark.parametrize(("bow", "procedure"), BOWS)
def test_bowed_column_buckles(bow, procedure, record_verification):
    ratio, expected = elastica(100)

    def place(points):
        return points + np.outer(bow * LENGTH * (1 - np.cos(np.pi * points[:, 0] / (2 * LENGTH))), [0, 0, 1])

    mesh = meshes.box((LENGTH, SIDE, SIDE), (30, 1, 1), place, kind=HEXAHEDRON)
    force = tg.Traction("x1", (-ratio * EULER / SIDE**2, 0, 0))
    solution = problems.solve(problems.one_material(mesh, LAW, supports=[tg.Fixed("x0")], loads=[force]), procedure)
    got = float(abs(solution.states[-1].displacement[mesh.face_nodes("x1"), 2].mean()) / LENGTH)
    record_verification(
        claim=f"column bowed by {bow:.4%} of its length, at {ratio:.3f} times Euler's load: deflection over length [-]",
        source="elastica", expected=expected, got=got, tolerance="2 %",
    )  # fmt: skip
    assert got == pytest.approx(expected, rel=0.02)
    assert not any(state.unstable_modes for state in solution.states)


def arc_height(pressure: float, thickness: float, half: float) -> float:
    """Height of an inextensible-in-y film clamped along two lines: p R = h (λ − λ⁻³) μ with λ = θ / sin θ, exact."""
    mu = 2 * 0.12e6

    def unbalanced(angle: float) -> float:
        stretch = angle / np.sin(angle)
        return pressure * half / np.sin(angle) - thickness * mu * (stretch - stretch**-3)

    return float(half * np.tan(brentq(unbalanced, 1e-3, 1.5) / 2))


@pytest.mark.parametrize("thickness", [0.1, 0.02])
def test_flat_film_blown_up(thickness, record_verification):
    half, pressure = 20 * mm, 0.4 * kPa * thickness / 0.1
    mesh = meshes.box((half, 2 * mm, thickness * mm), (12, 1, 1), kind=HEXAHEDRON)
    mesh = meshes.with_faces(mesh, symmetry_x=mesh.faces["x0"])
    supports = [tg.Fixed("x0", "x"), tg.Fixed("x1"), tg.Fixed("y0", "y"), tg.Fixed("y1", "y")]
    solution = problems.solve(problems.one_material(mesh, LAW, supports=supports, loads=[tg.Pressure("z0", pressure)]))
    got = float(solution.states[-1].displacement[meshes.node_at(mesh, (0, 0, 0)), 2])
    expected = arc_height(pressure, thickness * mm, half)
    record_verification(
        claim=f"flat film of {thickness} mm over 40 mm blown up to an arc: height [mm]",
        source="membrane of a neo-Hookean, plane strain, exact", expected=expected / mm, got=got / mm, tolerance="1 %",
    )  # fmt: skip
    assert got == pytest.approx(expected, rel=0.01)


def test_one_step_over_both_limit_points_is_taken_back(record_verification):
    """Its end lies on the far branch of the sphere, stable, and only the rates at both ends tell that it leapt."""
    model = problems.one_material(
        meshes.sphere_octant(10 * mm, 15 * mm, 2, 2), tg.laws.MooneyRivlin(C10=0.1e6, C01=0.02e6),
        loads=[tg.Pressure("cavity", 170 * kPa)],
    )  # fmt: skip
    solution = tg.solve(model, ONE_STEP, throw=False)
    limits = tg.solve(model, tg.ArcLength(), throw=False).limit_points
    assert solution.status is tg.Status.LIMIT_POINT
    got = solution.states[-1].load_factor
    record_verification(
        claim="Mooney-Rivlin sphere past its limit in one step of the load: where it stops",
        source="maximum of the path by its length",
        expected=limits[0].load_factor, got=got, tolerance="0.2 % below",
    )  # fmt: skip
    assert 0.998 * limits[0].load_factor < got <= 1.0001 * limits[0].load_factor


def test_a_load_that_comes_back_is_no_leap():
    """Pulled until it locks and let go: how it moves at rest is not told by loads that are the same at both ends."""
    mesh = meshes.box((20 * mm, 10 * mm, 10 * mm), (2, 1, 1))
    supports = [tg.Fixed("x0", "x"), tg.Fixed("y0", "y"), tg.Fixed("z0", "z")]
    pull = tg.Traction("x1", (0.4e6, 0, 0), history=[(0, 0), (0.5, 1), (1, 0)])
    model = problems.one_material(mesh, tg.laws.Gent(mu=0.1e6, Jm=1.0), supports=supports, loads=[pull])
    steps = problems.solve(model, tg.Static(first_step=0.5, max_step=0.5)).steps
    assert [step.load_factor for step in steps if step.accepted] == [0.5, 1.0]
    assert not any(step.cause is Cause.BRANCH_JUMP for step in steps)


def test_relaxed_state_is_an_equilibrium_of_the_model():
    """Nothing viscous is left, and it is stable."""
    film = meshes.box((20 * mm, 20 * mm, 0.1 * mm), (6, 6, 1), kind=HEXAHEDRON)
    supports = [tg.Fixed("x0", "x"), tg.Fixed("y0", "y"), tg.Fixed("x1"), tg.Fixed("y1")]
    system = System(problems.one_material(film, LAW, supports=supports, loads=[tg.Pressure("z0", 2 * kPa)]))
    tangent = Tangent(system, "rslab", 1)
    result = pseudo_transient(
        load_control(system), tangent, np.zeros(system.size), 1.0, NewtonSettings(), lambda *_: None
    )
    assert result.converged and result.unstable_modes == 0
    assert result.evaluation.addition is None
    again = system.evaluate(result.evaluation.unknowns, 1.0)
    assert relative_residual(system, again) < 1e-6
