"""The surface of a mesh, taken from the connectivity of its cells, and what can be wrong with it."""

import numpy as np
from numpy.typing import NDArray

from turgor.errors import TurgorError
from turgor.finding import Finding, Severity
from turgor.meshing.mesh import TETRAHEDRON_FACES, TRIANGLE_EDGES, Mesh

Triangles = NDArray[np.int64]


def corner_keys(triangles: Triangles, node_count: int) -> NDArray[np.int64]:
    """One number for each triangle, the same for any order of its three corners.

    Parameters
    ----------
    triangles : (f, 3 or more) int array
        Corners in the first three columns.
    node_count : int
        Number of nodes, below 2e6 so that the key fits 64 bits.

    Returns
    -------
    (f,) int array
    """
    if node_count >= 2_000_000:
        raise TurgorError(f"the mesh has {node_count} nodes; at most 2 million can be handled.")
    a, b, c = np.sort(triangles[:, :3], axis=1).T
    return np.asarray((a * node_count + b) * node_count + c, dtype=np.int64)


def cell_sides(cells: NDArray[np.int64]) -> Triangles:
    """All sides of all cells, (4c, 6), normals pointing out of their cell; side i of cell k is row 4 k + i."""
    return np.asarray(cells[:, np.array(TETRAHEDRON_FACES)].reshape(-1, 6))


def outer_triangles(mesh: Mesh) -> Triangles:
    """Find the whole surface of the mesh: the cell sides that no other cell shares.

    Parameters
    ----------
    mesh : Mesh

    Returns
    -------
    (f, 6) int array
        Six-node triangles, normals pointing out of the solid, in the order of the cells.

    Examples
    --------
    >>> import numpy as np
    >>> from turgor.meshing.mesh import Mesh
    >>> points = np.vstack([np.zeros(3), np.eye(3)])
    >>> mids = [(points[a] + points[b]) / 2 for a, b in ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3))]
    >>> points, cells = np.vstack([points, mids]), np.arange(10)[None]
    >>> one = Mesh(points=points, cells=cells, regions={"body": np.array([0])}, faces={})
    >>> len(outer_triangles(one))
    4
    """
    sides = cell_sides(mesh.cells)
    _, index, count = np.unique(corner_keys(sides, len(mesh.points)), return_index=True, return_counts=True)
    return np.asarray(sides[np.sort(index[count == 1])])


def rim_edges(triangles: Triangles) -> NDArray[np.int64]:
    """Edges that belong to one of the triangles only, (e, 3): two corners and the mid-side node between them."""
    edges = np.concatenate([triangles[:, [a, b, 3 + i]] for i, (a, b) in enumerate(TRIANGLE_EDGES)])
    _, index, count = np.unique(np.sort(edges[:, :2], axis=1), axis=0, return_index=True, return_counts=True)
    return np.asarray(edges[np.sort(index[count == 1])])


def check_surface(mesh: Mesh) -> tuple[Finding, ...]:
    """Check the named faces against the surface of the mesh.

    Found are: a cavity that is open elsewhere than at a mirror plane (G02), surface without a name (G03), a face
    whose triangles are no cell sides or point into the solid (G04).

    Parameters
    ----------
    mesh : Mesh

    Returns
    -------
    tuple of Finding
    """
    surface = outer_triangles(mesh)
    return (*_open_cavities(mesh), *_unnamed(mesh, surface), *_misplaced(mesh, surface))


def _open_cavities(mesh: Mesh) -> list[Finding]:
    findings = []
    mirrors = [mesh.face_nodes(name) for name in mesh.symmetry_faces]
    for name in (n for n in mesh.faces if n.startswith("cavity")):
        rim = rim_edges(mesh.face(name))
        at_mirror = np.zeros(len(rim), dtype=bool)
        for nodes in mirrors:
            at_mirror |= np.isin(rim, nodes).all(axis=1)
        if not at_mirror.all():
            x, y, z = mesh.points[rim[~at_mirror]].mean(axis=(0, 1)) * 1e3
            findings.append(
                Finding(
                    code="G02",
                    severity=Severity.ERROR,
                    message=f"Face '{name}' is not closed: {int((~at_mirror).sum())} of its edges end away from a "
                    f"mirror plane, around ({x:.3g}, {y:.3g}, {z:.3g}) mm.",
                    advice="Name all walls of the cavity, close its inlet, or name the mirror planes symmetry_*; "
                    "an open cavity has no volume and its pressure no potential.",
                )
            )
    return findings


def _unnamed(mesh: Mesh, surface: Triangles) -> list[Finding]:
    named = [corner_keys(triangles, len(mesh.points)) for triangles in mesh.faces.values()]
    keys = np.concatenate([np.zeros(0, dtype=np.int64), *named])
    missing = int((~np.isin(corner_keys(surface, len(mesh.points)), keys)).sum())
    if not missing:
        return []
    return [
        Finding(
            code="G03",
            severity=Severity.WARNING,
            message=f"{missing} of {len(surface)} surface triangles belong to no named face.",
            advice="Name them, 'outside' for instance, so that no wall with a pressure or a support is left out.",
        )
    ]


def _misplaced(mesh: Mesh, surface: Triangles) -> list[Finding]:
    count = len(mesh.points)
    sides = corner_keys(cell_sides(mesh.cells), count)
    surface_keys, outward = corner_keys(surface, count), _oriented_keys(surface, count)
    findings = []
    for name, triangles in mesh.faces.items():
        keys = corner_keys(triangles, count)
        strays = int((~np.isin(keys, sides)).sum())
        outer = triangles[np.isin(keys, surface_keys)]
        inward = int((~np.isin(_oriented_keys(outer, count), outward)).sum())
        if strays or inward:
            what = f"{strays} triangles that are no side of a cell" if strays else f"{inward} triangles facing inward"
            findings.append(
                Finding(
                    code="G04",
                    severity=Severity.ERROR,
                    message=f"Face '{name}' has {what}, of {len(triangles)}.",
                    advice="Export the mesh again, with faces that share the nodes of the cells and point out of the "
                    "solid; a pressure on such a face would act in the wrong direction.",
                )
            )
    return findings


def _oriented_keys(triangles: Triangles, node_count: int) -> NDArray[np.int64]:
    """One number for each triangle that changes when it is turned over, but not with the corner it begins at."""
    first = triangles[:, :3].argmin(axis=1)
    a, b, c = (triangles[np.arange(len(triangles)), (first + i) % 3] for i in range(3))
    return np.asarray((a * node_count + b) * node_count + c, dtype=np.int64)
