"""Cut films without a solid: every side becomes four, which are exact pieces of it."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from turgor.core.meshing.mesh import Mesh
from turgor.core.meshing.nodes.node_sets import refined_sets
from turgor.core.meshing.refining.split_hexahedra import node_keys, parts_of, reference_grid, weights_at
from turgor.foundation.display import brief

Array = NDArray[np.float64]
Ints = NDArray[np.int64]

#: A side that stands for an edge between two corners: its nodes among those of a piece with an area.
_EDGE = [0, 1, 1, 0, 4, 4, 4, 4, 4]


@dataclass(frozen=True, slots=True, eq=False)
class FilmRefinement:
    """A finer mesh of films, and how its nodes lie in the sides of the coarser one.

    Parameters
    ----------
    mesh : Mesh
        The finer mesh.
    nodes : (n, 9) int array
        Nodes of the side of the coarser mesh that each node lies in.
    shares : (n, 9) array
        Shape functions of that side at the node.
    """

    mesh: Mesh
    nodes: Ints
    shares: Array

    __repr__ = brief


def refine_films(mesh: Mesh) -> FilmRefinement:
    """Cut every side of films in four.

    Parameters
    ----------
    mesh : Mesh
        Nine-node sides without cells.

    Returns
    -------
    FilmRefinement
        With the names of the mesh.
    """
    boxes = parts_of((True, True))
    at = weights_at(reference_grid(2)) @ boxes  # (4, 9, 2), in the coordinates of the side that is cut
    every = np.concatenate([mesh.film_sides, *mesh.faces.values()])  # nodes of edges are those of sides with an area
    keys = _keys(every, at)
    unique, first = np.unique(keys, return_index=True)
    rows, where = np.divmod(first, at.shape[0] * at.shape[1])
    corner = np.isin(unique, keys[:, :, :4])
    order = np.argsort(~corner, kind="stable")
    number = np.empty(len(unique), dtype=np.int64)
    number[order] = np.arange(len(unique))
    nodes, shares = every[rows[order]], _shares(at.reshape(-1, 2))[where[order]]
    points = np.einsum("na,nai->ni", shares, mesh.points[nodes])
    faces = {}
    for name, sides in mesh.faces.items():
        pieces = number[np.searchsorted(unique, _keys(sides, at))]
        flat = sides[:, 0] == sides[:, 3]
        edges = pieces[flat][:, boxes[:, 0, 1] == 0][..., _EDGE]
        faces[name] = np.concatenate([pieces[~flat].reshape(-1, 9), edges.reshape(-1, 9)])
    fine = replace(mesh, points=points, faces=faces)
    fine = replace(fine, node_sets=refined_sets(mesh, points, fine.film_sides))
    return FilmRefinement(fine, nodes, shares)


def _keys(sides: Ints, at: Array) -> NDArray[np.uint64]:
    """Keys (f, 4, 9) of the nodes of all parts of sides."""
    weights = weights_at(at.reshape(-1, 2))
    keys = node_keys(sides[:, :4], np.broadcast_to(weights, (len(sides), *weights.shape)))
    return keys.reshape(len(sides), *at.shape[:2])


def _shares(at: Array) -> Array:
    """Shape functions (k, 9) of a nine-node side at reference coordinates (k, 2)."""
    grid = np.rint(2 * reference_grid(2)).astype(int)  # 0, 1, 2 along each direction
    factors = np.stack([2 * (at - 0.5) * (at - 1), 4 * at * (1 - at), 2 * at * (at - 0.5)], axis=-1)
    return np.asarray(factors[:, 0][:, grid[:, 0]] * factors[:, 1][:, grid[:, 1]])
