"""V16-3: a wall meets its mirror image as it meets a rigid plane half way, or a mirror plane.

Problem: a slice of two walls of 1.5 mm with a gap of 1 mm and a half span of 8 mm, which two chambers blow into the gap
until three quarters of the walls lie flat against each other. Four models: both walls with self-contact; both as
separate bodies of non-matching meshes; one wall and a frictionless rigid plane in mid-gap; one wall cut in mid-gap by a
mirror plane, which it meets as its own image.
Exact: the same displacement. Tolerance: half a percent of the gap plus the penetration that the contact reports; one
percent for the separate bodies, whose meshes bend differently.
"""

import numpy as np
import pytest

import contact_meshes
import problems
import turgor as tg
from contact_cases import STIFF
from problems import MM
from turgor.core.meshing.cells import HEXAHEDRON, TETRAHEDRON
from turgor.core.model.contact import SELF, Contact
from turgor.core.model.obstacles import Obstacle, Plane, SelfContact

PRESSURE = 2e4
GAP = 2 * contact_meshes.HALF_GAP
SELF_CONTACT = Contact(SelfContact(stiffness=STIFF))
SLICE = (tg.Fixed("rim"), tg.Fixed("y0", "y"), tg.Fixed("y1", "y"))


def _solve(mesh, contact, supports=SLICE):
    loads = [tg.Pressure(name, PRESSURE) for name in mesh.faces if "cavity" in name]
    model = tg.Model(mesh, {"body": problems.rubber(problems.YEOH)}, supports, loads, contact=contact)
    return problems.solve(model, tg.Static(tolerance=1e-8)).states[-1]


def _two(kind=HEXAHEDRON):
    return _solve(contact_meshes.gap_cell(2, kind=kind), SELF_CONTACT)


def _bodies(kind=HEXAHEDRON):
    """Two bodies of 8 and 11 cells along, each with supports of its own."""
    lower = contact_meshes.gap_cell(1, kind=kind)
    upper = contact_meshes.upside_down(contact_meshes.gap_cell(1, kind=kind, along=11))
    mesh = contact_meshes.together({"lower": lower, "upper": upper})
    supports = [tg.Fixed(f"{body}_{s.face}", s.directions) for body in ("lower", "upper") for s in SLICE]
    return _solve(mesh, SELF_CONTACT, [*supports, tg.Fixed("lower_seat", "z"), tg.Fixed("upper_seat", "z")])


def _plane(kind=HEXAHEDRON):
    plane = Obstacle(name="plane", shape=Plane(point=(0, 0, 0), normal=(0, 0, -1)), face="gap_1", stiffness=STIFF)
    return _solve(contact_meshes.gap_cell(1, kind=kind), Contact(False, [plane]), (*SLICE, tg.Fixed("seat", "z")))


def _mirror(kind=HEXAHEDRON):
    return _solve(contact_meshes.gap_cell(1, "symmetry_z", kind), SELF_CONTACT)


def _lower(state):
    """Points and displacements of the lower wall, in an order of its own."""
    mesh = state.model.mesh
    lower = mesh.face_nodes("lower_gap_1" if "lower_gap_1" in mesh.faces else "gap_1")
    order = np.lexsort(np.round(mesh.points[lower] / MM, 6).T)
    return mesh.points[lower][order], state.displacement[lower][order]


@pytest.fixture(scope="module")
def two():
    return _two()


def _compare(one, other):
    """Largest difference of the displacements of the lower wall over what is allowed."""
    points, displacement = _lower(one)
    where, reference = _lower(other)
    assert points == pytest.approx(where, abs=1e-9)
    penetration = sum(touch.penetration for state in (one, other) for touch in state.touches.values())
    return float(np.abs(displacement - reference).max()), 0.005 * GAP + penetration


def test_walls_meet_over_most_of_their_span(two):
    """What is compared below is no first touch: the walls lie against each other over half of their span and more."""
    area = two.touches[SELF].area / 2
    assert 0.5 < area / (contact_meshes.SPAN * contact_meshes.SLICE) < 0.95


@pytest.mark.parametrize("kind", [HEXAHEDRON, TETRAHEDRON], ids=lambda kind: kind.name)
def test_three_ways_to_meet(kind, two, record_verification):
    """Tetrahedra are compared among themselves: the two walls are mirror images of each other, their cells too."""
    both = two if kind is HEXAHEDRON else _two(kind)
    others = {"a rigid plane": _plane(kind), "a mirror plane": _mirror(kind)}
    for name, other in others.items():
        difference, allowed = _compare(both, other)
        record_verification(
            claim=f"two walls in self-contact against one and {name}, {kind.name}: largest difference over the gap",
            source="V16-3, exact",
            expected=0.0,
            got=difference / GAP,
            tolerance="0.5 % and the penetration",
        )
        assert difference < allowed
        assert max(touch.penetration for touch in other.touches.values()) < 2e-3 * GAP


def test_separate_bodies_of_other_meshes(two, record_verification):
    difference, allowed = _compare(two, _bodies())
    record_verification(
        claim="two walls of one body against two bodies of 8 and 11 cells: largest difference over the gap",
        source="V16-3, exact",
        expected=0.0,
        got=difference / GAP,
        tolerance="1 % and the penetration",
    )
    assert difference < allowed + 0.005 * GAP
