"""Ties by elimination: middles of hexahedra that follow the nodes of their side or cell, and linear equations."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from functools import lru_cache

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray

from turgor.core.engine.algebra.boundary import PrescribedComponents
from turgor.core.engine.algebra.multipoint import MultiPoint
from turgor.core.engine.algebra.node_frames import NodeFrames
from turgor.core.engine.algebra.settings import EQUATIONS
from turgor.core.meshing.cells import side_type
from turgor.core.meshing.mesh import Mesh
from turgor.core.meshing.middles import Middles, middles_of
from turgor.core.model.model import Model
from turgor.core.model.supports import Support
from turgor.foundation.errors import TurgorError
from turgor.units import mm

Ints = NDArray[np.int64]
Row = dict[int, float]

#: Nodes (k, m) and vectors (k, m, 3) of k equations.
Equations = tuple[NDArray[np.int64], NDArray[np.float64]]


def with_middles(prescribed: PrescribedComponents, mesh: Mesh) -> PrescribedComponents:
    """Let the middles of a mesh follow, whatever a support prescribes at them; other meshes change nothing.

    A middle follows along x, y and z. Where a node that it follows has directions of its own, or follows others itself,
    what that node follows takes its place. A middle of a rigid face or of a plane section follows these as before.
    """
    if not mesh.serendipity:
        return prescribed
    middles = middles_of(mesh.cells)
    count = len(prescribed.mask)
    is_middle = np.zeros(count, dtype=bool)
    is_middle[middles.followers] = True
    before = _without_turned_middles(prescribed, is_middle)
    spread = _spread(before, middles)
    own = np.repeat(is_middle, 3)
    own[before.ties.followers] = False
    rows = np.flatnonzero(own)
    entries = spread[rows].tocoo()
    ties = MultiPoint(
        np.concatenate([before.ties.followers, rows[entries.row]]),
        np.concatenate([before.ties.leaders, entries.col.astype(np.int64)]),
        np.concatenate([before.ties.weights, entries.data]),
    )
    mask = before.mask.copy()
    mask[is_middle] = True
    moving = tuple((nodes[~is_middle[nodes]], axes, support) for nodes, axes, support in before.moving)
    return replace(before, mask=mask, moving=moving, ties=ties)


def _without_turned_middles(prescribed: PrescribedComponents, is_middle: NDArray[np.bool_]) -> PrescribedComponents:
    """The same without directions, and the ties along them, of middles."""
    frames, ties = prescribed.frames, prescribed.ties
    stays = ~is_middle[frames.nodes]
    turned = np.zeros(len(is_middle), dtype=bool)
    turned[frames.nodes[~stays]] = True
    tied = ~turned[ties.followers // 3]
    return replace(
        prescribed,
        frames=NodeFrames(frames.nodes[stays], frames.axes[stays]),
        normals=prescribed.normals[stays],
        ties=MultiPoint(ties.followers[tied], ties.leaders[tied], ties.weights[tied]),
    )


def _spread(prescribed: PrescribedComponents, middles: Middles) -> sp.csr_matrix:
    """Displacements of the middles along x, y and z from the components that do not follow."""
    count = len(prescribed.mask)
    weights = sp.csr_matrix((middles.weights, (middles.followers, middles.leaders)), shape=(count, count))
    out = (sp.kron(weights, sp.identity(3), format="csr") @ prescribed.spread()).tocsr()
    out.eliminate_zeros()
    return out


def with_equations(prescribed: PrescribedComponents, model: Model) -> PrescribedComponents:
    """Let a component of each `Equation` of a model follow the others, after all other supports and ties.

    What is prescribed or follows already is no candidate: its value, or what it follows, takes its place in the
    equation. An equation that the others imply is left out.

    Raises
    ------
    TurgorError
        If everything in an equation is prescribed, and something in it moves.
    """
    named = [(each.place, rows) for each in model.supports if (rows := _stated(each, model.mesh)) is not None]
    if not named:
        return prescribed
    size, count = prescribed.mask.size, 3 * len(model.mesh.points)
    spread = prescribed.spread()
    candidates = ~prescribed.mask.ravel()
    candidates[count:] = False
    moved = np.zeros_like(prescribed.mask)
    for nodes, _, _ in prescribed.moving:
        moved[nodes] = prescribed.mask[nodes]
    followed = eliminated(named, spread, candidates, moved.ravel())
    prescribed.mask.ravel()[list(followed)] = True
    return replace(prescribed, ties=_joined(prescribed.ties, followed, size))


def eliminated(
    named: Iterable[tuple[str, Equations]],
    spread: sp.csr_matrix,
    candidates: NDArray[np.bool_],
    moved: NDArray[np.bool_],
) -> dict[int, Row]:
    """Solve equations for one component each, which follows others that follow nothing.

    Parameters
    ----------
    named : iterable of (str, (nodes, vectors))
        Equations, and their names for messages.
    spread : (m, n) sparse matrix
        Displacements along x, y and z of all nodes from the components.
    candidates, moved : (n,) bool arrays
        Components that may follow, and those that a support moves.

    Raises
    ------
    TurgorError
        If no component of an equation may follow, and one is moved.
    """
    followed: dict[int, Row] = {}
    for name, (nodes, vectors) in named:
        _eliminate(followed, name, _rows(nodes, vectors, spread), candidates, moved)
    return followed


def _stated(support: Support, mesh: Mesh) -> Equations | None:
    """Nodes and vectors of the equations of a support."""
    return support.equations(mesh) if support.tied is None else _of_tie(mesh, *support.tied)


@lru_cache(maxsize=8)
def tied_sides(mesh: Mesh, face: str, other: str) -> tuple[Ints, Ints]:
    """Return the sides of a tied face whose nodes all lie on the other one, and those of the other below them."""
    from turgor.core.engine.faces.attached import on_face  # as below

    sides = mesh.carrying_sides(face)
    joined = np.concatenate([_followed(mesh, face, other)[0], mesh.face_nodes(other)])
    sides = sides[np.isin(sides, joined).all(axis=1)]
    corners = mesh.points[sides[:, : side_type(sides.shape[1]).corners]]
    return sides, on_face(mesh, other, corners.mean(axis=1))[0] if len(sides) else sides


def _of_tie(mesh: Mesh, face: str, other: str) -> Equations:
    """Equations between the nodes of a face and those of the sides of another one on which they lie."""
    own, nodes, shares = _followed(mesh, face, other)
    weights = np.concatenate([np.ones((len(own), 1)), -shares], axis=1)
    vectors = np.einsum("km,ij->kimj", weights, np.eye(3)).reshape(3 * len(own), -1, 3)
    return np.repeat(np.concatenate([own[:, None], nodes], axis=1), 3, axis=0), vectors


@lru_cache(maxsize=8)  # checks and stages ask again
def _followed(mesh: Mesh, face: str, other: str) -> tuple[Ints, Ints, NDArray[np.float64]]:
    """Nodes (k,) of a face that lie on another one, the nodes (k, n) of the sides there, and their shares."""
    from turgor.core.engine.faces.attached import on_face  # few models have ties, and this loads the search

    own = np.setdiff1d(np.intersect1d(mesh.face_nodes(face), mesh.carrying_sides(face)), mesh.face_nodes(other))
    nodes, shares, away = on_face(mesh, other, mesh.points[own])
    near = away <= EQUATIONS.tied_within * float(np.ptp(mesh.points, axis=0).max())
    if len(own) and not near.any():
        raise TurgorError(
            f"tie of '{face}': it lies {away.min() / mm:.3g} mm from '{other}'; they must touch, within "
            f"{EQUATIONS.tied_within * 100:g} % of the size of the part."
        )
    return own[near], nodes[near], shares[near]


def _rows(nodes: NDArray[np.int64], vectors: NDArray[np.float64], spread: sp.csr_matrix) -> Iterator[Row]:
    """Equations as factors of the components that do not follow."""
    count, width = nodes.shape
    columns = (3 * nodes[:, :, None] + np.arange(3)).ravel()
    stated = sp.csr_matrix(
        (vectors.ravel(), (np.repeat(np.arange(count), 3 * width), columns)), shape=(count, spread.shape[0])
    )
    largest = np.abs(vectors).max(initial=0.0)
    reduced = (stated @ spread).tocsr()
    for start, end in zip(reduced.indptr[:-1], reduced.indptr[1:], strict=True):
        row = dict(zip(reduced.indices[start:end].tolist(), reduced.data[start:end].tolist(), strict=True))
        yield {each: value for each, value in row.items() if abs(value) > EQUATIONS.round_off * largest}


def _eliminate(
    followed: dict[int, Row],
    name: str,
    rows: Iterable[Row],
    candidates: NDArray[np.bool_],
    moved: NDArray[np.bool_],
) -> None:
    """Add the followers of some equations to those of the equations before them; no leader follows."""
    users: dict[int, set[int]] = {}
    for follower, row in followed.items():
        for leader in row:
            users.setdefault(leader, set()).add(follower)
    for stated in rows:
        row = _substituted(stated, followed)
        free = {each: abs(value) for each, value in row.items() if candidates[each]}
        if not free:
            if any(moved[each] for each in row):
                raise TurgorError(
                    f"equation '{name}': the supports prescribe all displacements in it, and move some; leave one free."
                )
            continue
        pivot = max(free, key=lambda each: (round(free[each] / max(free.values()), 6), -each))
        share = row.pop(pivot)
        followed[pivot] = {each: -value / share for each, value in row.items()}
        for user in users.pop(pivot, set()):
            followed[user] = _substituted(followed[user], {pivot: followed[pivot]})
            for leader in followed[user]:
                users.setdefault(leader, set()).add(user)
        for leader in followed[pivot]:
            users.setdefault(leader, set()).add(pivot)


def _substituted(row: Row, followed: Mapping[int, Row]) -> Row:
    """A row with what its followers follow in their place, without round-off."""
    out: Row = {}
    for each, value in row.items():
        for leader, weight in followed[each].items() if each in followed else ((each, 1.0),):
            out[leader] = out.get(leader, 0.0) + value * weight
    largest = max(map(abs, row.values()), default=0.0)
    return {each: value for each, value in out.items() if abs(value) > EQUATIONS.round_off * largest}


def _joined(ties: MultiPoint, followed: Mapping[int, Row], size: int) -> MultiPoint:
    """Former ties with the new followers, none of which leads."""
    added = [(follower, leader, weight) for follower, row in followed.items() for leader, weight in row.items()]
    followers, leaders = (np.array([each[i] for each in added], dtype=np.int64) for i in (0, 1))
    new = MultiPoint(followers, leaders, np.array([each[2] for each in added], dtype=np.float64))
    own = np.unique(ties.followers)
    fixed = np.setdiff1d(list(followed), followers)  # those that follow nothing stay where they are
    chain = new.spread(size)
    chain[fixed, fixed] = 0.0
    former = (ties.spread(size)[own] @ chain).tocoo()
    return MultiPoint(
        np.concatenate([own[former.row], followers]),
        np.concatenate([former.col.astype(np.int64), leaders]),
        np.concatenate([former.data, new.weights]),
    )
