"""V12: a slender strip of rubber bends as the elastica: dead and following loads, and a moment that closes a circle.

Problem: a strip 50 mm long, 1 mm thick, plane strain, incompressible neo-Hookean C10 = 0.12 MPa, clamped at one end;
bending stiffness 4μh³/12 per width. (a) dead force at the tip, (b) force at the tip that turns with it, as a pressure
on a last short cell whose middle is the tip, (c) pressure along one side, (d) weight, (e) moment at the end, as
pressures of opposite sign on the halves of a stiff end. Value: displacement of the tip over the length.
Reference: the inextensible elastica (elliptic integrals and boundary value problem agree). Dead and following loads
differ grossly. The moment is 2π times bending stiffness over length.
Tolerance: 1 % of the displacement's length for a solid with L/h = 50; the clamp, which holds the thickness too, costs
half of that.
"""

import numpy as np
import pytest

import meshes
import problems
import turgor as tg
from turgor.core.meshing.cells import HEXAHEDRON

MM = problems.MM
LENGTH, THICKNESS, DENSITY = 50 * MM, 1 * MM, 1000.0
STIFFNESS = 4 * 0.24 * problems.MPA * THICKNESS**3 / 12  # per width

#: Load over bending stiffness; how far the tip moves along and across, over the length.
DEAD_FORCE = ((1, -0.056433, 0.301721), (2, -0.160642, 0.493457), (5, -0.387628, 0.713792), (10, -0.554996, 0.810609))
FOLLOWING_FORCE = (
    (1, 0.935646 - 1, 0.320642), (2, 0.767362 - 1, 0.573839), (4, 0.342746 - 1, 0.786168),
    (8, -0.073863 - 1, 0.633592), (10, -0.092123 - 1, 0.546983), (20, 0.275710 - 1, 0.330158),
)  # fmt: skip
PRESSURE = (
    (1, 0.991104 - 1, 0.124444), (2, 0.964795 - 1, 0.245592), (5, 0.795523 - 1, 0.560423),
    (10, 0.354668 - 1, 0.830148), (15, -0.045627 - 1, 0.809246), (20, -0.291537 - 1, 0.652644),
)  # fmt: skip
WEIGHT = (
    (1, -0.008754, 0.123471), (2, -0.033107, 0.238507), (5, -0.153343, 0.495905), (10, -0.343646, 0.700200),
    (20, -0.554768, 0.829881),
)  # fmt: skip


def _strip(cells=40, layers=1, beyond=0.0):
    """The strip, longer by ``beyond`` cells, and the length of a cell; also faces: halves of its end, its last side."""
    size = LENGTH / (cells - beyond)
    mesh = meshes.box((cells * size, THICKNESS, size), (cells, layers, 1), lambda X: X - [0, THICKNESS / 2, 0],
                      kind=HEXAHEDRON)  # fmt: skip
    middles = {name: mesh.points[mesh.faces[name]].mean(axis=1) for name in ("x1", "y0")}
    upper = middles["x1"][:, 1] > 0
    last = middles["y0"][:, 0] > (cells - 1) * size
    parts = {"upper": mesh.faces["x1"][upper], "lower": mesh.faces["x1"][~upper], "last": mesh.faces["y0"][last]}
    return meshes.with_faces(mesh, **parts), size


def _bend(mesh, loads, table, **more):
    """Displacement of the tip over the length at the loads of a table, the largest of which acts in the end."""
    top = table[-1][0]
    materials = {"body": problems.rubber(problems.NEO_HOOKE, density=DENSITY), **more}
    model = tg.Model(mesh, materials, [tg.Fixed("x0"), *problems.PLANE_STRAIN], loads)
    at = tuple(row[0] / top for row in table)
    solution = problems.solve(model, tg.Static(first_step=min(0.05, at[0]), at=at))
    tip = meshes.node_at(mesh, (LENGTH, 0, 0))
    return np.array([problems.state_at(solution, f).displacement[tip, :2] / LENGTH for f in at])


def _dead_force(cells):
    top = DEAD_FORCE[-1][0] * STIFFNESS / LENGTH**2
    return _bend(_strip(cells)[0], [tg.Traction("x1", (0, top / THICKNESS, 0))], DEAD_FORCE)


def _following_force(cells):
    mesh, size = _strip(cells, beyond=0.5)
    top = FOLLOWING_FORCE[-1][0] * STIFFNESS / LENGTH**2
    return _bend(mesh, [tg.Pressure("last", top / size)], FOLLOWING_FORCE)


def _pressure(cells):
    top = PRESSURE[-1][0] * STIFFNESS / LENGTH**3
    return _bend(_strip(cells)[0], [tg.Pressure("y0", top)], PRESSURE)


def _weight(cells):
    top = WEIGHT[-1][0] * STIFFNESS / LENGTH**3
    return _bend(_strip(cells)[0], [tg.Gravity((0, 1, 0), top / (DENSITY * THICKNESS))], WEIGHT)


CASES = {
    "dead force at the tip": (_dead_force, DEAD_FORCE),
    "force at the tip that follows": (_following_force, FOLLOWING_FORCE),
    "pressure along one side": (_pressure, PRESSURE),
    "weight": (_weight, WEIGHT),
}


def _errors(found, table):
    expected = np.array(table)[:, 1:]
    return np.linalg.norm(found - expected, axis=1) / np.linalg.norm(expected, axis=1)


@pytest.mark.parametrize("name", CASES)
def test_slender_strip(name, record_verification):
    bend, table = CASES[name]
    result = bend(40)
    record_verification(
        claim=f"slender strip, {name}, {', '.join(str(row[0]) for row in table)}: tip (x, y) over the length",
        source="V12, exact",
        expected=[row[1:] for row in table],
        got=result,
        tolerance="1 % of its length",
    )
    assert _errors(result, table).max() < 0.01


def test_moment_closes_the_circle(record_verification):
    """The end is a cell of stiff rubber, so that its two halves stay alike: the pressures leave no force."""
    mesh, _ = _strip(25, layers=2, beyond=1.0)
    head = mesh.points[mesh.cells].mean(axis=1)[:, 0] > LENGTH
    regions = {"body": np.flatnonzero(~head), "head": np.flatnonzero(head)}
    mesh = tg.Mesh(points=mesh.points, cells=mesh.cells, regions=regions, faces=mesh.faces)
    pressure = 4 * 2 * np.pi * STIFFNESS / LENGTH / THICKNESS**2
    loads = [tg.Pressure("upper", pressure), tg.Pressure("lower", -pressure)]
    head_law = tg.laws.NeoHooke(C10=1e3 * problems.NEO_HOOKE.C10)
    ((x, y),) = _bend(mesh, loads, ((1, -1.0, 0.0),), head=problems.rubber(head_law, density=DENSITY))
    record_verification(
        claim="slender strip rolled up by a moment at its end: tip (x, y) over the length",
        source="V12, exact",
        expected=(-1.0, 0.0),
        got=(x, y),
        tolerance="1 % of its length",
    )
    assert np.hypot(x + 1, y) < 0.01


def test_it_settles_with_finer_cells(record_verification):
    """The place where the strip under pressure has turned by 152°, with 10, 20 and 40 cells along it."""
    coarse, fine, finest = (_pressure(cells)[-1] for cells in (10, 20, 40))
    changes = [float(np.linalg.norm(fine - coarse)), float(np.linalg.norm(finest - fine))]
    record_verification(
        claim="slender strip under pressure: how far the tip moves with twice the cells, over the length",
        source="V12, theory",
        expected="each at most a quarter of the one before",
        got=changes,
        tolerance="-",
    )
    assert changes[1] < changes[0] / 4
