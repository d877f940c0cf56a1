"""Bending of shells: derivatives, rigid motions, folds, winding, held edges, stability, what is refused."""

from dataclasses import replace

import numpy as np
import pytest
from turgor.supports import ReferencePoint

import turgor as tg
from refused import refused
from turgor.core.engine.cells.reference import reference_nodes
from turgor.core.engine.faces import plate_edges
from turgor.core.engine.faces.plate_terms import HingeTerm, PlateTerm
from turgor.core.engine.faces.settings import PLATE
from turgor.core.engine.system import System
from turgor.core.engine.term import Configuration
from turgor.core.meshing.cells import HEXAHEDRON, TETRAHEDRON
from turgor.core.meshing.mesh import TETRAHEDRON_EDGES, Mesh

SHEET = tg.Shell(tg.Material(name="sheet", law=tg.laws.Hooke(E=5e7, nu=0.3)), 1e-3)
RUBBER = tg.Material(name="rubber", law=tg.laws.NeoHooke(C10=1e5))
SIDE = 0.01
#: A cube is cut into six tetrahedra around one diagonal; columns of corners in order of x, y, z.
KUHN = [(0, 1, 3, 7), (0, 5, 1, 7), (0, 3, 2, 7), (0, 2, 6, 7), (0, 4, 5, 7), (0, 6, 4, 7)]


def _block(counts, curved, kind=TETRAHEDRON):
    """Cubes of 10 mm, each a hexahedron or cut into tetrahedra, faces x0 … z1; ``curved`` bends the sides."""
    n = np.array(counts) + 1
    grid = np.stack(np.meshgrid(*(np.arange(k) for k in n), indexing="ij"), axis=-1).reshape(-1, 3)
    cubes = [c for c in grid if (c < np.array(counts)).all()]
    if kind is TETRAHEDRON:
        corner = np.array([(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)])
        cells = np.array([c + corner[list(tetra)] for c in cubes for tetra in KUHN], dtype=float)
        cells = np.concatenate([cells, cells[:, np.array(TETRAHEDRON_EDGES)].mean(axis=2)], axis=1)
    else:
        cells = np.array([c + reference_nodes(kind.nodes) for c in cubes])
    points, cells = np.unique(cells.reshape(-1, 3), axis=0, return_inverse=True)
    middle = (points % 1 != 0).any(axis=1)  # vertices come first
    order = np.argsort(middle, kind="stable")
    points, cells = SIDE * points[order], np.argsort(order)[cells].reshape(-1, kind.nodes)
    faces = {}
    for axis, name in enumerate("xyz"):
        for end in (0, 1):
            on = np.abs(points[:, axis] - SIDE * counts[axis] * end) < 1e-9
            sides = cells[:, np.array(kind.sides)].reshape(-1, kind.side.nodes)
            faces[f"{name}{end}"] = sides[on[sides].all(axis=1)]
    if curved:
        points = points + 3 * points[:, [1, 2, 0]] ** 2
    return Mesh(points=points, cells=cells, regions={"body": np.arange(len(cells))}, faces=faces)


def _system(faces=("z1",), supports=(), mesh=None):
    mesh = mesh or _block((2, 2, 1), curved=True)
    return System(tg.Model(mesh, {"body": RUBBER} | dict.fromkeys(faces, SHEET), list(supports), []))


def _bending(system):
    return [term for term in system.terms.all if isinstance(term, PlateTerm | HingeTerm)]


def _deformed(system, seed=3):
    rng = np.random.default_rng(seed)
    X = system.points
    return X + X @ (0.3 * rng.uniform(-1, 1, (3, 3))) + 0.1 * X[:, [2, 0, 1]] * X + rng.normal(0, 0.01, X.shape)


def _turned(points):
    turn = np.linalg.qr(np.random.default_rng(1).normal(size=(3, 3)))[0]
    return points @ (turn * np.sign(np.linalg.det(turn))) + 3.0


def _held(system):
    """Edges that sides of the body hold, by the midpoints of both corners in cubes."""
    hinges = [term for term in _bending(system) if isinstance(term, HingeTerm)]
    one_sided = [h for h in hinges if not h.moments[:, 1].any()]
    results = [np.sort(h.nodes[k][np.abs(h.along[k]) > 1e-9])[:2] for h in one_sided for k in range(len(h.nodes))]
    return sorted({tuple(np.round(system.model.mesh.points[ends].mean(axis=0) / SIDE, 6).tolist()) for ends in results})


KINDS = (TETRAHEDRON, HEXAHEDRON)
CASES = {
    "free": ((), ("z1",)),
    "clamped": ((tg.Fixed("x0"),), ("z1",)),
    "guided and folded": ((tg.Fixed("x0", "x"),), ("z1", "y1")),
}


@pytest.mark.parametrize("kind", KINDS, ids=["tetrahedra", "hexahedra"])
@pytest.mark.parametrize("case", CASES)
def test_forces_and_tangents_are_derivatives(case, kind):
    mesh = _block((2, 2, 1), case != "guided and folded", kind)
    system = _system(CASES[case][1], CASES[case][0], mesh=mesh)
    x, h = _deformed(system), 1e-5
    way = np.random.default_rng(5).normal(size=x.shape)
    assert len(_bending(system)) == (2 if case == "free" else 3)
    for term in _bending(system):
        forces = [np.zeros_like(x) for _ in range(3)]
        for out, step in zip(forces, (0.0, h, -h), strict=True):
            term.add_forces(out, Configuration(x + step * way))
        change = (forces[1] - forces[2]).ravel() / (2 * h)
        slope = (term.energy(x + h * way) - term.energy(x - h * way)) / (2 * h)
        work = forces[0] * way
        assert work.sum() == pytest.approx(slope, abs=1e-7 * np.abs(work).sum())
        assert _product(term, x, way) == pytest.approx(change, abs=1e-7 * np.abs(change).max())
        up, down, at = (term.stresses(x + step * way, 0 * x) for step in (h, -h, 0.0))
        linear = (up - down) / (2 * h)
        assert term.stresses(x, way) - at == pytest.approx(linear, abs=1e-7 * np.abs(linear).max())


def _product(term, x, way):
    """Tangent times a direction."""
    size = term.unknowns.shape[1]
    rows, columns = np.tril_indices(size)
    K = np.zeros((len(term.nodes), size, size))
    K[:, rows, columns] = term.tangents(Configuration(x), term.stresses(x, 0 * x)).reshape(len(K), -1)
    K[:, columns, rows] = K[:, rows, columns]
    out = np.zeros(x.size)
    np.add.at(out, term.unknowns, np.einsum("kij,kj->ki", K, way.ravel()[term.unknowns]))
    return out


@pytest.mark.parametrize("kind", KINDS, ids=["tetrahedra", "hexahedra"])
def test_rigid_motions_cost_nothing(kind):
    """A curved sheet over a fold, turned by a large angle; and a turned deformation costs what it did."""
    system = _system(("z1", "y1"), mesh=_block((2, 2, 1), True, kind))
    x, still = _deformed(system), np.zeros_like(system.points)
    for term in _bending(system):
        assert abs(term.energy(_turned(system.points))) < 1e-20
        term.add_forces(still, Configuration(_turned(system.points)))
        assert term.energy(_turned(x)) == pytest.approx(term.energy(x), rel=1e-9)
    assert np.abs(still).max() < 1e-10


@pytest.mark.parametrize("kind", KINDS, ids=["tetrahedra", "hexahedra"])
def test_a_fold_keeps_its_angle(kind):
    """Two faces of equal sheets are one sheet that is folded at the edge; two different sheets are hinged there."""
    mesh = _block((1, 1, 1), False, kind)
    opened = mesh.points.copy()
    opened[:, 2] += np.where(mesh.points[:, 1] >= SIDE - 1e-9, 0.0, 0.2 * (SIDE - mesh.points[:, 1]))
    thinner = replace(SHEET, thickness=0.9e-3)
    energies = []
    for other in (SHEET, thinner):
        system = System(tg.Model(mesh, {"body": RUBBER, "z1": SHEET, "y1": other}, [], []))
        energies.append(sum(term.energy(opened / system.length) for term in _bending(system)))
    assert energies[0] > 1e-3
    assert abs(energies[1]) < 1e-15


@pytest.mark.parametrize("kind", KINDS, ids=["tetrahedra", "hexahedra"])
def test_the_winding_of_sides_does_not_count(kind):
    mesh = _block((2, 2, 1), True, kind)
    faces = {name: sides.copy() for name, sides in mesh.faces.items()}
    other_way = [0, 2, 1, 5, 4, 3] if kind is TETRAHEDRON else [0, 3, 2, 1, 7, 6, 5, 4, 8]
    faces["z1"][::3] = faces["z1"][::3][:, other_way]
    turned = Mesh(points=mesh.points, cells=mesh.cells, regions=mesh.regions, faces=faces)
    first, second = _system(mesh=mesh), _system(mesh=turned)
    x = _deformed(first)
    energies = [sum(term.energy(x) for term in _bending(system)) for system in (first, second)]
    assert energies[0] > 0
    assert energies[1] == pytest.approx(energies[0], rel=1e-9)


RIM = {"x0": [(0.0, 0.5, 1.0), (0.0, 1.5, 1.0)], "y0": [(0.5, 0.0, 1.0), (1.5, 0.0, 1.0)]}
HOLDING = {
    "clamp": ([tg.Fixed("x0")], RIM["x0"]),
    "mirror plane": ([tg.Fixed("x0", "x")], RIM["x0"]),
    "both": ([tg.Fixed("x0", "x"), tg.Fixed("y0")], RIM["x0"] + RIM["y0"]),
    "hinge": ([tg.Fixed("x0", "z")], []),
    "free": ([], []),
    "rigid plate": ([ReferencePoint("plate", "x0", coupling="rigid")], RIM["x0"]),
    "averaging point": ([ReferencePoint("plate", "x0", coupling="averaging")], []),
}


@pytest.mark.parametrize("kind", KINDS, ids=["tetrahedra", "hexahedra"])
@pytest.mark.parametrize("name", HOLDING)
def test_which_edges_are_held(name, kind):
    supports, expected = HOLDING[name]
    assert _held(_system(supports=supports, mesh=_block((2, 2, 1), False, kind))) == sorted(expected)


def test_a_held_side_that_goes_on_in_the_plane_of_the_sheet_is_a_hinge():
    mesh = _block((2, 1, 1), curved=False)
    left = mesh.points[mesh.faces["z1"]].mean(axis=1)[:, 0] < SIDE
    faces = mesh.faces | {"left": mesh.faces["z1"][left], "right": mesh.faces["z1"][~left]}
    mesh = Mesh(points=mesh.points, cells=mesh.cells, regions=mesh.regions, faces=faces)
    assert _held(_system(("right",), [tg.Fixed("left")], mesh=mesh)) == []


def test_branches_are_refused():
    mesh = _block((2, 1, 1), curved=False)
    sides = mesh.cells[:, np.array(TETRAHEDRON.sides)].reshape(-1, 6)
    inner = sides[(np.abs(mesh.points[sides][:, :, 0] - SIDE) < 1e-9).all(axis=1)]
    _, first = np.unique(np.sort(inner, axis=1), axis=0, return_index=True)
    faces = mesh.faces | {"web": inner[first]}
    mesh = Mesh(points=mesh.points, cells=mesh.cells, regions=mesh.regions, faces=faces)
    with refused("z1", "web", 3, "(10, 5, 10) mm"):
        _system(("z1", "web"), mesh=mesh)


@pytest.mark.parametrize("penalty", [3.01, None])
@pytest.mark.parametrize("kind", KINDS, ids=["tetrahedra", "hexahedra"])
def test_flat_sides_of_any_shape_are_stable(kind, penalty, monkeypatch):
    """No bending costs less than nothing, on stretched and skew sides, clamped or free."""
    if penalty is not None:
        both = replace(PLATE, penalty_triangles=penalty, penalty_quadrilaterals=penalty)
        monkeypatch.setattr(plate_edges, "PLATE", both)
    mesh, rng = _block((3, 3, 1), False, kind), np.random.default_rng(7)
    skew = mesh.points @ np.array([[1.0, 0.7, 0.0], [0.0, 0.3, 0.0], [0.0, 0.0, 1.0]])
    points, corners = skew.copy(), np.unique(mesh.cells[:, : kind.corners])
    points[corners, :2] += rng.uniform(-0.1, 0.1, (len(corners), 2)) * SIDE
    for k, (a, b) in enumerate(kind.edges):
        points[mesh.cells[:, kind.corners + k]] = points[mesh.cells[:, [a, b]]].mean(axis=1)
    for sides in mesh.faces.values() if kind is HEXAHEDRON else ():
        points[sides[:, 8]] = points[sides[:, :4]].mean(axis=1)
    mesh = Mesh(points=points, cells=mesh.cells, regions=mesh.regions, faces=mesh.faces)
    system = _system(supports=[tg.Fixed("x0", "x")], mesh=mesh)
    x = system.points
    nodes = mesh.face_nodes("z1")
    columns = []
    for node in nodes:
        way = np.zeros_like(x)
        way[node, 2] = 1.0
        columns.append(sum(_product(term, x, way) for term in _bending(system))[3 * nodes + 2])
    values = np.linalg.eigvalsh(np.array(columns))
    assert values[0] > -1e-9 * values[-1]
    assert values[-1] > 0


def test_membranes_do_not_bend():
    plain = tg.Membrane(SHEET.material, SHEET.thickness)
    system = System(tg.Model(_block((1, 1, 1), curved=False), {"body": RUBBER, "z1": plain}, [], []))
    assert _bending(system) == []
