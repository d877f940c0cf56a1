"""Chambers: volumes of cavities and how these change, for procedures that prescribe a volume or an amount of gas."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.cells.reference import side_tables
from turgor.core.engine.faces import surfaces
from turgor.core.engine.faces.openings import NO_AXIS, cap_gradient, mirror_point
from turgor.core.engine.system import System
from turgor.core.meshing.mesh import Mesh

Array = NDArray[np.float64]


def cavity_volume(mesh: Mesh, name: str, displacement: Array | None = None) -> float:
    """Return the volume that a face encloses, of the whole actuator [m³], at rest or in a state.

    Mirror planes, the cut faces of a wedge and caps of openings close it, as in `Chambers`.

    Parameters
    ----------
    mesh : Mesh
    name : str
        Face of the cavity.
    displacement : (n, 3) array [m], optional
        That of a state; at rest by default.
    """
    points = mesh.points - mirror_point(mesh)  # so that cuts add nothing to ⅓ ∮ x·n da
    if displacement is not None:
        points += displacement
    return float(-mesh.symmetry_factor * surfaces.enclosed_volume(points, mesh.face(name), mesh))


class Chambers:
    """Cavities of the whole actuator, in scaled units.

    An opening is closed by a cap, as in `turgor.core.engine.faces.surfaces.enclosed_volume`.

    Parameters
    ----------
    system : System
        Whose unknowns they depend on.
    faces : sequence of str
        Faces that each enclose a volume, up to mirror planes and openings.
    """

    def __init__(self, system: System, faces: Sequence[str]) -> None:
        self.system, self.faces = system, tuple(faces)
        mesh = system.model.mesh
        self._walls = [np.ascontiguousarray(mesh.face(name)) for name in faces]
        self._rims = [surfaces.open_rim(mesh, walls) for walls in self._walls]
        self._axis = NO_AXIS if mesh.wedge is None else mesh.wedge.number
        self._factor = mesh.symmetry_factor
        self._shift = mirror_point(mesh) / system.length  # cuts at planes and axes through the origin add nothing

    def __len__(self) -> int:
        return len(self._walls)

    def stored(self) -> tuple[System, tuple[str, ...]]:
        """Return the content of a file for them."""
        return self.system, self.faces

    @classmethod
    def restored(cls, stored: tuple[System, tuple[str, ...]]) -> "Chambers":
        """The cavities of what a file holds."""
        return cls(*stored)

    def volumes(self, unknowns: Array) -> Array:
        """Scaled volumes (k,)."""
        points, mesh = self._position(unknowns), self.system.model.mesh
        # normals point out of the solid, which is into the cavity
        return np.array([-self._factor * surfaces.enclosed_volume(points, walls, mesh) for walls in self._walls])

    def gradients(self, unknowns: Array) -> Array:
        """Derivatives (k, size) of the volumes by the unknowns."""
        points = self._position(unknowns)
        rows = []
        for walls, rim in zip(self._walls, self._rims, strict=True):
            by_node = cap_gradient(points, rim, self._axis)
            np.add.at(by_node, walls, _of_walls(points, walls))
            rows.append(self.system.joined(-self._factor * by_node))
        return np.array(rows)

    def _position(self, unknowns: Array) -> Array:
        return np.asarray(self.system.points + self.system.split(unknowns)[0] - self._shift)


def _of_walls(points: Array, walls: NDArray[np.int64]) -> Array:
    """Derivative (f, k, 3) of ⅓ ∫ x·n da by the nodes of each side, with what the rim of an open surface adds."""
    tables = side_tables(walls.shape[1])
    corners = points[walls]
    x = np.einsum("qa,fai->fqi", tables.N, corners)
    r, s = (np.einsum("qa,fai->fqi", tables.dN[..., k], corners) for k in range(2))
    weighted = [tables.weights[:, None] / 3 * part for part in (tables.N, tables.dN[..., 0], tables.dN[..., 1])]
    crossed = (np.cross(r, s), np.cross(s, x), np.cross(x, r))
    return np.asarray(sum(np.einsum("qa,fqi->fai", w, c) for w, c in zip(weighted, crossed, strict=True)))
