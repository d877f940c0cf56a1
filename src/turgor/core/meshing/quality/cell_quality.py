"""Quality of cells: Jacobian determinant of the curved cells, shape and size, with the formulas for tetrahedra."""

from dataclasses import dataclass
from itertools import product

import numpy as np
from numpy.typing import NDArray

from turgor.core.meshing.cells import TETRAHEDRON
from turgor.core.meshing.mesh import TETRAHEDRON_EDGES, Mesh
from turgor.core.meshing.quality.hexahedra_quality import hexahedra_jacobian_range, hexahedra_shapes, hexahedra_volumes
from turgor.core.meshing.quality.settings import CHUNK
from turgor.foundation.errors import TurgorError

Array = NDArray[np.float64]

#: The Jacobian determinant of a quadratic tetrahedron is a cubic polynomial; a lattice of 35 points samples it, among
#: them the 10 nodes.
LATTICE_ORDER = 4


@dataclass(frozen=True, slots=True, kw_only=True)
class MeshQuality:
    """Counts, sizes and shape of the cells of a mesh.

    Parameters
    ----------
    cells, points, vertices, unknowns : int
        Counts; unknowns are the degrees of freedom, displacement components and mean stresses, before supports.
    inverted : int
        Cells whose Jacobian is not positive everywhere; none in a mesh that can be solved.
    min_jacobian_ratio : float [-]
        Smallest over largest Jacobian within the worst cell: 1 for straight edges, ≤ 0 for an inverted cell.
    min_shape, mean_shape : float [-]
        Shape of the cells with straight edges: 1 is regular, 0 is flat. For tetrahedra the mean ratio
        12 (3 V)^(2/3) / Σ l²; for hexahedra the scaled Jacobian, the triple product of the unit vectors along the edges
        at the worst corner.
    min_edge, mean_edge, max_edge : float [m]
        Distances between vertices that share an edge.
    """

    cells: int
    points: int
    vertices: int
    unknowns: int
    inverted: int
    min_jacobian_ratio: float
    min_shape: float
    mean_shape: float
    min_edge: float
    mean_edge: float
    max_edge: float


def _lattice() -> Array:
    """Barycentric coordinates of the lattice points, (p, 4)."""
    return np.array([p for p in product(range(LATTICE_ORDER + 1), repeat=4) if sum(p) == LATTICE_ORDER]) / LATTICE_ORDER


def _gradients(L: Array) -> Array:
    """Derivatives of the ten shape functions at points in barycentric coordinates, (p, 10, 3)."""
    dL = np.vstack([-np.ones(3), np.eye(3)])
    corners = (4 * L[:, :, None] - 1) * dL
    mids = [4 * (L[:, a, None] * dL[b] + L[:, b, None] * dL[a]) for a, b in TETRAHEDRON_EDGES]
    return np.concatenate([corners, np.stack(mids, axis=1)], axis=1)


def jacobian_range(mesh: Mesh) -> tuple[Array, Array]:
    """Return the smallest and largest Jacobian determinant of each curved cell, sampled at its nodes and inside.

    Parameters
    ----------
    mesh : Mesh

    Returns
    -------
    low, high : (c,) arrays [m³]
        Six times the volume for a tetrahedron with straight edges, the volume for a box; negative
        where a cell is inverted.
    """
    if mesh.cell_type is not TETRAHEDRON:
        return hexahedra_jacobian_range(mesh)
    gradients = _gradients(_lattice())
    low, high = np.empty(len(mesh.cells)), np.empty(len(mesh.cells))
    for start in range(0, len(mesh.cells), CHUNK):
        part = slice(start, start + CHUNK)
        determinant = _determinants(mesh.points[mesh.cells[part]], gradients)
        low[part], high[part] = determinant.min(axis=1), determinant.max(axis=1)
    return low, high


def _determinants(nodes: Array, gradients: Array) -> Array:
    """Jacobian determinants (c, p) of cells with nodes (c, 10, 3)."""
    J = np.einsum("cai,pad->cpid", nodes, gradients, optimize=True)
    return np.asarray(np.einsum("cpi,cpi->cp", J[..., 0], np.cross(J[..., 1], J[..., 2])))


def cell_volumes(mesh: Mesh) -> Array:
    """Return the volume of each curved cell, (c,) [m³]; the quadrature rule integrates the cubic Jacobian exactly."""
    if mesh.cell_type is not TETRAHEDRON:
        return hexahedra_volumes(mesh)
    points = np.vstack([np.full(4, 1 / 4), 1 / 6 + np.eye(4) / 3])
    weights = np.array([-4 / 5, 9 / 20, 9 / 20, 9 / 20, 9 / 20]) / 6
    return _determinants(mesh.points[mesh.cells], _gradients(points)) @ weights


def quality(mesh: Mesh) -> MeshQuality:
    """Measure the cells of a mesh.

    Parameters
    ----------
    mesh : Mesh

    Returns
    -------
    MeshQuality

    Examples
    --------
    >>> import numpy as np
    >>> from turgor.core.meshing.mesh import Mesh
    >>> points = np.array([[1.0, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]])[[0, 2, 1, 3]]  # regular
    >>> mids = [(points[a] + points[b]) / 2 for a, b in ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3))]
    >>> points, cells = np.vstack([points, mids]), np.arange(10)[None]
    >>> one = Mesh(points=points, cells=cells, regions={"body": np.array([0])}, faces={})
    >>> measured = quality(one)
    >>> round(measured.min_shape, 12), round(measured.min_jacobian_ratio, 12)
    (1.0, 1.0)
    """
    solid = bool(len(mesh.cells))
    ratios = jacobian_ratios(mesh) if solid else _film_ratios(mesh)
    shape = cell_shapes(mesh) if solid else film_shapes(mesh)
    kind = mesh.cell_type if solid else mesh.cell_type.side
    ends = np.sort(np.concatenate([mesh.pieces[:, e] for e in kind.edges]), axis=1)
    ends = np.unique(ends, axis=0)
    lengths = np.linalg.norm(mesh.points[ends[:, 1]] - mesh.points[ends[:, 0]], axis=1)
    return MeshQuality(
        cells=len(mesh.pieces),
        points=len(mesh.points),
        vertices=mesh.vertex_count,
        unknowns=mesh.unknown_count,
        inverted=int((ratios <= 0).sum()),
        min_jacobian_ratio=float(ratios.min()),
        min_shape=float(shape.min()),
        mean_shape=float(shape.mean()),
        min_edge=float(lengths.min()),
        mean_edge=float(lengths.mean()),
        max_edge=float(lengths.max()),
    )


def film_shapes(mesh: Mesh) -> Array:
    """Return the shape of each side of films without a solid, (f,): 1 is a square, 0 is flat.

    It is the least of the area at a corner over the mean square of both edges there.
    """
    area, squares = _film_corners(mesh)
    return np.asarray((area / squares).min(axis=1))


def _film_ratios(mesh: Mesh) -> Array:
    """Smallest over largest area at the corners of each side of films without a solid (f,)."""
    area, _ = _film_corners(mesh)
    return np.asarray(area.min(axis=1) / area.max(axis=1))


def _film_corners(mesh: Mesh) -> tuple[Array, Array]:
    """Area between both edges at each corner of the sides of films, and the mean square of these edges, (f, k)."""
    p = mesh.points[mesh.film_sides[:, : mesh.cell_type.side.corners]]
    ahead, back = np.roll(p, -1, axis=1) - p, np.roll(p, 1, axis=1) - p
    return np.linalg.norm(np.cross(ahead, back), axis=2), ((ahead**2).sum(axis=2) + (back**2).sum(axis=2)) / 2


def cell_shapes(mesh: Mesh) -> Array:
    """Return the shape of each cell with straight edges, (c,), as in `MeshQuality`: 1 is regular, 0 is flat."""
    if mesh.cell_type is not TETRAHEDRON:
        return hexahedra_shapes(mesh)
    corners = mesh.points[mesh.cells[:, :4]]
    a, b, c = (corners[:, i] - corners[:, 0] for i in (1, 2, 3))
    volume = np.einsum("ci,ci->c", a, np.cross(b, c)) / 6
    edges = np.stack([corners[:, j] - corners[:, i] for i, j in TETRAHEDRON_EDGES], axis=1)
    squares = np.einsum("cei,cei->ce", edges, edges)
    return np.asarray(12 * np.cbrt(3 * np.maximum(volume, 0)) ** 2 / squares.sum(axis=1))


def jacobian_ratios(mesh: Mesh) -> Array:
    """Return the smallest over the largest Jacobian of each curved cell, (c,): ≤ 0 if inverted, 0 if flat.

    Cells of a revolved mesh that touch its axis are wedges, whose Jacobian vanishes there; where it is positive
    elsewhere, they count as 1.
    """
    low, high = jacobian_range(mesh)
    largest = np.maximum(np.abs(low), np.abs(high))
    ratios = np.divide(low, largest, out=np.zeros(len(low)), where=largest > 0)
    if mesh.revolved:
        ratios[mesh.on_axis[mesh.cells].any(axis=1) & (low > 0)] = 1.0
    return ratios


def refuse_inverted(
    mesh: Mesh, advice: str = "use a smaller mesh size, so that more cells follow curved faces"
) -> None:
    """Raise an error for a mesh with an inverted cell, because its equations cannot be solved.

    Parameters
    ----------
    mesh : Mesh
    advice : str
        What the person who made it can do.

    Raises
    ------
    TurgorError
        If the Jacobian of a cell is zero or negative at one of its nodes or within it.
    """
    low, _ = jacobian_range(mesh)
    bad = np.flatnonzero(low <= 0)
    if len(bad):
        x, y, z = mesh.points[mesh.cells[bad[0]]].mean(axis=0) * 1e3
        raise TurgorError(
            f"{len(bad)} of {len(low)} cells are turned inside out, the first around ({x:.4g}, {y:.4g}, {z:.4g}) mm; "
            f"{advice}."
        )
