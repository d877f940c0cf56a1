"""V16-1: two blocks with non-matching meshes press on each other as one block would.

Problem: two blocks of 20 × 20 × 10 mm of neo-Hookean rubber, C10 = 0.12 MPa, stand above each other with a gap of 1 mm,
sides free, no friction; the top is pushed down by d. A quarter is modeled.
Exact: nothing happens up to d = 1 mm; then both are in uniaxial compression at λ = 1 − (d − 1)/20, with a nominal
stress of 2 C10 (λ − λ⁻²): −0.03792798, −0.08029630 and −0.183 MPa at d = 2, 3 and 5 mm.
Tolerance: 1e-3 for the stress, because at this contact stiffness of 100 MPa/mm the blocks overlap by 0.4 to 1.8 µm,
which counts; 1e-4 with λ of blocks that overlap by that much. 4 % for the scatter (standard deviation) of the contact
pressure at the nodes, 1 % for the stress anywhere in the blocks: a side meets parts of several opposite sides, and its
quadrature does not see where they end.
"""

import numpy as np
import pytest

import contact_cases
import contact_meshes
import meshes
import problems
import turgor as tg
from problems import MM, MPA
from turgor.core.meshing.cells import HEXAHEDRON, TETRAHEDRON
from turgor.core.model.contact import SELF, Contact
from turgor.core.model.obstacles import SelfContact

STRESSES = {2.0: -0.03792798, 3.0: -0.08029630, 5.0: -0.183}
FARTHEST = 5.0


def _blocks(kind):
    """Quarters of two blocks of 20 × 20 × 10 mm: the lower one of 2 × 2 × 1 cells, the upper one of 3 × 3 × 1."""
    bodies = {}
    names = {"x0": "symmetry_x", "y0": "symmetry_y", "x1": "x1", "y1": "y1", "z0": "z0", "z1": "z1"}
    for name, count, z in (("lower", 2, 0.0), ("upper", 3, 11.0)):
        cube = meshes.Block((count, count, 1), lambda p, z=z: (10 * p + [0, 0, z]) * MM, names)
        bodies[name] = meshes.glued([cube], kind=kind)
    return contact_meshes.together(bodies)


def _model(kind, stiffness=contact_cases.STIFF):
    def down(points, load_factor):
        return np.full_like(points, -FARTHEST * MM * load_factor)

    supports = [tg.Fixed("lower_z0", "z"), tg.Displacement("upper_z1", down, "z")]
    contact = Contact(SelfContact(stiffness=stiffness))
    return tg.Model(_blocks(kind), {"body": problems.rubber(problems.NEO_HOOKE)}, supports, [], contact=contact)


@pytest.fixture(scope="module", params=[HEXAHEDRON, TETRAHEDRON], ids=lambda kind: kind.name)
def solution(request):
    at = (1 / FARTHEST, *(d / FARTHEST for d in STRESSES))
    return problems.solve(_model(request.param), tg.Static(first_step=0.1, at=at, tolerance=1e-8))


def _stress(state):
    """Nominal stress from the reaction below [MPa]."""
    return -problems.reaction(state, "lower_z0")[2] / (10 * MM) ** 2 / MPA


def _cells(state):
    return state.model.mesh.cell_type.name


def test_nothing_happens_before_they_touch(solution):
    state = problems.state_at(solution, 1 / FARTHEST)
    assert np.abs(state.touches[SELF].force).max() == 0
    assert np.abs(state.nodal_force).max() < 1e-9
    assert state.touches[SELF].area == 0


def test_stress_is_that_of_one_block(solution, record_verification):
    got = [_stress(problems.state_at(solution, d / FARTHEST)) for d in STRESSES]
    record_verification(
        claim=f"two blocks pressed together, {_cells(solution.states[-1])}: nominal stress at d = 2, 3, 5 mm [MPa]",
        source="V16-1, exact",
        expected=list(STRESSES.values()),
        got=got,
        tolerance="1e-3",
    )
    assert got == pytest.approx(list(STRESSES.values()), rel=1e-3)
    assert got == pytest.approx([_with_overlap(d) for d in STRESSES], rel=1e-4)


def _with_overlap(d):
    """The stress at an overlap of pressure over stiffness: of the nominal stress, since both are per initial area."""
    stress = 0.0
    for _ in range(20):
        stretch = 1 - (d - 1 + stress * MPA / contact_cases.STIFF / MM) / 20
        stress = 2 * 0.12 * (stretch - stretch**-2)
    return stress


def test_deformation_and_pressure_are_uniform(solution, record_verification):
    state = problems.state_at(solution, 1.0)
    exact = 0.183 * 0.8
    stress = problems.fields(state).cauchy / MPA
    uneven = float(np.abs(stress - np.diag([0, 0, -exact])).max()) / exact
    touch = state.touches[SELF]
    nodes = np.union1d(*(state.model.mesh.face_nodes(name) for name in ("lower_z1", "upper_z0")))
    pressure = touch.pressure[nodes] / MPA
    scatter = float(pressure.std() / exact)
    record_verification(
        claim=f"two blocks pressed together, {_cells(state)}: stress off exact, scatter of the contact pressure",
        source="V16-1, exact",
        expected=[0.0, 0.0],
        got=[uneven, scatter],
        tolerance="1 %, 4 %",
    )
    assert uneven < 0.01
    assert scatter < 0.04
    assert pressure.mean() == pytest.approx(exact, rel=0.01)
    assert touch.area == pytest.approx(2 * 1e-4 / 0.8, rel=0.02)  # both sides count
