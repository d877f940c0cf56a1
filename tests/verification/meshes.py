"""Structured meshes for the verification tests.

A `Block` is a lattice of nx × ny × nz cubes over the parameters 0..1, each one hexahedron or cut into six tetrahedra
along the same body diagonal (Kuhn), and placed in space by a smooth map. Blocks that share a side are glued by
position; their diagonals match when both count the shared parameters in the same direction.

Plane strain is a slab of one layer with ``Fixed("z0", "z"), Fixed("z1", "z")``. The nodes half way between stay
free in z: the exact solution has no displacement there, so they are ordinary unknowns of a three-dimensional
problem whose answer happens to be plane, and the slab stays a test of the whole cell. `test_tube.py` measures
how plane the answer is.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import permutations

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.cells.reference import reference_nodes
from turgor.core.meshing.cells import HEXAHEDRON, TETRAHEDRON, CellType, cell_type
from turgor.core.meshing.mesh import TETRAHEDRON_EDGES, Mesh

Array = NDArray[np.float64]
Map = Callable[[Array], Array]

SIDES = ("x0", "x1", "y0", "y1", "z0", "z1")


@dataclass(frozen=True)
class Block:
    """A lattice of cubes, where it lies, and what its six sides are called (unnamed sides are inside the body).

    ``mirrored`` is set where the map turns a right hand into a left one.
    """

    counts: tuple[int, int, int]
    place: Map = field(default=lambda parameters: parameters)
    names: Mapping[str, str] = field(default_factory=lambda: {side: side for side in SIDES})
    mirrored: bool = False


def _kuhn_cells(counts: tuple[int, int, int]) -> NDArray[np.int64]:
    """Lattice positions (twice the cube index) of the vertices of all tetrahedra, (c, 4, 3), positively oriented."""
    corners = 2 * np.stack(np.meshgrid(*(np.arange(n) for n in counts), indexing="ij"), axis=-1).reshape(-1, 3)
    cells = []
    for order in permutations(range(3)):
        steps = np.zeros((4, 3), dtype=np.int64)
        for k, axis in enumerate(order):
            steps[k + 1] = steps[k]
            steps[k + 1, axis] += 2
        if np.linalg.det(steps[1:] - steps[0]) < 0:
            steps[[1, 2]] = steps[[2, 1]]
        cells.append(corners[:, None, :] + steps)
    return np.concatenate(cells)


def _cubes(block: Block, kind: CellType) -> NDArray[np.int64]:
    """Lattice positions (twice the cube index) of the nodes of one hexahedron a cube, (c, nodes, 3)."""
    corners = 2 * np.stack(np.meshgrid(*(np.arange(n) for n in block.counts), indexing="ij"), axis=-1).reshape(-1, 3)
    nodes = np.rint(2 * reference_nodes(HEXAHEDRON.nodes)[: kind.nodes]).astype(np.int64)
    if block.mirrored:  # count the third parameter backwards, so that the map turns the cell right again
        nodes[:, 2] = 2 - nodes[:, 2]
    return corners[:, None, :] + nodes


def _tetrahedra(block: Block) -> NDArray[np.int64]:
    vertices = _kuhn_cells(block.counts)[:, [0, 2, 1, 3] if block.mirrored else [0, 1, 2, 3]]
    middles = np.stack([(vertices[:, a] + vertices[:, b]) // 2 for a, b in TETRAHEDRON_EDGES], axis=1)
    return np.concatenate([vertices, middles], axis=1)


def _lattice_faces(nodes: NDArray[np.int64], block: Block, kind: CellType) -> dict[str, NDArray[np.int64]]:
    """Which side of which cell lies on each named side of the block: rows (cell, side of the cell)."""
    results: dict[str, NDArray[np.int64]] = {}
    for side, name in block.names.items():
        axis, end = "xyz".index(side[0]), int(side[1])
        on = nodes[:, :, axis] == 2 * block.counts[axis] * end
        hits = [(np.flatnonzero(on[:, list(f)].all(axis=1)), k) for k, f in enumerate(kind.sides)]
        rows = np.concatenate([np.column_stack([cells, np.full(len(cells), k)]) for cells, k in hits])
        results[name] = np.concatenate([results[name], rows]) if name in results else rows
    return results


def glued(blocks: Sequence[Block], *, straight: bool = False, kind: CellType = TETRAHEDRON) -> Mesh:
    """Mesh of blocks that touch; ``straight`` puts mid-side nodes half way between their vertices."""
    positions, cells, faces, start = [], [], {}, 0
    for block in blocks:
        nodes = _tetrahedra(block) if kind is TETRAHEDRON else _cubes(block, kind)
        positions.append(block.place(nodes.reshape(-1, 3) / (2.0 * np.array(block.counts))))
        for name, rows in _lattice_faces(nodes, block, kind).items():
            faces.setdefault(name, []).append(rows + [start, 0])
        start += len(nodes)
        cells.append(nodes)
    points = np.concatenate(positions)
    size = np.ptp(points, axis=0).max()
    _, first, inverse = np.unique(np.round(points / size, 9), axis=0, return_index=True, return_inverse=True)
    points, connectivity = points[first], inverse.reshape(-1, kind.nodes)
    triangles = {
        name: np.array([connectivity[cell, list(kind.sides[k])] for cell, k in np.concatenate(rows)])
        for name, rows in faces.items()
    }
    return _ordered(points, connectivity, triangles, straight)


def _ordered(
    points: Array, cells: NDArray[np.int64], faces: dict[str, NDArray[np.int64]], straight: bool = False
) -> Mesh:
    """Number vertices first and build the mesh of a single region, ``body``."""
    is_vertex = np.zeros(len(points), dtype=bool)
    kind = cell_type(cells.shape[1])
    is_vertex[cells[:, : kind.corners]] = True
    order = np.argsort(~is_vertex, kind="stable")
    number = np.argsort(order)
    points, cells = points[order], number[cells]
    if straight:
        for k, (a, b) in enumerate(kind.edges):
            points[cells[:, kind.corners + k]] = (points[cells[:, a]] + points[cells[:, b]]) / 2
    faces = {name: number[triangles] for name, triangles in faces.items()}
    return Mesh(points=points, cells=cells, regions={"body": np.arange(len(cells))}, faces=faces)


def box(
    size: tuple[float, float, float],
    counts: tuple[int, int, int],
    place: Map | None = None,
    *,
    kind: CellType = TETRAHEDRON,
) -> Mesh:
    """Box from the origin to ``size`` with faces x0 … z1, optionally placed by a smooth map."""
    scale = np.array(size, dtype=np.float64)
    move = place or (lambda points: points)
    return glued([Block(counts, lambda parameters: move(parameters * scale))], kind=kind)


def bent_block() -> Mesh:
    """Block of 30 × 10 × 10 mm whose axis is bent and whose sections are sheared."""

    def bent(X: Array) -> Array:
        return X + np.column_stack([0 * X[:, 0], 0.1 * X[:, 0] ** 2 / 0.03, 0.05 * X[:, 0] * X[:, 1] / 0.01])

    return box((0.03, 0.01, 0.01), (6, 2, 2), bent)


def tube_sector(
    inner: float,
    outer: float,
    height: float,
    counts: tuple[int, int, int],
    *,
    straight: bool = False,
    kind: CellType = TETRAHEDRON,
) -> Mesh:
    """Quarter of a tube around z; counts are radial, around, along; faces cavity, outside, symmetry_x/y, z0, z1."""

    def place(parameters: Array) -> Array:
        r = inner + (outer - inner) * parameters[:, 0]
        angle = np.pi / 2 * parameters[:, 1]
        return np.column_stack([r * np.cos(angle), r * np.sin(angle), height * parameters[:, 2]])

    names = dict(zip(SIDES, ("cavity", "outside", "symmetry_y", "symmetry_x", "z0", "z1"), strict=True))
    return glued([Block(counts, place, names)], straight=straight, kind=kind)


def sphere_octant(
    inner: float,
    outer: float,
    around: int,
    through: int,
    *,
    straight: bool = False,
    kind: CellType = TETRAHEDRON,
) -> Mesh:
    """One eighth of a thick sphere: three blocks that meet at the diagonal. Faces cavity, outside, symmetry_x/y/z."""
    blocks = []
    for axis in range(3):
        s, t = (axis + 1) % 3, (axis + 2) % 3

        def place(parameters: Array, s: int = s, t: int = t) -> Array:
            direction = np.ones((len(parameters), 3))
            direction[:, s] = np.tan(np.pi / 4 * parameters[:, 0])
            direction[:, t] = np.tan(np.pi / 4 * parameters[:, 1])
            direction /= np.linalg.norm(direction, axis=1)[:, None]
            return np.asarray(direction * (inner + (outer - inner) * parameters[:, 2:]))

        names = {"x0": f"symmetry_{'xyz'[s]}", "y0": f"symmetry_{'xyz'[t]}", "z0": "cavity", "z1": "outside"}
        blocks.append(Block((around, around, through), place, names))
    return glued(blocks, straight=straight, kind=kind)


def hollow_box(cells: int = 3) -> Mesh:
    """Cube of side 1 of ``cells``³ smaller cubes without the inner ones: faces x0 … z1, cavity."""
    lattice = np.stack(np.meshgrid(*3 * [np.arange(cells)], indexing="ij"), axis=-1).reshape(-1, 3)
    inside = {tuple(c) for c in lattice if c.min() > 0 and c.max() < cells - 1}
    blocks = []
    for corner in map(tuple, lattice):
        if corner in inside:
            continue
        names = {}
        for side in SIDES:
            axis, end = "xyz".index(side[0]), int(side[1])
            neighbor = tuple(c + (2 * end - 1) * (a == axis) for a, c in enumerate(corner))
            if neighbor in inside:
                names[side] = "cavity"
            elif neighbor[axis] in (-1, cells):
                names[side] = side
        blocks.append(Block((1, 1, 1), lambda p, corner=corner: (p + np.array(corner)) / cells, names))
    return glued(blocks)


def blind_tube() -> Mesh:
    """Box 3 × 3 × 4 cubes with a square bore that opens on the face x0 and ends blind; faces x0 … z1, cavity."""
    blocks = []
    for corner in np.ndindex(4, 3, 3):
        bore = corner[0] < 3 and corner[1:] == (1, 1)
        if bore:
            continue
        names = {}
        for side in SIDES:
            axis, end = "xyz".index(side[0]), int(side[1])
            neighbor = tuple(c + (2 * end - 1) * (a == axis) for a, c in enumerate(corner))
            if 0 <= neighbor[0] < 3 and neighbor[1:] == (1, 1):
                names[side] = "cavity"
            elif neighbor[axis] in (-1, (4, 3, 3)[axis]):
                names[side] = side
        blocks.append(Block((1, 1, 1), lambda p, corner=corner: p + np.array(corner, dtype=float), names))
    return glued(blocks)


def two_cavities() -> Mesh:
    """Bar 4 × 3 × 5 bricks of 10 × 6 × 2 mm with one void above the other: x0 … z1, cavity_1 (below), cavity_2."""
    counts, size = (4, 3, 5), np.array([10e-3, 6e-3, 2e-3])
    voids = {(x, 1, z): name for x in (1, 2) for z, name in ((1, "cavity_1"), (3, "cavity_2"))}
    blocks = []
    for corner in np.ndindex(counts):
        if corner in voids:
            continue
        names = {}
        for side in SIDES:
            axis, end = "xyz".index(side[0]), int(side[1])
            neighbor = tuple(c + (2 * end - 1) * (a == axis) for a, c in enumerate(corner))
            if neighbor in voids:
                names[side] = voids[neighbor]
            elif neighbor[axis] in (-1, counts[axis]):
                names[side] = side
        blocks.append(Block((1, 1, 1), lambda p, corner=corner: (p + np.array(corner)) * size, names))
    return glued(blocks)


def surface(mesh: Mesh) -> NDArray[np.int64]:
    """All six-node triangles that belong to one cell only, pointing out of the body."""
    triangles = np.concatenate([mesh.cells[:, list(f)] for f in TETRAHEDRON.sides])
    _, first, count = np.unique(np.sort(triangles[:, :3], axis=1), axis=0, return_index=True, return_counts=True)
    return triangles[first[count == 1]]


def with_faces(mesh: Mesh, **more: NDArray[np.int64]) -> Mesh:
    """The mesh with more named faces."""
    return Mesh(points=mesh.points, cells=mesh.cells, regions=mesh.regions, faces={**mesh.faces, **more})


def with_points(mesh: Mesh, points: Array) -> Mesh:
    """The mesh with its nodes elsewhere."""
    return Mesh(points=points, cells=mesh.cells, regions=mesh.regions, faces=mesh.faces)


def single_node(node: int, sides: int = 6) -> NDArray[np.int64]:
    """A degenerate face that holds one node, to pin it."""
    return np.full((1, sides), node)


def shuffled(mesh: Mesh, rng: np.random.Generator) -> tuple[Mesh, NDArray[np.int64]]:
    """The same body with nodes and cells in another order, and the new number of each old node."""
    v, n = mesh.vertex_count, len(mesh.points)
    number = np.concatenate([rng.permutation(v), v + rng.permutation(n - v)])
    points = np.empty_like(mesh.points)
    points[number] = mesh.points
    order = rng.permutation(len(mesh.cells))
    turned = number[mesh.cells[order]][:, [1, 2, 0, 3, 5, 6, 4, 8, 9, 7]]  # also start each cell at another vertex
    faces = {name: number[rng.permutation(triangles)] for name, triangles in mesh.faces.items()}
    return Mesh(points=points, cells=turned, regions={"body": np.arange(len(turned))}, faces=faces), number


def node_at(mesh: Mesh, position: Sequence[float]) -> int:
    """The node nearest to a reference position."""
    return int(np.linalg.norm(mesh.points - np.array(position), axis=1).argmin())
