"""V16: Coulomb's law: a block sticks while it is pulled weakly, and slides with µ times what presses it down.

Problem: a block of 10 × 10 × 3 mm, clamped below, under a rigid plate (a plane, or triangles) or another block, with
µ = 0.5; the plate comes down by 0.1 mm and then moves sideways by 1 mm.
Exact: the pull never exceeds µ times the push, and reaches it when all points slide. Before that, with µ = 2, the block
is as stiff as one whose top moves with the plate. Pulled along y instead of x, everything turns with it. Source:
Coulomb's law. Tolerance: 1 % for the ratio, 2 % for the first slope, 1e-6 for the direction. Under another body the
ratio may stay 3 % short (2.5 % seen): points of it that slide onto the rim from outside begin to rub in the next step.
"""

import numpy as np
import pytest

import contact_cases
import contact_meshes
import problems
import turgor as tg
from problems import MM
from turgor.core.model.contact import SELF, Contact
from turgor.core.model.obstacles import Obstacle, Plane, SelfContact

FRICTION, HEIGHT, DOWN, ALONG = 0.5, 3, 0.1, 1.0
PRESSED, STIFFNESS = 0.2, 1e10
PLATES = {
    "plane": Plane(point=(0, 0, HEIGHT * MM), normal=(0, 0, -1)),
    "triangles": contact_cases.slab(40, HEIGHT),
}
STEPS = tg.Static(first_step=0.1, max_step=0.08, at=(PRESSED,))


def _way(load_factor, along):
    """Where the plate is: down until load factor 0.2, then sideways [m]."""
    down = min(load_factor / PRESSED, 1.0) * DOWN * MM
    sideways = max(load_factor - PRESSED, 0.0) / (1 - PRESSED) * np.array(along) * MM
    return np.array([*sideways, -down])


def _plate(name="plane", friction=FRICTION, along=(ALONG, 0.0), procedure=STEPS, cells=(3, 3, 1)):
    path = tuple((factor, tuple(_way(factor, along))) for factor in (0, PRESSED, 1))
    plate = Obstacle(name="plate", shape=PLATES[name], friction=friction, path=path, stiffness=STIFFNESS)
    return problems.solve(contact_cases.standing(contact_cases.block(cells, (10, 10, HEIGHT)), plate), procedure).states


def _glued(along, cells):
    """The force on a block whose top moves as the plate does."""
    top = tg.Displacement("z1", lambda X, t: np.tile(_way(t, along), (len(X), 1)))
    mesh = contact_cases.block(cells, (10, 10, HEIGHT))
    materials = {"body": problems.rubber(problems.NEO_HOOKE)}
    states = problems.solve(tg.Model(mesh, materials, [tg.Fixed("z0"), top], []), tg.Static(at=(PRESSED,))).states
    return [problems.reaction(state, "z0") for state in states if state.load_factor >= PRESSED]


def _body():
    """Another block, of unlike mesh, in place of the plate: its top moves."""
    lower = contact_cases.block((3, 3, 1), (10, 10, HEIGHT))
    upper = contact_meshes.moved(contact_cases.block((4, 4, 1), (16, 16, 3)), (-2 * MM, -3 * MM, HEIGHT * MM))
    top = tg.Displacement("upper_z1", lambda X, t: np.tile(2 * _way(t, (ALONG, 0)), (len(X), 1)))
    materials = {"body": problems.rubber(problems.NEO_HOOKE)}
    contact = Contact(SelfContact(friction=FRICTION, stiffness=STIFFNESS))
    mesh = contact_meshes.together({"lower": lower, "upper": upper})
    return problems.solve(tg.Model(mesh, materials, [tg.Fixed("lower_z0"), top], [], contact=contact), STEPS).states


def _ratio(state):
    """Tangential over normal force on the lower block."""
    (name,) = state.touches
    mesh = state.model.mesh
    force = state.touches[name].force[mesh.face_nodes("lower_z1" if name == SELF else "z1")].sum(axis=0)
    held = problems.reaction(state, "lower_z0" if name == SELF else "z0")
    assert contact_cases.apart(held, -force) < 1e-3  # what the support carries is what the contact says
    return float(np.hypot(*force[:2]) / -force[2])


@pytest.fixture(scope="module", params=[*PLATES, "another body"])
def path(request):
    return request.param, _body() if request.param not in PLATES else _plate(request.param)


def test_pull_is_friction_times_push_when_all_slides(path, record_verification):
    name, states = path
    ratios = [_ratio(state) for state in states if state.load_factor > 0.85]
    record_verification(
        claim=f"block under a sliding plate, {name}: tangential over normal force, least and most near the end",
        source="V16, Coulomb's law",
        expected=FRICTION,
        got=[min(ratios), max(ratios)],
        tolerance="1 %" if name in PLATES else "3 %",
    )
    assert ratios == pytest.approx([FRICTION] * len(ratios), rel=0.01 if name in PLATES else 0.03)


def test_pull_grows_up_to_the_limit(path):
    _, states = path
    ratios = np.array([_ratio(state) for state in states if state.load_factor >= PRESSED])
    assert ratios[0] < 0.01  # pressed straight down: no net pull
    assert ratios.max() < 1.01 * FRICTION
    assert (np.diff(ratios[:5]) > 0).all()
    assert ratios[1] < 0.5 * FRICTION


def test_a_block_that_sticks_is_glued(record_verification):
    """µ = 2 holds the whole block: what it carries sideways is what a glued one carries.

    Where the rims of a glued block are sharp the mesh counts: 3 × 3 × 1 cells are 2.2 % apart, 4 × 4 × 2 cells 1.3 %.
    """
    along, cells = (0.1, 0.0), (4, 4, 2)
    expected = _glued(along, cells)
    procedure = tg.Static(first_step=0.05, at=(PRESSED,))
    states = _plate(friction=2.0, along=along, procedure=procedure, cells=cells)
    got = [problems.reaction(state, "z0") for state in states if state.load_factor >= PRESSED]
    slope = (got[-1][0] - got[0][0]) / (expected[-1][0] - expected[0][0])
    record_verification(
        claim="block that sticks to a plate moved sideways by 3 % of the height: force over that of a glued block",
        source="V16, glued block",
        expected=1.0,
        got=slope,
        tolerance="2 %",
    )
    assert slope == pytest.approx(1, rel=0.02)


def test_direction_does_not_matter(record_verification):
    procedure = tg.Static(first_step=0.1, max_step=0.1, tolerance=1e-9)
    forces = [
        contact_cases.push(_plate(along=along, procedure=procedure)[-1].touches["plate"])
        for along in ((0.6, 0.0), (0.0, 0.6))
    ]
    error = contact_cases.apart(forces[0], forces[1][[1, 0, 2]])
    record_verification(
        claim="block dragged along y against along x: force, relative",
        source="symmetry of the square block",
        expected=0.0,
        got=error,
        tolerance="1e-6",
    )
    assert error < 1e-6
