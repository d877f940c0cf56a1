"""Meshes of films without a solid: nine-node quadrilaterals on patches, and edges as sides without an area."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import ceil

import numpy as np
from numpy.typing import NDArray

from turgor.core.geometry.geometry import Geometry
from turgor.core.geometry.shapes.film_shape import FilmShape, Patch
from turgor.core.meshing.bodies.groups import groups_of
from turgor.core.meshing.cells import HEXAHEDRON
from turgor.core.meshing.mesh import Mesh
from turgor.foundation.errors import TurgorError
from turgor.foundation.round_off import ROUND_OFF

Array = NDArray[np.float64]
Ints = NDArray[np.int64]

#: Nodes of a side in a grid of 3 × 3 that runs along the first edge first.
_NINE = (0, 2, 8, 6, 1, 5, 7, 3, 4)


@dataclass(frozen=True, slots=True, eq=False)
class _Grid:
    """Nodes of a patch: positions (2 m + 1, 2 n + 1, 3), n cells along its first edge and m along the second."""

    patch: Patch
    points: Array

    @property
    def numbers(self) -> Ints:
        """Places of the nodes of the grid among its points."""
        rows, columns = self.points.shape[:2]
        return np.arange(rows * columns).reshape(rows, columns)

    def sides(self, numbers: Ints) -> Ints:
        """Sides (f, 9) of numbered nodes."""
        rows, columns = numbers.shape
        starts = [(i, k) for i in range(0, rows - 1, 2) for k in range(0, columns - 1, 2)]
        return np.array([numbers[i : i + 3, k : k + 3].ravel()[list(_NINE)] for i, k in starts])

    @property
    def joins(self) -> NDArray[np.bool_]:
        """Whether each node joins those of other patches at the same place: on edges, if not in a mirror plane."""
        out = np.zeros(self.points.shape[:2], dtype=bool)
        lines = (out[0], out[:, -1], out[-1], out[:, 0])
        for name, line in zip(self.patch.edges, lines, strict=True):
            line[:] |= not name.startswith("symmetry_")
        return out

    def edges(self, numbers: Ints) -> Iterator[tuple[str, Ints]]:
        """Sides without an area (f, 9) of each edge that has a name."""
        around = (numbers[0], numbers[:, -1], numbers[-1, ::-1], numbers[::-1, 0])
        for name, line in zip(self.patch.edges, around, strict=True):
            if name:
                yield name, edge_sides(line)


def edge_sides(line: Ints) -> Ints:
    """Sides without an area (f, 9) that stand for the pieces of an edge, from its nodes (2 f + 1,) in turn."""
    a, middle, b = line[:-2:2], line[1::2], line[2::2]
    return np.stack([a, b, b, a, *[middle] * 5], axis=1)


def film_mesh(geometry: Geometry, size: float) -> Mesh:
    """Mesh films.

    Parameters
    ----------
    geometry : Geometry
        Its shape is a `FilmShape`.
    size : float [m]
        Largest length of an edge of a side.

    Returns
    -------
    Mesh
        Without cells.
    """
    shape = geometry.shape
    assert isinstance(shape, FilmShape)
    counts = _counts(shape.patches, size)
    grids = [
        _Grid(patch, patch.grid(*(2 * cells for cells in count)))
        for patch, count in zip(shape.patches, counts, strict=True)
    ]
    points = np.concatenate([grid.points.reshape(-1, 3) for grid in grids])
    tolerance = ROUND_OFF.mesh_digits * geometry.extent
    owner = np.concatenate([np.where(grid.joins, 0, k + 1).ravel() for k, grid in enumerate(grids)])
    places = np.column_stack([(points / tolerance).round(), owner])
    _, first, joined = np.unique(places, axis=0, return_index=True, return_inverse=True)
    starts = np.cumsum([0, *(grid.numbers.size for grid in grids)])
    named: dict[str, list[Ints]] = {}
    for grid, start in zip(grids, starts, strict=False):
        numbers = joined.ravel()[start + grid.numbers]
        for name in grid.patch.faces:
            named.setdefault(name, []).append(grid.sides(numbers))
        for name, sides in grid.edges(numbers):
            named.setdefault(name, []).append(sides)
    faces = {name: np.concatenate(named[name]) for name in geometry.faces}
    numbered = [joined.ravel()[start + grid.numbers] for grid, start in zip(grids, starts, strict=False)]
    _check_apart(shape, [grid.sides(numbers) for grid, numbers in zip(grids, numbered, strict=True)])
    corners = np.unique(np.concatenate([sides[:, :4] for sides in faces.values()]))
    order = np.concatenate([corners, np.setdiff1d(np.arange(len(first)), corners)])
    number = np.empty(len(order), dtype=np.int64)
    number[order] = np.arange(len(order))
    return Mesh(
        points=points[first][order],
        cells=np.zeros((0, HEXAHEDRON.nodes), dtype=np.int64),
        regions={},
        faces={name: number[sides] for name, sides in faces.items()},
        name=geometry.name,
    )


def _check_apart(shape: FilmShape, sides: Sequence[Ints]) -> None:
    """Refuse two patches of one side each with the same corners: they would be one film."""
    known: dict[frozenset[int], int] = {}
    for place, each in enumerate(sides):
        for side in each:
            other = known.setdefault(frozenset(side[:4].tolist()), place)
            if other != place:
                raise TurgorError(
                    f"patches {other + 1} and {place + 1} ('{shape.patches[place].name}') of the film lie on each "
                    "other with sides between the same four corners, and would be one film; make size smaller."
                )


def _counts(patches: Sequence[Patch], size: float) -> list[tuple[int, int]]:
    """Cells along the first and the second edge of each patch, alike where patches share edges."""
    ends = [[_ends(patch, k) for k in range(4)] for patch in patches]
    places = {end: number for number, end in enumerate(dict.fromkeys(end for each in ends for end in each))}
    first = [places[each[k]] for each in ends for k in (0, 1)]
    second = [places[each[k]] for each in ends for k in (2, 3)]
    groups = groups_of(len(places), np.array(first), np.array(second))
    lengths = np.zeros(len(places))
    for patch, each in zip(patches, ends, strict=True):
        for k in range(4):
            lengths[groups[places[each[k]]]] = max(lengths[groups[places[each[k]]]], _length(patch, k))
    cells = [max(1, ceil(length / size - ROUND_OFF.mesh_digits)) for length in lengths]
    return [(cells[groups[places[each[0]]]], cells[groups[places[each[1]]]]) for each in ends]


def _ends(patch: Patch, edge: int) -> frozenset[tuple[float, ...]]:
    """The corners at both ends of an edge, which name it."""
    return frozenset(tuple(round(x, 9) for x in patch.corners[k % 4]) for k in (edge, edge + 1))


def _length(patch: Patch, edge: int) -> float:
    line = patch.line(edge, np.linspace(0, 1, 21))
    return float(np.linalg.norm(np.diff(line, axis=0), axis=1).sum())
