"""Boxes of lattice cells for tests of meshes and elements: hexahedra or tetrahedra, straight or curved by a map."""

from collections.abc import Callable
from itertools import permutations

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.cells.reference import reference_nodes
from turgor.core.meshing.cells import HEXAHEDRON, TETRAHEDRON, CellType
from turgor.core.meshing.mesh import Mesh
from turgor.core.meshing.refining.refinement import Refinement
from turgor.core.meshing.refining.split import refine_tetrahedra
from turgor.core.meshing.refining.split_hexahedra import refine_hexahedra, sheets

Array = NDArray[np.float64]
Ints = NDArray[np.int64]
KINDS = {"hex": HEXAHEDRON, "tet": TETRAHEDRON}


def curved(points: Array) -> Array:
    """A smooth quadratic map of the unit cube, so that sides are curved."""
    x, y, z = points.T
    return np.column_stack([x + 0.1 * y * y, y + 0.1 * x * z, z + 0.08 * x * x - 0.05 * x * y])


def lattice(
    counts: tuple[int, int, int], kind: CellType, place: Callable[[Array], Array] = lambda points: points
) -> Mesh:
    """Unit cube of counts cubes: regions ``left`` and ``right`` of x = 1/2, faces x0, x1, ``middle`` (x = 1/2).

    The face ``patch`` is the part of ``middle`` below y = 1/2, so that its rim lies inside the body.
    """
    corners = 2 * np.stack(np.meshgrid(*(np.arange(n) for n in counts), indexing="ij"), axis=-1).reshape(-1, 3)
    nodes = _cubes(corners) if kind is HEXAHEDRON else _tetrahedra(corners)
    result, inverse = np.unique(nodes.reshape(-1, 3), axis=0, return_inverse=True)
    cells = inverse.reshape(nodes.shape[:2])
    middle = np.ones(len(result), dtype=bool)
    middle[cells[:, : kind.corners]] = False
    order = np.argsort(middle, kind="stable")
    cells, at = np.argsort(order)[cells], result[order] / (2.0 * np.array(counts))
    center = at[cells[:, : kind.corners]].mean(axis=1)
    sides = np.concatenate([cells[:, list(side)] for side in kind.sides])
    of_side = np.tile(np.arange(len(cells)), len(kind.sides))
    left = center[of_side, 0] < 0.5
    x, y = at[sides][..., 0], at[sides][..., 1]
    half = left & (np.abs(x - 0.5) < 1e-9).all(axis=1)
    on = {"x0": (x < 1e-9).all(axis=1), "x1": (x > 1 - 1e-9).all(axis=1), "middle": half}
    on["patch"] = half & (y < 0.5 + 1e-9).all(axis=1)
    return Mesh(
        points=place(at),
        cells=cells,
        regions={"left": np.flatnonzero(center[:, 0] < 0.5), "right": np.flatnonzero(center[:, 0] > 0.5)},
        faces={name: sides[rows] for name, rows in on.items()},
    )


def refined(mesh: Mesh, share: float) -> Refinement:
    """Refine by a share of the edges or sheets, drawn by chance."""
    rng = np.random.default_rng(4)
    if mesh.cell_type is HEXAHEDRON:
        count = int(sheets(mesh).max()) + 1
        return refine_hexahedra(mesh, np.sort(rng.permutation(count)[: max(1, round(share * count))]))
    edges = np.unique(np.sort(mesh.cells[:, np.array(TETRAHEDRON.edges)].reshape(-1, 2), axis=1), axis=0)
    return refine_tetrahedra(mesh, rng.permutation(edges)[: max(1, round(share * len(edges)))])


def _cubes(corners: Ints) -> Ints:
    return corners[:, None] + np.rint(2 * reference_nodes(HEXAHEDRON.nodes)).astype(np.int64)


def _tetrahedra(corners: Ints) -> Ints:
    """Six tetrahedra of each cube along one diagonal (Kuhn)."""
    cells = []
    for order in permutations(range(3)):
        steps = np.zeros((4, 3), dtype=np.int64)
        for k, axis in enumerate(order):
            steps[k + 1 :, axis] += 2
        if np.linalg.det(steps[1:] - steps[0]) < 0:
            steps[[1, 2]] = steps[[2, 1]]
        cells.append(corners[:, None] + steps)
    vertices = np.concatenate(cells)
    mids = np.stack([(vertices[:, a] + vertices[:, b]) // 2 for a, b in TETRAHEDRON.edges], axis=1)
    return np.concatenate([vertices, mids], axis=1)
