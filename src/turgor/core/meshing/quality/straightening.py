"""Repair of curved cells that are inverted or nearly so: their edges are straightened as little as possible."""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from turgor.core.meshing.mesh import TETRAHEDRON_EDGES, Mesh
from turgor.core.meshing.quality.cell_quality import jacobian_range
from turgor.core.meshing.quality.settings import STRAIGHTENING
from turgor.core.meshing.surface import outer_triangles
from turgor.foundation.finding import Finding, Severity
from turgor.units import mm

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


def mended(mesh: Mesh) -> Mesh:
    """Straighten the edges of curved cells that are inverted or nearly so, as little as possible.

    The midside nodes of a bad cell move half of the way to the middle of their straight edge, repeatedly while the cell
    is bad. The mesh deviates from the curved surface there and nowhere else. A finding (G08) states the deviation.

    Parameters
    ----------
    mesh : Mesh

    Returns
    -------
    Mesh
        The same mesh if no cell was bad. Cells that are inverted even with straight edges stay inverted;
        `refuse_inverted` raises the error for them.

    Examples
    --------
    >>> import numpy as np
    >>> from turgor.core.meshing.mesh import Mesh
    >>> points = np.vstack([np.zeros(3), np.eye(3)])
    >>> mids = np.array([(points[a] + points[b]) / 2 for a, b in ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3))])
    >>> mids[0] += [0, 0, 0.4]  # a strongly curved edge
    >>> points, cells = np.vstack([points, mids]), np.arange(10)[None]
    >>> bent = Mesh(points=points, cells=cells, regions={"body": np.array([0])}, faces={})
    >>> mended(bent).findings[0].code
    'G08'
    """
    bad = _bad(mesh)
    if not len(bad):
        return mesh
    straight, edge_of = _straight(mesh)
    points, rounds = mesh.points.copy(), np.zeros(len(mesh.points), dtype=np.int64)
    current, touched = mesh, bad
    while len(bad):
        mids = np.unique(mesh.cells[bad, 4:])
        mids = mids[rounds[mids] <= STRAIGHTENING.halvings]
        if not len(mids):
            break  # their edges are straight already
        rounds[mids] += 1
        share = np.where(rounds[mids] > STRAIGHTENING.halvings, 0.0, 0.5)[:, None]
        points[mids] = straight[mids] + share * (points[mids] - straight[mids])
        current = replace(mesh, points=points.copy())
        bad = _bad(current)
        touched = np.union1d(touched, bad)
    moved = np.linalg.norm(points - mesh.points, axis=1)
    return replace(current, findings=(*mesh.findings, _finding(mesh, len(touched), moved, edge_of)))


def _bad(mesh: Mesh) -> Ints:
    """Cells that are inverted or nearly so."""
    low, high = jacobian_range(mesh)
    return np.flatnonzero(low < STRAIGHTENING.jacobian_ratio * np.maximum(np.abs(low), np.abs(high)))


def _straight(mesh: Mesh) -> tuple[Array, Array]:
    """Position of each midside node on a straight edge, and the length of its edge (0 for vertices)."""
    straight, length = mesh.points.copy(), np.zeros(len(mesh.points))
    for k, (a, b) in enumerate(TETRAHEDRON_EDGES):
        ends = mesh.points[mesh.cells[:, [a, b]]]
        straight[mesh.cells[:, 4 + k]] = ends.mean(axis=1)
        length[mesh.cells[:, 4 + k]] = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
    return straight, length


def _finding(mesh: Mesh, cells: int, moved: Array, length: Array) -> Finding:
    surface = np.unique(outer_triangles(mesh))
    worst = surface[moved[surface].argmax()]
    missed, (x, y, z) = moved[worst], mesh.points[worst] / mm
    notable = missed > STRAIGHTENING.notable_miss * length[length > 0].mean()
    return Finding(
        code="G08",
        severity=Severity.WARNING if notable else Severity.NOTE,
        message=f"{cells} of {len(mesh.cells)} curved cells were inverted or nearly so and were repaired: their "
        f"edges were straightened, so the mesh deviates from the surface by up to {missed / mm:.2g} mm, "
        f"at ({x:.3g}, {y:.3g}, {z:.3g}) mm.",
        advice="Where this matters, use a smaller size, or a smaller size for the face there (face_sizes).",
    )
