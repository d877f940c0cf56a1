"""Linear body: the whole actuator in linear tetrahedra whose nodes are those of the mesh."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from turgor.core.geometry.shapes.tolerances import TOLERANCE
from turgor.core.meshing.cells import TETRAHEDRON
from turgor.core.meshing.mesh import Mesh
from turgor.core.meshing.openings import mirror_planes
from turgor.foundation.errors import TurgorError

Array = NDArray[np.float64]
Ints = NDArray[np.int64]

#: Eight tetrahedra of a ten-node one, and four triangles of a six-node one.
_EIGHTHS = (
    (0, 4, 6, 7), (4, 1, 5, 8), (6, 5, 2, 9), (7, 8, 9, 3),
    (4, 9, 5, 6), (4, 9, 6, 7), (4, 9, 7, 8), (4, 9, 8, 5),
)  # fmt: skip
_QUARTERS = ((0, 3, 5), (3, 1, 4), (5, 4, 2), (3, 4, 5))


@dataclass(frozen=True, slots=True, eq=False)
class LinearBody:
    """The whole actuator.

    Parameters
    ----------
    points : (n, 3) array [m]
    regions : dict of str to (t, 4) int array
        Tetrahedra of positive volume.
    faces : dict of str to (f, 3) int array
        Triangles.
    """

    points: Array
    regions: dict[str, Ints]
    faces: dict[str, Ints]

    @property
    def tetrahedra(self) -> Ints:
        """All tetrahedra (t, 4)."""
        return np.concatenate(list(self.regions.values()))

    def volumes(self, tetrahedra: Ints) -> Array:
        """Volume of each tetrahedron [m³]."""
        a, b, c, d = (self.points[tetrahedra[:, k]] for k in range(4))
        return np.asarray(np.einsum("ij,ij->i", np.cross(b - a, c - a), d - a) / 6)


def linear_body(mesh: Mesh) -> LinearBody:
    """Cut each ten-node tetrahedron in eight, and mirror a half or a quarter to the whole.

    Raises
    ------
    TurgorError
        If the mesh has other cells or is a sector, or a small tetrahedron would be turned inside out.
    """
    if mesh.cells.shape[1] != TETRAHEDRON.nodes or mesh.wedge is not None or mesh.revolved:
        raise TurgorError(f"'{mesh.name}' is not made of tetrahedra, or a sector; mesh it with tetrahedra.")
    points = mesh.points
    groups = {("region", name): _parts(mesh.cells[cells], _EIGHTHS) for name, cells in mesh.regions.items()}
    groups |= {("face", name): _parts(sides, _QUARTERS) for name, sides in mesh.faces.items()}
    for axis, place in mirror_planes(mesh).values():
        points, groups = _whole(points, groups, axis, place)
    regions, faces = ({name: each for (kind, name), each in groups.items() if kind == of} for of in ("region", "face"))
    body = LinearBody(points, regions, faces)
    if (body.volumes(body.tetrahedra) <= 0).any():
        raise TurgorError(f"cells of '{mesh.name}' are so curved that a part of them is turned inside out; mesh finer.")
    return body


def _parts(cells: Ints, parts: tuple[tuple[int, ...], ...]) -> Ints:
    return cells[:, np.array(parts)].reshape(-1, len(parts[0]))


def _whole(
    points: Array, groups: dict[tuple[str, str], Ints], axis: int, place: float
) -> tuple[Array, dict[tuple[str, str], Ints]]:
    """Add the mirror image; nodes in the mirror plane become one."""
    image = points.copy()
    image[:, axis] = 2 * place - image[:, axis]
    both = np.concatenate([points, image])
    reach = TOLERANCE.round_off * float(np.ptp(both, axis=0).max())
    first, pairs = np.arange(len(both)), cKDTree(both).query_pairs(reach, output_type="ndarray")
    np.minimum.at(first, pairs[:, 1], pairs[:, 0])
    used, number = np.unique(first, return_inverse=True)
    turned = {key: each[:, [1, 0, *range(2, each.shape[1])]] + len(points) for key, each in groups.items()}
    return both[used], {key: number[np.concatenate([each, turned[key]])] for key, each in groups.items()}
