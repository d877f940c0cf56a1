"""Node sets of mesh files: named edges and points, which are no faces."""

from collections.abc import Collection, Mapping

import numpy as np

from turgor.core.meshing.exchange.boundary import Sides
from turgor.core.meshing.exchange.formats.raw import Ints, RawMesh
from turgor.core.meshing.exchange.solids import Solids
from turgor.core.meshing.nodes.node_sets import with_new_middles


def whole_faces(raw: RawMesh, solids: Solids, sides: Sides, faces: Mapping[str, Ints]) -> set[str]:
    """Names of faces, without those whose set in the file has further corners, off the sides of the face.

    Parameters
    ----------
    raw : RawMesh
    solids : Solids
    sides : Sides
    faces : mapping of str to (f,) int array
        Rows of ``sides.nodes``.
    """
    corners = np.unique(solids.cells[:, : solids.kind.corners])
    whole = set(faces)
    for name in set(faces) & set(raw.node_sets):
        members = np.intersect1d(solids.renumbered[raw.node_sets[name]], corners)
        if not np.isin(members, sides.corners[faces[name]]).all():
            whole.remove(name)
    return whole


def sets_of_file(raw: RawMesh, solids: Solids, faces: Collection[str]) -> dict[str, Ints]:
    """Nodes of each set, edge and point of the file that a person named and that is no face.

    Parameters
    ----------
    raw : RawMesh
    solids : Solids
    faces : collection of str
        Faces of the file that have all nodes of their sets.

    Returns
    -------
    dict of str to (k,) int array
        Rows of ``solids.points``, with the middles of edges that the file lacks.
    """
    named = {name: [nodes] for name, nodes in raw.node_sets.items() if len(nodes) < len(raw.points)}
    for block in raw.blocks:
        for name, rows in block.groups.items() if block.kind.dimension < 2 else ():
            named.setdefault(name, []).append(block.nodes[rows].ravel())
    new = np.ones(len(solids.points), dtype=bool)
    new[solids.renumbered[solids.renumbered >= 0]] = False
    sets = {}
    for name, parts in named.items():
        nodes = solids.renumbered[np.concatenate(parts)]
        members = np.zeros(len(solids.points), dtype=bool)
        members[nodes[nodes >= 0]] = True
        if raw.named and name not in faces and members.any():
            sets[name] = np.flatnonzero(with_new_middles(solids.cells, members, new))
    return dict(sorted(sets.items()))
