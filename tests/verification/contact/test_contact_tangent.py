"""V16, V24: the tangent of contact is the derivative of its forces, and Newton's method converges quadratically.

Problem: small bodies that press on themselves, on shapes given by a formula, on triangles, on a sprung ball, and that
stick and slip; at the state of equilibrium with noise on top, along random directions.
Exact: equality with central differences of the residual, away from the points that begin to touch within the
difference, and the order 2 of Newton's method: after one update from a bump, four times the residual that half the bump
leaves. Tolerance: 1e-5 of the largest value; 0.05 for the order. The last residuals of a single run are not used: the
order that they give scatters from 1.4 to 2.3 for the same tangent, with the size of the bump.
"""

import numpy as np
import pytest
from scipy.sparse.linalg import splu

import contact_cases
import contact_meshes
import problems
import turgor as tg
from problems import MM
from turgor.core.engine.system import System
from turgor.core.meshing.cells import HEXAHEDRON, TETRAHEDRON
from turgor.core.model.contact import Contact
from turgor.core.model.obstacles import Box, Cylinder, Obstacle, Plane, RigidSurface, SelfContact, Sphere

SOFT = 1e9

#: A flat pyramid with its tip down: the tip and the edges press into a block below it.
PYRAMID = RigidSurface(
    points=np.array([[5.2, 4.9, 4.3], [12, 1, 6.5], [7, 12, 6.5], [-2, 6, 6.5], [3, -3, 6.5]]) * MM,
    triangles=np.array([[0, 2, 1], [0, 3, 2], [0, 4, 3], [0, 1, 4], [1, 2, 3], [1, 3, 4]]),
)
SHAPES = {
    "plane": Plane(point=(5 * MM, 5 * MM, 4.85 * MM), normal=(0.02, 0.04, -1)),
    "ball": Sphere(center=(4 * MM, 5 * MM, 9.5 * MM), radius=5 * MM),
    "endless bar": Cylinder(center=(4 * MM, 5 * MM, 9.5 * MM), axis=(1, 0.3, 0.1), radius=5 * MM),
    "end of a bar": Cylinder(center=(5 * MM, 5 * MM, 8.4 * MM), axis=(0.4, 0.1, 1), radius=3 * MM, length=8 * MM),
    "box": Box(center=(7 * MM, 8 * MM, 9.7 * MM), size=(10 * MM, 10 * MM, 10 * MM)),
    "round box": Box(center=(7 * MM, 8 * MM, 9.6 * MM), size=(10 * MM, 10 * MM, 10 * MM), rounding=2 * MM),
    "triangles": PYRAMID,
}


def _pressed(shape, kind=HEXAHEDRON, **more):
    obstacle = Obstacle(**{"name": "body", "shape": shape, "stiffness": SOFT} | more)
    return System(contact_cases.standing(contact_cases.block((2, 2, 1), kind=kind), obstacle))


def _unknowns(system, seed, size=1.0):
    """A smooth deformation with noise on top, and any mean stress and displacement of sprung bodies."""
    rng = np.random.default_rng(seed)
    X = system.model.mesh.points
    u = X @ (0.03 * size * rng.uniform(-1, 1, (3, 3))) + rng.normal(0, 5e-6, X.shape)
    return np.concatenate([u.ravel() / system.length, 0.02 * rng.uniform(-1, 1, system.size - u.size)])


def _bare(system):
    """The same body without contact, whose forces and tangent are taken off."""
    model = system.model
    contact = Contact(self_contact=False)
    return System(tg.Model(model.mesh, model.materials, model.supports, model.loads, contact=contact))


def _error(system, unknowns, record, name, history=None, h=1e-6):
    """Worst error of the tangent of contact along random directions over its largest value."""
    free, rng, bare = np.flatnonzero(~system.prescribed), np.random.default_rng(23), _bare(system)
    count = bare.size
    tangent, without = system.tangent(unknowns, 1.0, history), bare.tangent(unknowns[:count], 1.0)

    def forces(x):
        force = system.residual(x, 1.0, history)
        force[:count] -= bare.residual(x[:count], 1.0)
        return force

    worst = largest = 0.0
    for _ in range(8):
        along = np.zeros(system.size)
        along[free] = rng.normal(0, 1, len(free))
        exact = (forces(unknowns + h * along) - forces(unknowns - h * along)) / (2 * h)
        got = tangent @ along
        got[:count] -= without @ along[:count]
        worst = max(worst, float(np.abs(got - exact)[free].max()))
        largest = max(largest, float(np.abs(exact[free]).max()))
    record(
        claim=f"tangent of contact along random directions against differences, {name}: worst over largest entry",
        source="V24",
        expected=0.0,
        got=worst / largest,
        tolerance="1e-5",
    )
    return worst / largest


def _points_inside(system, unknowns):
    """How many points press, none of them deeper than 1 mm."""
    result = system.evaluate(unknowns, 1.0).contacts.gaps
    assert all(one.gap.min() * system.length > -1 * MM for one in result)
    return sum(len(one.touching) for one in result)


@pytest.mark.parametrize("kind", [HEXAHEDRON, TETRAHEDRON], ids=lambda kind: kind.name)
@pytest.mark.parametrize("name", SHAPES)
def test_tangent_of_a_shape(name, kind, record_verification):
    system = _pressed(SHAPES[name], kind)
    unknowns = _unknowns(system, seed=5)
    assert _points_inside(system, unknowns) > 3
    assert _error(system, unknowns, record_verification, f"{name}, {kind.name}") < 1e-5


@pytest.mark.parametrize("name", ["ball", "triangles"])
def test_tangent_of_a_sprung_shape(name, record_verification):
    system = _pressed(SHAPES[name], spring=500.0)
    unknowns = _unknowns(system, seed=6)
    assert _points_inside(system, unknowns) > 3
    assert system.size == 3 * system.node_count + system.element.mean_count + 3
    assert _error(system, unknowns, record_verification, f"sprung {name}") < 1e-5


def _stacked(kind, friction=0.0):
    """Two blocks of unlike meshes, the upper one 0.2 mm deep in the lower one after `_overlapping`."""
    lower = contact_cases.block((2, 2, 1), kind=kind)
    upper = contact_meshes.moved(contact_cases.block((3, 3, 1), (8, 8, 5), kind), (1.3 * MM, 0.6 * MM, 5.1 * MM))
    mesh = contact_meshes.together({"lower": lower, "upper": upper})
    materials = {"body": problems.rubber(problems.NEO_HOOKE)}
    contact = Contact(SelfContact(stiffness=SOFT, friction=friction))
    return System(tg.Model(mesh, materials, [tg.Fixed("lower_z0"), tg.Fixed("upper_z1")], [], contact=contact))


def _overlapping(system, seed):
    """The deformation of `_unknowns`, with the middle of the upper body bulging down into the lower one."""
    X = system.model.mesh.points / MM
    bulge = np.where(X[:, 2] > 5.05, -0.3 * (10.1 - X[:, 2]) / 5, 0.0) * MM / system.length
    unknowns = _unknowns(system, seed, 0.3)
    unknowns[2 : 3 * system.node_count : 3] += bulge
    return unknowns


@pytest.mark.parametrize("kind", [HEXAHEDRON, TETRAHEDRON], ids=lambda kind: kind.name)
def test_tangent_of_self_contact(kind, record_verification):
    system = _stacked(kind)
    unknowns = _overlapping(system, seed=7)
    assert _points_inside(system, unknowns) > 50
    assert _error(system, unknowns, record_verification, f"self-contact, {kind.name}") < 1e-5


def test_tangent_of_a_wall_at_a_mirror(record_verification):
    mesh = contact_meshes.gap_cell(1, "symmetry_z")
    contact = Contact(SelfContact(stiffness=SOFT))
    system = System(
        tg.Model(mesh, {"body": problems.rubber(problems.NEO_HOOKE)}, [tg.Fixed("rim")], [], contact=contact)
    )
    unknowns = _unknowns(system, seed=8, size=0.3)
    X = mesh.points / MM
    unknowns[2 : 3 * system.node_count : 3] += 0.6 * np.maximum(1 - X[:, 0] / 8, 0) * MM / system.length
    assert _points_inside(system, unknowns) > 3
    assert _error(system, unknowns, record_verification, "own mirror image") < 1e-5


FRICTION = {
    "plane": lambda: (_pressed(SHAPES["plane"], friction=0.4), _unknowns),
    "ball": lambda: (_pressed(SHAPES["ball"], friction=0.4), _unknowns),
    "triangles": lambda: (_pressed(PYRAMID, friction=0.4), _unknowns),
    "sprung ball": lambda: (_pressed(SHAPES["ball"], friction=0.4, spring=500.0), _unknowns),
    "self-contact": lambda: (_stacked(HEXAHEDRON, 0.4), _overlapping),
}


@pytest.mark.parametrize("way", [2e-4, 0.2], ids=["sticking", "sliding"])
@pytest.mark.parametrize("name", FRICTION)
def test_tangent_of_friction(name, way, record_verification):
    """From a state in contact on, everything moves sideways: by 0.2 µm, where points stick, or by 0.2 mm."""
    system, deform = FRICTION[name]()
    before = deform(system, 9)
    assert _points_inside(system, before) > 3
    history = system.history(system.remembered(system.evaluate(before, 1.0)))
    once, twice = (_sideways(system, before, times * way * MM, name == "self-contact") for times in (1, 2))
    growth = np.linalg.norm(_pull(system, twice, history)) / np.linalg.norm(_pull(system, once, history))
    assert growth == pytest.approx(2 if way < 0.01 else 1, abs=0.2)
    said = f"friction, {name}, {'sticking' if way < 0.01 else 'sliding'}"
    assert _error(system, once, record_verification, said, history, h=1e-8) < 1e-5


def _sideways(system, unknowns, way, upper_only):
    """Everything that is free moved sideways."""
    moved, free = np.zeros(system.size), ~system.prescribed
    moved[0 : 3 * system.node_count : 3], moved[1 : 3 * system.node_count : 3] = 1.0, 0.4
    if upper_only:
        moved[: 3 * system.node_count] *= np.repeat(system.model.mesh.points[:, 2] > 5.05 * MM, 3)
    return unknowns + np.where(free, moved, 0.0) * way / system.length


def _pull(system, unknowns, history):
    """Forces of friction: what vanishes without the history of what has touched."""
    at, springs = system.evaluate(unknowns, 1.0, history=history).contacts, system.springs(unknowns)
    return system.contact.forces(at, springs)[0] - system.contact.forces(at.with_friction(()), springs)[0]


def _residuals(system, x, count):
    """Norms of the free residual of the textbook's iteration at the full load."""
    free, norms = np.flatnonzero(~system.prescribed), []
    for _ in range(count):
        residual = system.residual(x, 1.0)[free]
        norms.append(float(np.linalg.norm(residual)))
        x[free] -= splu(system.tangent(x, 1.0)[free][:, free].tocsc()).solve(residual)
    return np.array(norms)


@pytest.mark.parametrize("name", ["ball", "self-contact"])
def test_newton_is_quadratic(name, record_verification):
    """From the equilibrium with a bump of 1e-3 of the length on top; the points that touch stay the same."""
    system = _pressed(SHAPES["ball"]) if name == "ball" else _stacked(HEXAHEDRON)
    x = np.zeros(system.size) if name == "ball" else _overlapping(system, 7)
    norms = _residuals(system, x, 14)
    displaced = np.flatnonzero(~system.prescribed[: 3 * system.node_count])
    bump = np.random.default_rng(9).normal(0, 1e-3, len(displaced))
    left = []
    for share in (1.0, 0.5):
        start = x.copy()
        start[displaced] += share * bump
        left.append(_residuals(system, start, 2)[1])
    order = float(np.log2(left[0] / left[1]))
    record_verification(
        claim=f"Newton's method with contact, {name}: order of one update from a bump and from half of it",
        source="V24, quadratic",
        expected=2.0,
        got=order,
        tolerance="0.05",
    )
    assert norms[-1] < 1e-10 * norms[0]
    assert order == pytest.approx(2, abs=0.05)
