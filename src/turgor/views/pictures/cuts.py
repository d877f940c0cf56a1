"""Cuts: an actuator without the part in front of a plane, and the cut face with the field on it.

The plane is one of the undeformed actuator and moves with it, so that a bent finger is cut along its middle.
"""

from dataclasses import dataclass, replace
from functools import cache
from itertools import permutations, product

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.cells.reference import tables_at
from turgor.core.meshing.mesh import TETRAHEDRON_EDGES, Mesh
from turgor.core.results.fields.state_fields import StateFields
from turgor.foundation.errors import TurgorError
from turgor.foundation.round_off import ROUND_OFF
from turgor.views.pictures.skin import Skin

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, slots=True, kw_only=True)
class Cut:
    """A plane of the undeformed actuator; what lies in front of it is left out of a picture.

    Parameters
    ----------
    axis : str
        Its normal, ``"x"``, ``"y"`` or ``"z"``; what has the smaller coordinate is left out.
    position : float or None [m]
        Its coordinate; the middle of the actuator by default.

    Examples
    --------
    >>> Cut(axis="y").axis
    'y'
    """

    axis: str
    position: float | None = None

    def __post_init__(self) -> None:
        if self.axis not in ("x", "y", "z"):
            raise TurgorError(f"the axis of a cut is '{self.axis}'; allowed is x, y or z.")

    def level(self, points: Array, whole: Array) -> Array:
        """Distance (k,) [m] of points at rest behind the plane; ``whole`` (2, 3) are the extents of the actuator."""
        number = "xyz".index(self.axis)
        middle = float(whole[:, number].mean()) if self.position is None else self.position
        aside = ROUND_OFF.mesh_digits * float(np.ptp(whole, axis=0).max())  # no node lies on the plane
        return np.asarray(points[:, number] - middle - aside)


def cut_away(at: StateFields, skin: Skin, rest: Array, cut: Cut, values: Array) -> Skin:
    """Return the skin behind a plane, closed by the cut face.

    Parameters
    ----------
    at : StateFields
    skin : Skin
        Of the state.
    rest : (p, 3) array [m]
        Where the points of the skin are at rest.
    cut : Cut
    values : (n,) or (d,) array
        Field at the nodes of the mesh, or of its regions.

    Returns
    -------
    Skin

    Raises
    ------
    TurgorError
        If nothing lies behind the plane.
    """
    whole = np.stack([rest.min(axis=0), rest.max(axis=0)])
    behind = clipped(skin, cut.level(rest, whole))
    if not len(behind.triangles):
        raise TurgorError(
            f"the cut at {cut.axis} = {cut.position} m leaves nothing of the actuator, which lies between "
            f"{whole[0]['xyz'.index(cut.axis)]:.4g} and {whole[1]['xyz'.index(cut.axis)]:.4g} m."
        )
    return _joined(behind, _cut_face(at, cut, whole, values))


def clipped(skin: Skin, level: Array) -> Skin:
    """Return the part of a skin where a number at its points (p,) is positive; triangles on the border are divided."""
    at = level[skin.triangles]
    out = at > 0
    count = out.sum(axis=1)
    pieces, owners = [skin.triangles[count == 3]], [np.flatnonzero(count == 3)]
    edges: list[tuple[Ints, Ints]] = []
    start = len(skin.points)
    for inside in (1, 2):
        rows = np.flatnonzero(count == inside)
        lone = out[rows].argmax(axis=1) if inside == 1 else out[rows].argmin(axis=1)
        a, b, c = (skin.triangles[rows, (lone + k) % 3] for k in range(3))
        ab, ac = (start + np.arange(len(rows)) + k * len(rows) for k in (0, 1))
        start += 2 * len(rows)
        edges += [(a, b), (a, c)]
        corners = [(a, ab, ac)] if inside == 1 else [(ab, b, c), (ab, c, ac)]
        pieces += [np.stack(each, axis=1) for each in corners]
        owners += [rows] * len(corners)
    first, second = (np.concatenate([pair[k] for pair in edges]) for k in (0, 1))
    share = (level[first] / (level[first] - level[second]))[:, None]
    owner = np.concatenate(owners)

    def between(of: Array) -> Array:
        shares = share if of.ndim == 2 else share[:, 0]
        return np.concatenate([of, of[first] * (1 - shares) + of[second] * shares])

    return Skin(
        points=between(skin.points),
        normals=between(skin.normals),
        values=between(skin.values),
        triangles=np.concatenate(pieces),
        patch=skin.patch[owner],
        side=None if skin.side is None else skin.side[owner],
    )


def _cut_face(at: StateFields, cut: Cut, whole: Array, values: Array) -> Skin:
    """Cut face of the whole actuator: the plane within small straight tetrahedra that make up its cells."""
    mesh = at.mesh
    N, pieces = _straight(mesh)
    shared = len(values) == len(mesh.points)
    by_cell = values[mesh.cells if shared else at.facts.region_nodes.cells]
    field, now, before = (np.einsum("qa,ca...->cq...", N, each) for each in (by_cell, at.points[mesh.cells],
                                                                               mesh.points[mesh.cells]))  # fmt: skip
    region = np.empty(len(mesh.cells), dtype=np.int64)
    for number, cells in enumerate(mesh.regions.values()):
        region[cells] = number
    corners = (pieces + N.shape[0] * np.arange(len(mesh.cells))[:, None, None]).reshape(-1, 4)
    owner = np.repeat(region, len(pieces))
    parts = []
    for image in at.facts.images:
        level = cut.level(image.of(before).reshape(-1, 3), whole)
        parts.append(_crossed(corners, level, (image.of(now).reshape(-1, 3), field.ravel()), owner))
    points, normals, face_values, patch = (np.concatenate(each) for each in zip(*parts, strict=True))
    triangles = np.arange(len(points)).reshape(-1, 3)
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-30)
    return Skin(
        points=points, normals=np.repeat(normals, 3, axis=0), values=face_values, triangles=triangles, patch=patch
    )


def _crossed(corners: Ints, level: Array, of: tuple[Array, Array], owner: Ints) -> tuple[Array, Array, Array, Ints]:
    """Triangles where a plane crosses tetrahedra: corners (3 t, 3), normals (t, 3), values (3 t,), owners (t,)."""
    order = np.argsort(level[corners], axis=1)
    sorted_corners = np.take_along_axis(corners, order, axis=1)
    below = (level[corners] < 0).sum(axis=1)
    edges = {1: [((0, 1), (0, 2), (0, 3))], 3: [((3, 0), (3, 1), (3, 2))],
             2: [((0, 2), (0, 3), (1, 3)), ((0, 2), (1, 3), (1, 2))]}  # fmt: skip
    points, normals, values = [np.zeros((0, 3))], [np.zeros((0, 3))], [np.zeros(0)]
    owners = [np.zeros(0, dtype=np.int64)]
    for count, triangles in edges.items():
        rows = np.flatnonzero(below == count)
        for triangle in triangles:
            ends = np.array(triangle)
            a, b = (sorted_corners[rows][:, ends[:, k]].ravel() for k in (0, 1))
            share = level[a] / (level[a] - level[b])
            crossings = of[0][a] * (1 - share)[:, None] + of[0][b] * share[:, None]
            points.append(crossings)
            away = crossings.reshape(-1, 3, 3)
            normal = np.cross(away[:, 1] - away[:, 0], away[:, 2] - away[:, 0])
            to_front = of[0][sorted_corners[rows][:, 0]] - away[:, 0]
            normals.append(normal * np.sign(np.einsum("ti,ti->t", normal, to_front))[:, None])
            values.append(of[1][a] * (1 - share) + of[1][b] * share)
            owners.append(owner[rows])
    return np.concatenate(points), np.concatenate(normals), np.concatenate(values), np.concatenate(owners)


def _straight(mesh: Mesh) -> tuple[Array, Ints]:
    """Shape functions (q, k) at a lattice in a cell, and the straight tetrahedra (s, 4) between its points."""
    kind = mesh.cell_type
    return _of_tetrahedron(kind.nodes) if kind.nodes == 10 else _of_hexahedron(kind.nodes)


@cache
def _of_tetrahedron(nodes: int) -> tuple[Array, Ints]:
    middle = {frozenset(edge): 4 + number for number, edge in enumerate(TETRAHEDRON_EDGES)}

    def m(a: int, b: int) -> int:
        return middle[frozenset((a, b))]

    ends = [(a, *(m(a, b) for b in range(4) if b != a)) for a in range(4)]
    ring = (m(0, 2), m(0, 3), m(1, 3), m(1, 2))
    inner = [(m(0, 1), m(2, 3), ring[k], ring[(k + 1) % 4]) for k in range(4)]
    return np.eye(nodes), np.array([*ends, *inner])


@cache
def _of_hexahedron(nodes: int) -> tuple[Array, Ints]:
    places = list(product((0, 1, 2), repeat=3))
    number = {place: k for k, place in enumerate(places)}
    lattice = np.array(places, dtype=np.float64) / 2
    pieces = []
    for corner in product((0, 1), repeat=3):
        for order in permutations(range(3)):
            step, path = np.array(corner), [number[corner]]
            for axis in order:
                step = step + np.eye(3, dtype=np.int64)[axis]
                path.append(number[tuple(int(c) for c in step)])
            pieces.append(path)
    return tables_at(nodes, lattice, np.ones(len(lattice))).N, np.array(pieces)


def _joined(behind: Skin, face: Skin) -> Skin:
    """Skin and cut face as one; regions meet in lines on the cut face."""
    first = int(behind.patch.max()) + 1
    side = None
    if behind.side is not None:
        side = np.concatenate([behind.side, np.full(len(face.triangles), int(behind.side.max()) + 1)])
    return replace(
        behind,
        points=np.concatenate([behind.points, face.points]),
        normals=np.concatenate([behind.normals, face.normals]),
        values=np.concatenate([behind.values, face.values]),
        triangles=np.concatenate([behind.triangles, face.triangles + len(behind.points)]),
        patch=np.concatenate([behind.patch, face.patch + first]),
        side=side,
    )
