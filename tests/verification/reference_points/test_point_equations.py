"""The forces of a reference point are in balance, turn with the body, and have the tangent that they claim.

Problem: a bar of which one end is tied to a point beside its center, rigidly or by its average, after a rotation of 75°
about a skew axis with random disturbances of all unknowns, the multipliers among them; loads of both kinds and springs.
Expected: the tangent is the derivative of the residual; forces and moments of a tie on face and point cancel; where
everything is turned once more, the forces are turned too.
Tolerance: 1e-8 for central differences, 1e-12 for what is exact but for round-off.
"""

import numpy as np
import pytest
from turgor.loads import Force, Hanging, Moment
from turgor.supports import Hinge, ReferencePoint

import problems
import rig
import turgor as tg
from turgor.core.engine.algebra.linear import linear_solver
from turgor.core.engine.points.average_term import AverageTerm
from turgor.core.engine.points.rigid_term import RigidTerm
from turgor.core.engine.points.spring_term import SpringTerm, angle_squared
from turgor.core.engine.system import System
from turgor.core.engine.term import Configuration
from turgor.core.model.points import Rotation

COUPLINGS = ("rigid", "averaging")
AT = (45e-3, 2e-3, 3e-3)
LOADS = (
    Moment("plate", (0.01, -0.02, 0.03)),
    Moment("plate", (0.03, 0.01, -0.02), follower=True),
    Force("plate", (1.0, 2.0, 3.0)),
    Force("plate", (3.0, -2.0, 1.0), follower=True),
    Hanging("plate", 0.1),
)


def _point(coupling, **more):
    return ReferencePoint("plate", "x1", at=AT, coupling=coupling, **more)


#: A hinge about a skew axis, and a prescribed twist about it.
BEARINGS = {
    "free": (),
    "hinge": (Hinge("plate", (1.0, -2.0, 0.5)),),
    "twist": (Rotation("plate", 0.7, (1.0, -2.0, 0.5), tilts=True),),
}


@pytest.mark.parametrize("bearing", BEARINGS)
@pytest.mark.parametrize("coupling", COUPLINGS)
def test_the_tangent_is_the_derivative(coupling, bearing, record_verification):
    point = _point(coupling, spring=(30.0, 40.0, 50.0), rotational_spring=0.3)
    system = System(rig.rig(point, BEARINGS[bearing], loads=LOADS, bulk_modulus=50e6))
    unknowns = rig.turned(system, 1)
    way = np.random.default_rng(2).standard_normal(system.size)
    way[rig.followers(system)] = 0.0
    step = 1e-6
    differences = (system.residual(unknowns + step * way, 1.0) - system.residual(unknowns - step * way, 1.0)) / 2 / step
    tangent = system.tangent(unknowns, 1.0) @ way
    error = float(np.abs(tangent - differences).max() / np.abs(differences).max())
    record_verification(
        f"tangent of a point, {coupling}, {bearing}, against differences", "derivation", 0.0, error, "1e-8"
    )
    assert error < 1e-8


@pytest.mark.parametrize("coupling", COUPLINGS)
def test_all_but_moments_and_followers_is_symmetric(coupling):
    loads = [load for load in LOADS if isinstance(load, Hanging) or not getattr(load, "follower", True)]
    point = _point(coupling, spring=30.0, rotational_spring=0.3)
    dead = [load for load in loads if not isinstance(load, Moment)]
    system = System(rig.rig(point, loads=dead, bulk_modulus=50e6))
    at = system.evaluate(rig.turned(system, 1), 1.0)
    assert system.terms.symmetric
    assert system.rubbing(at) is None
    with_moment = System(rig.rig(point, loads=loads, bulk_modulus=50e6))
    assert abs(with_moment.rubbing(with_moment.evaluate(rig.turned(with_moment, 1), 1.0))).max() > 1e-6


def _ties(coupling):
    """The terms that tie, and a disturbed position with random multipliers."""
    system = System(rig.rig(_point(coupling), bulk_modulus=50e6))
    terms = [term for term in system.terms.all if isinstance(term, RigidTerm | AverageTerm)]
    position = system.points + system.split(rig.turned(system, 3))[0]
    carrier = system.carriers[0]
    multipliers = np.concatenate([carrier.stress, carrier.ties])
    position[multipliers] += np.random.default_rng(4).standard_normal((len(multipliers), 3))
    return system, carrier, terms, position


@pytest.mark.parametrize("coupling", COUPLINGS)
def test_the_ties_are_in_balance(coupling, record_verification):
    system, carrier, terms, position = _ties(coupling)
    out = np.zeros_like(position)
    for term in terms:
        term.add_forces(out, Configuration(position))
    arrows = position[carrier.arrows] - system.points[carrier.node] + carrier.radius / system.length * np.eye(3)
    places = [*carrier.nodes, carrier.node]
    force = out[places].sum(axis=0)
    moment = np.cross(position[places], out[places]).sum(axis=0) + np.cross(arrows, out[carrier.arrows]).sum(axis=0)
    # where a tie does not hold yet, its multipliers turn with the body: λ × ∂W/∂λ is zero once it holds
    moment += np.cross(position[carrier.ties] - system.points[carrier.node], out[carrier.ties]).sum(axis=0)
    size = float(np.abs(out).sum()) * np.abs(position).max()
    error = float(max(np.abs(force).max(), np.abs(moment).max()) / size)
    record_verification(f"force and moment of a tie on itself, {coupling}", "balance", 0.0, error, "1e-12")
    assert np.abs(out[carrier.arrows]).max() > 1e-2
    assert error < 1e-12


@pytest.mark.parametrize("coupling", COUPLINGS)
def test_the_ties_turn_with_the_body(coupling):
    system, carrier, terms, position = _ties(coupling)
    before, after = np.zeros_like(position), np.zeros_like(position)
    rest, radius = system.points[carrier.node], carrier.radius / system.length
    rotation = Rotation("any", 2.5, (3, -1, 2)).matrix(1.0)
    again = position @ rotation.T  # the body turns about the origin; arrows and multipliers about their own
    again[carrier.arrows] = (position[carrier.arrows] - rest + radius * np.eye(3)) @ rotation.T + rest
    again[carrier.arrows] -= radius * np.eye(3)
    again[carrier.stress] = position[carrier.stress]
    again[carrier.ties] = (position[carrier.ties] - rest) @ rotation.T + rest
    for term in terms:
        term.add_forces(before, Configuration(position))
        term.add_forces(after, Configuration(again))
    expected = before @ rotation.T
    expected[carrier.stress] = before[carrier.stress]
    assert after == pytest.approx(expected, abs=1e-12 * np.abs(before).max() * np.abs(position).max())


def test_a_rigid_face_moves_as_a_rigid_body():
    system = System(rig.rig(_point("rigid"), bulk_modulus=50e6))
    rotation = Rotation("any", 2.0, (1, -1, 2)).matrix(1.0)
    points = system.model.mesh.points
    moved = (points - AT) @ rotation.T + AT + np.array([1e-3, 2e-3, -3e-3])
    unknowns = system.unknowns(moved - points, np.zeros(system.element.mean_count))
    assert not unknowns[rig.followers(system)].any()
    assert system.physical(unknowns)[0] == pytest.approx(moved - points, abs=1e-15)
    loose = unknowns + np.where(system.prescribed, 0.0, 0.1)
    loose[: 3 * len(points)] = unknowns[: 3 * len(points)]  # other arrows: a face that is stretched, too
    assert np.abs(system.residual(loose, 0.0)[system.multipliers]).max() > 1e-2
    residual = system.residual(unknowns, 0.0)
    assert np.abs(residual).max() < 1e-12


@pytest.mark.parametrize("value", [-0.3, -1e-5, 1e-5, 0.5, 1.0, 1.9])
def test_the_square_of_the_angle_has_its_derivatives(value):
    step = 1e-5 * abs(value)
    low, here, high = angle_squared(value - step), angle_squared(value), angle_squared(value + step)
    assert here[1] == pytest.approx((high[0] - low[0]) / (2 * step), rel=1e-6)
    assert here[2] == pytest.approx((high[1] - low[1]) / (2 * step), rel=1e-5)
    if value > 0:
        assert here[0] == pytest.approx(np.arccos(1 - value) ** 2, rel=1e-9)


def test_springs_store_their_energy():
    system = System(rig.rig(_point("rigid", spring=(30.0, 40.0, 50.0), rotational_spring=0.3), bulk_modulus=50e6))
    (spring,) = [term for term in system.terms.all if isinstance(term, SpringTerm)]
    rotation, shift = Rotation("any", 1.7, (1, 1, 0)).matrix(1.0), np.array([1e-3, -2e-3, 3e-3])
    points = system.model.mesh.points
    unknowns = system.unknowns((points - AT) @ rotation.T + AT + shift - points, np.zeros(system.element.mean_count))
    energy = spring.energy(system.points + system.split(unknowns)[0]) * system.stress_scale * system.length**3
    assert energy == pytest.approx(0.5 * (np.array([30.0, 40.0, 50.0]) @ shift**2) + 0.5 * 0.3 * 1.7**2, rel=1e-9)


@pytest.mark.parametrize("coupling", COUPLINGS)
def test_the_face_carries_what_acts_on_the_point(coupling, record_verification):
    loads = [Force("plate", (0.3, 0.2, -0.4)), Moment("plate", (4e-3, -3e-3, 5e-3))]
    model = rig.rig(_point(coupling), loads=loads, bulk_modulus=50e6)
    state = problems.solve(model, tg.Static(tolerance=1e-10)).states[-1]
    assert np.abs(state.displacement).max() > 2e-3
    free = tg.Model(model.mesh, model.materials, [tg.Fixed("x0")], [])
    bare = System(free)
    internal = bare.nodal_forces(bare.evaluate(bare.unknowns(state.displacement, state.mean_stress), 0.0))
    nodes = model.mesh.face_nodes("x1")
    arms = problems.current(state)[nodes] - (np.array(AT) + state.points["plate"].displacement)
    force, moment = internal[nodes].sum(axis=0), np.cross(arms, internal[nodes]).sum(axis=0)
    record_verification(f"force on the face [N], {coupling}", "balance", loads[0].vector, force.tolist(), "1e-8")
    assert force == pytest.approx(loads[0].vector, abs=1e-8)
    assert moment == pytest.approx(loads[1].vector, abs=1e-10)
    assert np.abs(np.delete(internal, [*nodes, *model.mesh.face_nodes("x0")], axis=0)).max() < 1e-8


@pytest.mark.parametrize("coupling", COUPLINGS)
@pytest.mark.parametrize("kind", [rig.TETRAHEDRON, rig.HEXAHEDRON], ids=["tet", "hex"])
@pytest.mark.parametrize("counts", [(2, 1, 1), (4, 2, 2), (6, 3, 3)])
def test_a_solver_that_pivots_in_fronts_factors_them(coupling, kind, counts):
    """Places and multipliers have zeros on the diagonal, which stopped the factorization on some of these meshes."""
    mesh = rig.bar(kind, counts)
    hinges = [(tg.Fixed("plate"), Hinge("plate", axis)) for axis in ("y", (1, 2, 3))]
    turns = [(Rotation("plate"),), (Rotation("plate", 1.0, (1, 2, 3), tilts=True),)]
    for supports in ((), (tg.Fixed("plate", "yz"),), *turns, *hinges):
        system = System(rig.rig(_point(coupling), supports, mesh=mesh))
        data = system.tangent_data(system.evaluate(np.zeros(system.size), 0.0))
        system.apply_supports(data)
        exact = data.copy()
        system.make_definite(data)
        solver = linear_solver("rslab", system.pattern, 1)
        solver.factor(data)
        assert solver.negative_pivots(system.constraint_count) == system.constraint_count
        right = np.where(system.prescribed, 0.0, 1.0)
        solution = solver.solve(right)
        left = right - system.pattern.product(exact, solution)
        assert np.linalg.norm(left) < 1e-2 * np.linalg.norm(right)
