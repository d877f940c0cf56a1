"""V16: what comes out does not depend on the contact stiffness; the penetration is inversely proportional to it.

Problem: two walls that meet in a gap, and a block into which a ball is pressed by a third of its height, which is as
hard as contact gets: pressures of half of Young's modulus. The stiffness is the one that the program chooses, then ten
times as much.
Exact in the limit: equal displacements and forces. Source: this is a requirement on the program, not a published case.
Tolerance: 0.5 % of the largest displacement and of the force for the walls; 1 % of the force for the ball, which at
the stiffness chosen penetrates by 1.5 % of its way; 15 % for the penetration over the inverse stiffness, since the
contact pressure changes as well.
"""

import pytest

import contact_cases
import contact_meshes
import problems
import turgor as tg
from problems import MM
from turgor.core.engine.system import System
from turgor.core.model.contact import SELF, Contact
from turgor.core.model.obstacles import SelfContact, Sphere


def _walls(stiffness):
    mesh = contact_meshes.gap_cell(2)
    loads = [tg.Pressure("cavity_1", 2e4), tg.Pressure("cavity_2", 2e4)]
    supports = [tg.Fixed("rim"), tg.Fixed("y0", "y"), tg.Fixed("y1", "y")]
    contact = Contact(SelfContact(stiffness=stiffness))
    model = tg.Model(mesh, {"body": problems.rubber(problems.YEOH)}, supports, loads, contact=contact)
    state = problems.solve(model, tg.Static(tolerance=1e-8)).states[-1]
    lower = mesh.face_nodes("gap_1")
    return state, float(state.touches[SELF].force[lower, 2].sum())


def _ball(stiffness):
    ball = Sphere(center=(4 * MM, 5.5 * MM, 12 * MM), radius=7 * MM)
    obstacle = contact_cases.pushed(ball, (0, 0, -1.5), stiffness=stiffness)
    state = problems.solve(contact_cases.standing(contact_cases.block((4, 4, 3)), obstacle)).states[-1]
    return state, float(contact_cases.push(state.touches["plate"])[2])


def _chosen(state):
    """Largest stiffness that the program has chosen for a side [Pa/m]."""
    system = System(state.model)
    return float(system.contact.parts[0].surface.spring.max()) * system.stress_scale / system.length


def _change(one, other):
    """Change of the displacement and of the force between two answers (state, force)."""
    return contact_cases.apart(one[0].displacement, other[0].displacement), abs(one[1] / other[1] - 1)


def test_walls_with_ten_times_the_stiffness(record_verification):
    first = _walls(None)
    stiffness = _chosen(first[0])
    second = _walls(10 * stiffness)
    moved, by_force = _change(first, second)
    ratio = first[0].touches[SELF].penetration / second[0].touches[SELF].penetration / 10
    record_verification(
        claim="contact stiffness tenfold, two walls: change of displacement and of force",
        source="V16, invariance",
        expected=[0.0, 0.0],
        got=[moved, by_force],
        tolerance="0.5 %",
    )
    record_verification(
        claim="contact stiffness tenfold, two walls: penetration times stiffness over the one before",
        source="V16, penalty",
        expected=1.0,
        got=ratio,
        tolerance="15 %",
    )
    assert moved < 0.005
    assert by_force < 0.005
    assert ratio == pytest.approx(1, abs=0.15)


def test_ball_with_ten_times_the_stiffness(record_verification):
    first = _ball(None)
    change = _change(first, _ball(10 * _chosen(first[0])))[1]
    record_verification(
        claim="contact stiffness tenfold, ball pressed into a block by a third of its height: change of the force",
        source="V16, invariance",
        expected=0.0,
        got=change,
        tolerance="1 %",
    )
    assert change < 0.01
