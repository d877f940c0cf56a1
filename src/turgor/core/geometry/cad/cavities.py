"""Cavities of a part: closed voids, and pockets with one opening to the outside."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from turgor.core.geometry.cad.facets import Facets, edge_pairs, flux
from turgor.core.geometry.shapes.tolerances import TOLERANCE

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Opening:
    """Opening of a cavity to the outside.

    Parameters
    ----------
    area : float [CAD units²]
        Area of the cap.
    center : (3,) float array [CAD units]
        Mean of the rim.
    """

    area: float
    center: Array


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Hollow:
    """A closed void, a pocket with one opening, or a passage with several.

    Parameters
    ----------
    faces : tuple of int
        CAD faces that are its walls.
    volume : float [CAD units³]
        Volume of the facets, with each opening closed by a fan of triangles from the middle of its rim.
    openings : tuple of Opening
        None for a void.
    """

    faces: tuple[int, ...]
    volume: float
    openings: tuple[Opening, ...]


@dataclass(frozen=True, slots=True, eq=False)
class _Patches:
    """Connected patches of faces, and the edges between them."""

    points: Array
    triangles: Ints
    patch: Ints  # (t,) patch of each triangle
    face: Ints  # (p,) CAD face of each patch
    pairs: Ints  # (e, 2) patches on the two sides of each edge between two patches
    edges: Ints  # (e, 2) its corners
    origin: Array

    def components(self, cut: NDArray[np.bool_]) -> tuple[int, Ints]:
        """Return the number of pieces of the surface after cuts along some edges, and the piece of each patch."""
        a, b = self.pairs[~cut].T
        count = len(self.face)
        graph = coo_array((np.ones(len(a)), (a, b)), shape=(count, count))
        pieces, label = connected_components(graph, directed=False)
        return int(pieces), label.astype(np.int64)

    def volume(self, patches: Ints, rims: Sequence[Ints]) -> tuple[float, list[Opening]]:
        """Return the volume within patches closed by fans, positive for normals that point out, and the openings."""
        rows = np.isin(self.patch, patches)
        total, openings = flux(self.points, self.triangles[rows], self.origin), []
        directed = rim(self.triangles[rows])
        for cut in rims:
            mine = directed[(np.isin(directed, np.unique(cut))).all(axis=1)]
            apex = self.points[np.unique(mine)].mean(axis=0)
            a, b = self.points[mine[:, 1]] - apex, self.points[mine[:, 0]] - apex
            area = np.cross(a, b).sum(axis=0) / 2
            total += float((apex - self.origin) @ area) / 3
            openings.append(Opening(area=float(np.linalg.norm(area)), center=apex))
        return total, openings


def find_hollows(facets: Facets) -> tuple[list[Hollow], list[Hollow], list[Hollow]]:
    """Find the voids, pockets and passages of a part.

    A closed piece of the surface with inward normals is a void. For pockets, the surface is cut along each closed chain
    of edges that bounds a face. A part that the cut separates is a pocket if its normals point inward once the cut is
    capped. Of nested pockets the outermost one counts.

    Parameters
    ----------
    facets : Facets
        Surface of the part.

    Returns
    -------
    hollows : list of Hollow
        Voids and outermost pockets, the largest first.
    nested : list of Hollow
        Pockets within these pockets: the same cavity, closed further inside.
    passages : list of Hollow
        Holes with two openings or more.
    """
    patches = _patches(facets)
    dent = TOLERANCE.round_off * float(np.prod(np.ptp(facets.points, axis=0)))
    none = np.zeros(len(patches.pairs), dtype=bool)
    count, piece = patches.components(none)
    voids: list[Ints] = []
    solid: list[Ints] = []
    for i in range(count):
        members = np.flatnonzero(piece == i)
        volume, _ = patches.volume(members, [])
        (solid if volume > 0 else voids).append(members)
    outside = np.concatenate([np.zeros(0, dtype=np.int64), *solid])
    rims = _rims(patches, outside)
    pockets = []
    for owner, cut in rims:
        pocket = _pocket(patches, owner, cut)
        if pocket is not None and pocket[1].volume > dent:
            pockets.append(pocket)
    outermost, nested = _outermost(pockets)
    taken = np.concatenate([np.zeros(0, dtype=np.int64), *[members for members, _ in outermost]])
    passages = [p for p in _passages(patches, rims, np.setdiff1d(outside, taken), dent) if p.volume > dent]
    hollows = [_hollow(patches, members, []) for members in voids] + [hollow for _, hollow in outermost]
    return sorted(hollows, key=lambda hollow: -hollow.volume), [hollow for _, hollow in nested], passages


def _patches(facets: Facets) -> _Patches:
    triangles, face = facets.triangles[facets.outer], facets.face[facets.outer]
    pairs, edges, _ = edge_pairs(triangles)
    same = face[pairs[:, 0]] == face[pairs[:, 1]]
    count = len(triangles)
    a, b = pairs[same].T
    _, patch = connected_components(coo_array((np.ones(len(a)), (a, b)), shape=(count, count)), directed=False)
    _, first = np.unique(patch, return_index=True)
    return _Patches(
        points=facets.points,
        triangles=triangles,
        patch=patch.astype(np.int64),
        face=face[first],
        pairs=patch[pairs[~same]].astype(np.int64),
        edges=edges[~same],
        origin=facets.points.mean(axis=0),
    )


def rim(triangles: Ints) -> Ints:
    """Return the boundary edges of triangles, in the direction of their triangle, (e, 2)."""
    directed = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    _, index, count = np.unique(np.sort(directed, axis=1), axis=0, return_index=True, return_counts=True)
    return np.asarray(directed[index[count == 1]])


def _rims(patches: _Patches, among: Ints) -> list[tuple[int, Ints]]:
    """Closed chains of edges around patches that have two or more of them: (patch, edges)."""
    rims = []
    for owner in among:
        own = np.flatnonzero((patches.pairs == owner).any(axis=1))
        around = chains(patches.edges[own])
        if len(around) > 1:
            rims += [(int(owner), own[chain]) for chain in around]
    return rims


def chains(edges: Ints, *, closed: bool = True) -> list[Ints]:
    """Sort edges into connected chains.

    Parameters
    ----------
    edges : (e, 2) int array
        Corners at the two ends.
    closed : bool
        Whether to keep only loops, which have two edges at every corner.

    Returns
    -------
    list of (k,) int array
        Indices of the edges of each chain.
    """
    if not len(edges):
        return []
    nodes, ends = np.unique(edges, return_inverse=True)
    ends = ends.reshape(-1, 2)
    graph = coo_array((np.ones(len(ends)), (ends[:, 0], ends[:, 1])), shape=(len(nodes), len(nodes)))
    label = connected_components(graph, directed=False)[1]
    simple = np.bincount(ends.ravel(), minlength=len(nodes)) == 2
    return [
        np.flatnonzero(label[ends[:, 0]] == i)
        for i in range(int(label.max()) + 1)
        if not closed or simple[label == i].all()
    ]


def _pocket(patches: _Patches, owner: int, cut: Ints) -> tuple[Ints, Hollow] | None:
    """Pocket that a cut separates from a patch, if its normals point inward."""
    mask = np.zeros(len(patches.pairs), dtype=bool)
    mask[cut] = True
    _, piece = patches.components(mask)
    beyond = int(patches.pairs[cut[0]][patches.pairs[cut[0]] != owner][0])
    if piece[beyond] == piece[owner]:
        return None
    members = np.flatnonzero(piece == piece[beyond])
    hollow = _hollow(patches, members, [patches.edges[cut]])
    return (members, hollow) if hollow.volume > 0 else None


def _hollow(patches: _Patches, members: Ints, rims: Sequence[Ints]) -> Hollow:
    volume, openings = patches.volume(members, rims)
    faces = tuple(int(face) for face in np.unique(patches.face[members]))
    return Hollow(faces=faces, volume=-volume, openings=tuple(openings))


def _outermost(pockets: list[tuple[Ints, Hollow]]) -> tuple[list[tuple[Ints, Hollow]], list[tuple[Ints, Hollow]]]:
    """Separate the outermost pockets from those that lie in larger ones.

    A pocket that adds only flat faces to those within it does not count, such as the plane end in which several of
    them open.
    """
    outermost: list[tuple[Ints, Hollow]] = []
    nested: list[tuple[Ints, Hollow]] = []
    for members, hollow in sorted(pockets, key=lambda item: len(item[0])):
        within = [i for i, (other, _) in enumerate(outermost) if np.isin(other, members).any()]
        if sum(outermost[i][1].volume for i in within) >= (1 - TOLERANCE.volume) * hollow.volume:
            continue
        nested += [outermost[i] for i in within]
        outermost = [item for i, item in enumerate(outermost) if i not in within]
        outermost.append((members, hollow))
    return outermost, sorted(nested, key=lambda item: -item[1].volume)


def _passages(patches: _Patches, rims: list[tuple[int, Ints]], among: Ints, dent: float) -> list[Hollow]:
    """Holes with several openings: the surface is cut along all chains, and adjacent inward pieces are joined."""
    cut = np.zeros(len(patches.pairs), dtype=bool)
    for _, chain in rims:
        cut[chain] = True
    _, piece = patches.components(cut)
    volumes = np.full(len(patches.face), np.inf)
    for i in np.unique(piece[among]):
        members = np.flatnonzero(piece == i)
        own = patches.edges[cut & (np.isin(patches.pairs, members).sum(axis=1) == 1)]
        volumes[members], _ = patches.volume(members, [own[chain] for chain in chains(own)])
    inward = volumes < -dent
    for i in np.unique(piece[np.abs(volumes) <= dent]):  # flat steps of a hole belong to the surface around them
        around = patches.pairs[(piece[patches.pairs] == i).sum(axis=1) == 1]
        inward[piece == i] = inward[around[piece[around] != i]].all()
    joined = cut & ~inward[patches.pairs].all(axis=1)
    _, piece = patches.components(joined)
    passages = []
    for i in np.unique(piece[inward]):
        members = np.flatnonzero((piece == i) & inward)
        own = patches.edges[joined & (np.isin(patches.pairs, members).sum(axis=1) == 1)]
        ends = chains(own)
        if len(ends) > 1:
            passages.append(_hollow(patches, members, [own[chain] for chain in ends]))
    return passages
