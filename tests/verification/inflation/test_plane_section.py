"""V06: a length of a closed tube, cut at a section that stays plane; nothing is prescribed along the axis.

Problem: a quarter of a slice of a tube between a mirror plane and a `PlaneSection`. The thrust of the pressure on the
section stretches the slice, as the closed ends of a long tube do. First the tube of V06 through some of its volumes,
then that of V07, whose outside is held radially, under some of its pressures.
Exact: axial stretch λz and pressure, as in `test_closed_tube` (V06) and `fibers/hoops.py` (V07).
Tolerance: pressure and λz 0.05 %; derivatives against differences 1e-6.
"""

import numpy as np
import pytest
from turgor.supports import PlaneSection, Radial

import meshes
import problems
import turgor as tg
from differences import difference
from refused import refused
from turgor.core.engine.chamber_volumes import Chambers
from turgor.core.engine.system import System
from turgor.core.meshing.cells import HEXAHEDRON, TETRAHEDRON
from turgor.core.model.contact import Contact
from turgor.core.model.obstacles import Obstacle, Plane

MM, MPA = problems.MM, problems.MPA
INNER, OUTER, HEIGHT = 5 * MM, 7 * MM, 1 * MM
HELD_INNER, HELD_OUTER = 6.35 * MM, 8.35 * MM
KINDS = pytest.mark.parametrize("kind", [HEXAHEDRON, TETRAHEDRON], ids=["hex", "tet"])
#: V06: inner stretch, λz, pressure [0.01 MPa]. V07: λz, pressure [0.01 MPa].
FREE = (
    (1.05, 1.10, 1.30, 1.75),
    (1.0008432, 1.0033449, 1.0290983, 1.1650465),
    (1.086377, 2.011274, 4.484376, 6.048794),
)
HELD = ((1.02, 1.05, 1.10, 1.30), (0.9216795, 2.183597, 4.021383, 9.294828))


def cut_tube(kind, radii=(INNER, OUTER), counts=(3, 4, 1), held=False, pressure=None, whole=False):
    """A slice on a mirror plane whose other end is the section; its quarter, or the whole ring about x = 3 mm."""
    made = ring(radii, counts, kind) if whole else meshes.tube_sector(*radii, HEIGHT, counts, kind=kind)
    faces = {"symmetry_z" if name == "z0" else name: sides for name, sides in made.faces.items()}
    mesh = tg.Mesh(points=made.points, cells=made.cells, regions=made.regions, faces=faces)
    supports = [PlaneSection("z1"), *([Radial("outside", axis=(0, 0, 1))] if held else [])]
    if whole:  # rigid motions in the plane
        nodes = {name: meshes.node_at(mesh, place) for name, place in corners(radii[1]).items()}
        mesh = meshes.with_faces(mesh, **{name: meshes.single_node(node, 9) for name, node in nodes.items()})
        supports += [tg.Fixed("right", "y"), tg.Fixed("left", "y"), tg.Fixed("top", "x")]
    loads = [] if pressure is None else [tg.Pressure("cavity", pressure)]
    return problems.one_material(mesh, problems.NEO_HOOKE, supports=supports, loads=loads)


def corners(outer):
    """Places on the outside where the whole ring is held."""
    return {"right": (3 * MM + outer, 0, 0), "left": (3 * MM - outer, 0, 0), "top": (3 * MM, outer, 0)}


def ring(radii, counts, kind):
    """The whole slice."""

    def place(parameters):
        r, angle = radii[0] + (radii[1] - radii[0]) * parameters[:, 0], 2 * np.pi * parameters[:, 1]
        return np.column_stack([r * np.cos(angle) + 3 * MM, r * np.sin(angle), HEIGHT * parameters[:, 2]])

    names = {"x0": "cavity", "x1": "outside", "z0": "z0", "z1": "z1"}
    return meshes.glued([meshes.Block((counts[0], 4 * counts[1], counts[2]), place, names)], kind=kind)


def stretch_of(state):
    """λz, after a look whether the section is plane."""
    moved = state.displacement[state.model.mesh.face_nodes("z1"), 2]
    assert np.ptp(moved) <= 1e-12 * HEIGHT
    return 1 + moved[0] / HEIGHT


@KINDS
def test_a_closed_tube_by_volume(kind, record_verification):
    stretches, axial, pressures = FREE
    ratio = [x**2 * z for x, z in zip(stretches, axial, strict=True)]
    end = ratio[-1] - 1
    asked = tg.VolumeControl(
        volume=end * np.pi * INNER**2 * 2 * HEIGHT, at=tuple((x - 1) / end for x in ratio[:-1]), tolerance=1e-8
    )
    solution = problems.solve(cut_tube(kind), asked)
    states = [problems.state_at(solution, (x - 1) / end) for x in ratio]
    got = [stretch_of(state) for state in states]
    results = [state.pressures["cavity"] / (0.01 * MPA) for state in states]
    claim = f"closed tube, plane section, {kind.name}: λz at the tabulated volumes"
    record_verification(claim, "V06, exact", list(axial), got, "0.05 %")
    assert got == pytest.approx(axial, rel=5e-4)
    assert results == pytest.approx(pressures, rel=5e-4)
    assert got[1] - 1 == pytest.approx(axial[1] - 1, rel=0.02)  # the thrust is not only there, but right


@KINDS
def test_a_tube_held_radially(kind, record_verification):
    axial, pressures = HELD
    model = cut_tube(kind, (HELD_INNER, HELD_OUTER), (2, 4, 1), True, pressures[-1] * 0.01 * MPA)
    at = tuple(p / pressures[-1] for p in pressures)
    solution = problems.solve(model, tg.Static(first_step=at[0], at=at, tolerance=1e-8))
    got = [stretch_of(problems.state_at(solution, factor)) for factor in at]
    claim = f"tube with its outside held radially, plane section, {kind.name}: λz under the tabulated pressures"
    record_verification(claim, "V07, exact", list(axial), got, "0.05 %")
    assert got == pytest.approx(axial, rel=5e-4)
    reaction = problems.reaction(solution.states[-1], "z1")[2]
    assert abs(reaction) < 1e-6 * pressures[-1] * 0.01 * MPA * HELD_INNER**2  # the section is free


def test_the_whole_slice_is_its_quarter():
    """An opening that no mirror plane cuts, away from the origin."""
    pressure = 0.03 * MPA
    quarter, whole = (
        problems.solve(cut_tube(HEXAHEDRON, counts=(2, 3, 1), pressure=pressure, whole=whole), tg.Static()).states[-1]
        for whole in (False, True)
    )
    assert stretch_of(whole) == pytest.approx(stretch_of(quarter), abs=1e-7)


@pytest.mark.parametrize("held", [False, True], ids=["free", "radial"])
@KINDS
def test_the_tangent_is_the_derivative(kind, held, record_verification):
    model = cut_tube(kind, (HELD_INNER, HELD_OUTER), (1, 1, 1), held, 0.02 * MPA)
    system = System(model)
    rng = np.random.default_rng(3)
    unknowns = np.where(system.prescribed, 0.0, 0.01 * rng.standard_normal(system.size))
    free = ~system.prescribed
    tangent = system.tangent(unknowns, 1.0).toarray()[np.ix_(free, free)]
    expected = difference(system, unknowns)[np.ix_(free, free)]
    worst = np.abs(tangent - expected).max() / np.abs(expected).max()
    claim = f"tangent with a plane section, {kind.name}{', held radially' if held else ''}: worst entry"
    record_verification(claim, "differences", 0.0, worst, "1e-6 of the largest")
    assert worst < 1e-6
    assert np.abs(expected - expected.T).max() < 1e-6 * np.abs(expected).max()  # thrust and pressure have a potential


def test_the_thrust_is_the_derivative_of_the_volume():
    """Forces of a pressure of one on walls and section, against the volume's gradient."""
    model = cut_tube(HEXAHEDRON, counts=(1, 2, 1))
    system = System(model, ("cavity",))
    rng = np.random.default_rng(4)
    unknowns = np.where(system.prescribed, 0.0, 0.05 * rng.standard_normal(system.size))
    position = system.points + system.split(unknowns)[0]
    forces = system.joined(system.terms.unit_forces(position, 1)[0])
    gradient = Chambers(system, ["cavity"]).gradients(unknowns)[0] / model.mesh.symmetry_factor
    free = ~system.prescribed
    assert np.abs(forces[free]).max() > 0.1
    assert forces[free] == pytest.approx(gradient[free], abs=1e-10 * np.abs(gradient).max())


def test_motion_goes_on_with_the_section():
    """Modes and a state in time: the section moves as one."""
    model = cut_tube(HEXAHEDRON, counts=(1, 2, 1), pressure=0.01 * MPA)
    heavy = problems.rubber(problems.NEO_HOOKE, density=1100.0)
    model = tg.Model(model.mesh, {"body": heavy}, model.supports, model.loads)
    modes = tg.natural_frequencies(model, count=3)
    nodes = model.mesh.face_nodes("z1")
    assert all(np.ptp(shape[nodes, 2]) < 1e-12 for shape in modes.shapes)
    assert max(np.abs(shape[nodes, 2]).max() for shape in modes.shapes) > 0.01
    static = problems.solve(model, tg.Static()).states[-1]
    slow = problems.solve(model, tg.Dynamic(duration=0.5, mass_damping=200.0)).states[-1]
    assert stretch_of(slow) == pytest.approx(stretch_of(static), abs=2e-5)


@pytest.mark.parametrize(
    ("supports", "facts"),
    [
        ([PlaneSection("cavity")], ["'cavity'", "coordinate plane"]),
        ([PlaneSection("z1"), tg.Fixed("z1", "z")], ["'z1'", "9 of its 9", "along z"]),
        ([PlaneSection("z1"), PlaneSection("z1")], ["'z1'", "shares"]),
        ([PlaneSection("z2")], ["'z2'", "z0, z1"]),
    ],
)
def test_what_is_no_section_is_refused(supports, facts):
    mesh = meshes.tube_sector(INNER, OUTER, HEIGHT, (1, 1, 1), kind=HEXAHEDRON)
    with refused(*facts):
        tg.solve(problems.one_material(mesh, problems.NEO_HOOKE, supports=supports, loads=[tg.Pressure("cavity", 1.0)]))


def test_a_section_alone_leaves_the_body_free():
    mesh = meshes.tube_sector(INNER, OUTER, HEIGHT, (1, 1, 1), kind=HEXAHEDRON)
    free = problems.one_material(mesh, problems.NEO_HOOKE, supports=[PlaneSection("z1")], loads=[])
    with refused("1 of 6", "B01", "'outside'"):
        tg.solve(free)


@pytest.mark.parametrize("more", [{}, {"friction": 0.3}, {"spring": 50.0}], ids=["smooth", "rough", "sprung"])
def test_the_tangent_where_a_plate_presses_on_the_section(more):
    """The pairs that contact couples reach the leader; with friction the tangent is not symmetric."""
    model = cut_tube(HEXAHEDRON, counts=(2, 4, 1), pressure=0.02 * MPA)
    plate = Plane(point=(OUTER - 0.15 * MM, 0, 0), normal=(-1.0, 0.02, -0.3))
    touching = Contact(obstacles=(Obstacle(name="plate", shape=plate, stiffness=1e9, **more),))
    system = System(tg.Model(model.mesh, model.materials, model.supports, model.loads, contact=touching))
    free = ~system.prescribed
    unknowns = np.where(free, 0.004 * np.random.default_rng(6).standard_normal(system.size), 0.0)
    tangent = system.tangent(unknowns, 1.0).toarray()[np.ix_(free, free)]
    expected = difference(system, unknowns, 1e-6)[np.ix_(free, free)]
    (result,) = [each for each in system.evaluate(unknowns, 1.0).contacts.gaps if (each.gap < 0).any()]
    assert (result.x[result.gap < 0][:, 2] > 0.8 * HEIGHT / system.length).any()  # beside the section
    assert np.abs(tangent - expected).max() < 1e-6 * np.abs(expected).max()
