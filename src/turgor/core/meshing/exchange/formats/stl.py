"""STL: closed surfaces of triangles, read and written."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from turgor.core.geometry.cad.stl import read_stl as read_corners
from turgor.core.meshing.exchange.formats.raw import Array, Ints
from turgor.foundation.errors import TurgorError

_RECORD = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Triangles:
    """A surface of flat triangles that share their corners.

    Parameters
    ----------
    points : (n, 3) array
        Corners.
    triangles : (f, 3) int array
        Counterclockwise seen from outside.
    """

    points: Array
    triangles: Ints

    @property
    def volume(self) -> float:
        """Enclosed volume; negative where the triangles are wound inwards."""
        a, b, c = (self.points[self.triangles[:, i]] for i in range(3))
        return float(np.einsum("fi,fi->", a, np.cross(b, c)) / 6)

    @property
    def open_edges(self) -> int:
        """How many edges do not belong to exactly two triangles."""
        edges = np.sort(self.triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
        return int((np.unique(edges, axis=0, return_counts=True)[1] != 2).sum())

    def shells(self) -> tuple["Triangles", ...]:
        """The connected parts, largest first."""
        count, n = len(self.triangles), len(self.points)
        links = coo_array(
            (np.ones(3 * count), (np.repeat(np.arange(count), 3), self.triangles.ravel())), shape=(count, n)
        ).tocsr()
        parts = connected_components(links @ links.T, directed=False)[1]
        shells = [_compact(self.points, self.triangles[parts == part]) for part in np.unique(parts)]
        return tuple(sorted(shells, key=lambda shell: -abs(shell.volume)))


def _compact(points: Array, triangles: Ints) -> Triangles:
    nodes, places = np.unique(triangles, return_inverse=True)
    return Triangles(points=points[nodes], triangles=places.reshape(-1, 3))


def read_stl(path: str | Path) -> Triangles:
    """Read an STL file, binary or ASCII; corners at the same place become one.

    Parameters
    ----------
    path : str or Path

    Returns
    -------
    Triangles
        In the unit of the file.

    Raises
    ------
    TurgorError
        If there is no such file, or it is no STL file.
    """
    file = Path(path)
    if not file.is_file():
        raise TurgorError(f"there is no STL file '{file}'.")
    corners = read_corners(file) + 0.0  # makes -0 and 0 the same corner
    points, places = np.unique(corners.reshape(-1, 3), axis=0, return_inverse=True)
    triangles = places.reshape(-1, 3)
    flat = (triangles == np.roll(triangles, 1, axis=1)).any(axis=1)
    return Triangles(points=points, triangles=triangles[~flat])


def stl_bytes(points: Array, triangles: Ints) -> bytes:
    """Write triangles as a binary STL file.

    Parameters
    ----------
    points : (n, 3) array
        In the unit of the file.
    triangles : (f, 3) int array

    Returns
    -------
    bytes

    Examples
    --------
    >>> len(stl_bytes(np.eye(3), np.array([[0, 1, 2]])))
    134
    """
    corners = points[triangles]
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    length = np.linalg.norm(normal, axis=1, keepdims=True)
    records = np.zeros(len(triangles), dtype=_RECORD)
    records["normal"], records["corners"] = normal / np.where(length > 0, length, 1), corners
    header = b"binary STL, written by turgor".ljust(80)
    return header + len(triangles).to_bytes(4, "little") + records.tobytes()
