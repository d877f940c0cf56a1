"""The surface of a mesh, from the connectivity of its cells, and checks of it."""

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from turgor.core.geometry.names import cavity_names, no_cavity
from turgor.core.meshing.cells import cell_type, side_type
from turgor.core.meshing.mesh import Mesh
from turgor.core.meshing.openings import check_openings
from turgor.foundation.errors import TurgorError
from turgor.foundation.finding import Finding, Severity

Triangles = NDArray[np.int64]


def corner_keys(triangles: Triangles, node_count: int) -> NDArray[np.int64]:
    """One number for each side, the same for any order of its corners.

    Two quadrilaterals of a solid never share three corners, so that the three smallest tell them apart. Films joined
    at a corner do; all four count up to 55,000 nodes, for which the key fits 64 bits.

    Parameters
    ----------
    triangles : (f, 3 to 9) int array
        Corners in the first columns: four of quadrilaterals (8 or 9 columns), three of triangles.
    node_count : int
        Number of nodes, below 2e6 so that the key fits 64 bits.

    Returns
    -------
    (f,) int array
    """
    if node_count >= 2_000_000:
        raise TurgorError(f"the mesh has {node_count} nodes; at most 2 million can be handled.")
    corners = 4 if triangles.shape[1] >= 8 else 3
    ordered = np.sort(triangles[:, :corners], axis=1)
    a, b, c = ordered[:, :3].T
    keys = np.asarray((a * node_count + b) * node_count + c, dtype=np.int64)
    return keys * node_count + ordered[:, 3] if corners == 4 and node_count**4 < 2**63 else keys


def cell_sides(cells: NDArray[np.int64]) -> Triangles:
    """All sides of all cells, normals pointing out of their cell; side i of cell k of s sides is row s k + i."""
    kind = cell_type(cells.shape[1])
    return np.asarray(cells[:, np.array(kind.sides)].reshape(-1, kind.side.nodes))


@lru_cache(maxsize=4)  # every check, measures and contact need it
def outer_triangles(mesh: Mesh) -> Triangles:
    """Find the whole surface of the mesh: the cell sides that no other cell shares.

    Parameters
    ----------
    mesh : Mesh

    Returns
    -------
    (f, 6), (f, 8) or (f, 9) int array
        Sides of cells, normals pointing out of the solid, in the order of the cells. All callers share them: change
        a copy.

    Examples
    --------
    >>> import numpy as np
    >>> from turgor.core.meshing.mesh import Mesh
    >>> points = np.vstack([np.zeros(3), np.eye(3)])
    >>> mids = [(points[a] + points[b]) / 2 for a, b in ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3))]
    >>> points, cells = np.vstack([points, mids]), np.arange(10)[None]
    >>> one = Mesh(points=points, cells=cells, regions={"body": np.array([0])}, faces={})
    >>> len(outer_triangles(one))
    4
    """
    if not len(mesh.cells):
        return mesh.film_sides
    sides = cell_sides(mesh.cells)
    _, index, count = np.unique(corner_keys(sides, len(mesh.points)), return_index=True, return_counts=True)
    outer = sides[np.sort(index[count == 1])]
    if mesh.revolved:  # the wall of the pinhole is no surface of the body
        outer = outer[~mesh.on_axis[outer].all(axis=1)]
    return np.asarray(outer)


def among(keys: NDArray[np.int64], known: NDArray[np.int64]) -> NDArray[np.bool_]:
    """Whether each key is among others that are sorted: `numpy.isin` sorts them for every question.

    Examples
    --------
    >>> among(np.array([3, 4]), np.array([1, 3])).tolist(), among(np.array([3]), np.array([], dtype=int)).tolist()
    ([True, False], [False])
    """
    if not len(known):
        return np.zeros(len(keys), dtype=bool)
    return np.asarray(known[np.minimum(np.searchsorted(known, keys), len(known) - 1)] == keys)


def rim_edges(triangles: Triangles) -> NDArray[np.int64]:
    """Edges that belong to one of the sides only, (e, 3): two corners and the mid-side node between them."""
    kind = side_type(triangles.shape[1])
    edges = np.concatenate([triangles[:, [a, b, kind.corners + i]] for i, (a, b) in enumerate(kind.edges)])
    _, index, count = np.unique(np.sort(edges[:, :2], axis=1), axis=0, return_index=True, return_counts=True)
    return np.asarray(edges[np.sort(index[count == 1])])


def check_surface(mesh: Mesh) -> tuple[Finding, ...]:
    """Check the named faces against the surface of the mesh.

    The findings are: a cavity that is open elsewhere than at a mirror plane (D01 where at an inlet, else G02), surface
    without a name (G03), a face whose triangles are no cell sides or point into the solid (G04), a face that is called
    a cavity and encloses nothing (G26).

    Parameters
    ----------
    mesh : Mesh

    Returns
    -------
    tuple of Finding
    """
    if not len(mesh.cells):
        return ()  # both sides of a film are outside
    surface = outer_triangles(mesh)
    rims = {name: rim_edges(mesh.face(name)) for name in mesh.cavities}
    flat = [name for name in cavity_names(mesh.faces) if name not in mesh.cavities]
    return (
        *check_openings(mesh, surface, rims),
        *([no_cavity(flat)] if flat else []),
        *_unnamed(mesh, surface),
        *_misplaced(mesh, surface),
    )


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
            message=f"{missing} of {len(surface)} surface {_plural(surface)} belong to no named face.",
            advice="Name them, 'outside' for instance, so that no wall with a pressure or a support is left out.",
        )
    ]


def _misplaced(mesh: Mesh, surface: Triangles) -> list[Finding]:
    count = len(mesh.points)
    sides = np.sort(corner_keys(cell_sides(mesh.cells), count))
    surface_keys, outward = np.sort(corner_keys(surface, count)), np.sort(_oriented_keys(surface, count))
    findings = []
    for name, triangles in mesh.faces.items():
        keys = corner_keys(triangles, count)
        strays = int((~among(keys, sides)).sum())
        outer = triangles[among(keys, surface_keys)]
        inward = int((~among(_oriented_keys(outer, count), outward)).sum())
        if strays or inward:
            shape = _plural(triangles)
            what = f"{strays} {shape} that are no side of a cell" if strays else f"{inward} {shape} facing inward"
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


def _plural(sides: Triangles) -> str:
    return "triangles" if side_type(sides.shape[1]).corners == 3 else "quadrilaterals"


def _oriented_keys(triangles: Triangles, node_count: int) -> NDArray[np.int64]:
    """One number for each side that changes when it is turned over, but not with the corner it begins at."""
    corners = side_type(triangles.shape[1]).corners
    first = triangles[:, :corners].argmin(axis=1)
    a, b, c = (triangles[np.arange(len(triangles)), (first + i) % corners] for i in range(3))
    return np.asarray((a * node_count + b) * node_count + c, dtype=np.int64)
