"""CellFinder: the cell that holds a point at rest, and where in it, by inverse mapping."""

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.cells.reference import tables_at
from turgor.core.engine.fibers.settings import FIBERS
from turgor.core.meshing.mesh import Mesh
from turgor.foundation.round_off import ROUND_OFF

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


class CellFinder:
    """Finds the cells of a mesh that hold points.

    Parameters
    ----------
    mesh : Mesh
    """

    def __init__(self, mesh: Mesh) -> None:
        from scipy.spatial import cKDTree  # slow to load, and few models need it

        self._mesh = mesh
        nodes = mesh.points[mesh.cells]
        edges = np.array(mesh.cell_type.edges)
        self.size = float(np.linalg.norm(nodes[:, edges[:, 1]] - nodes[:, edges[:, 0]], axis=2).mean())
        """Mean edge of the cells [m]."""
        self.limit = FIBERS.embedded_within * self.size
        """How far outside the cells a point may be [m]."""
        self._low, self._high = nodes.min(axis=1) - self.limit, nodes.max(axis=1) + self.limit
        self._radius = float(np.linalg.norm(self._high - self._low, axis=1).max()) / 2
        self._tree = cKDTree((self._low + self._high) / 2)

    def find(self, points: Array) -> tuple[Ints, Array]:
        """Nearest cells (m,) of points (m, 3), the first where several hold one, and the distances (m,) to them [m]."""
        near = self._tree.query_ball_point(points, self._radius)
        _, nearest = self._tree.query(points)
        which = np.repeat(np.arange(len(points)), [len(each) + 1 for each in near])
        cells = np.concatenate([[*each, own] for each, own in zip(near, nearest, strict=True)]).astype(np.int64)
        boxed = ((points[which] >= self._low[cells]) & (points[which] <= self._high[cells])).all(axis=1)
        boxed |= cells == nearest[which]
        which, cells = which[boxed], cells[boxed]
        distance = np.linalg.norm(self.positions(cells, self.places(cells, points[which])) - points[which], axis=1)
        same = np.rint(distance / (ROUND_OFF.same * self.size))
        order = np.lexsort((cells, same, which))
        first = order[np.unique(which[order], return_index=True)[1]]
        return cells[first], distance[first]

    def sides(self, points: Array) -> Ints:
        """Cells that hold points, −1 where none does."""
        cells, distance = self.find(points)
        return np.where(distance <= self.limit, cells, -1)

    def places(self, cells: Ints, points: Array) -> Array:
        """Reference coordinates (m, 3) of points in given cells, put onto the cell where they are outside."""
        nodes = self._mesh.points[self._mesh.cells[cells]]
        at = np.full(points.shape, 0.5 if self._mesh.cell_type.corners == 8 else 0.25)
        for _ in range(FIBERS.inverse_steps):
            table = tables_at(self._mesh.cell_type.nodes, at, np.ones(len(at)))
            gap = points - np.einsum("ma,mai->mi", table.N, nodes)
            step = np.linalg.solve(np.einsum("mai,mad->mid", nodes, table.dN), gap[..., None])[..., 0]
            at = np.clip(at + step, -0.5, 1.5)  # far outside the mapping may have no inverse
            if np.abs(step).max(initial=0.0) < ROUND_OFF.same:
                break
        inside = np.clip(at, 0.0, 1.0)
        if self._mesh.cell_type.corners == 4:
            inside /= np.maximum(inside.sum(axis=1), 1.0)[:, None]
        return inside

    def values(self, places: Array) -> Array:
        """Shape values (m, n) at reference coordinates."""
        return tables_at(self._mesh.cell_type.nodes, places, np.ones(len(places))).N

    def positions(self, cells: Ints, places: Array) -> Array:
        """Points (m, 3) at reference coordinates of cells [m]."""
        return np.asarray(np.einsum("ma,mai->mi", self.values(places), self._mesh.points[self._mesh.cells[cells]]))
