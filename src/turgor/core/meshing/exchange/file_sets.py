"""Node sets of mesh files: named edges and points, which are no faces."""

from collections.abc import Mapping

import numpy as np

from turgor.core.meshing.exchange.formats.raw import Ints, RawMesh
from turgor.core.meshing.exchange.solids import Solids
from turgor.core.meshing.nodes.node_sets import with_new_middles


def sets_of_file(raw: RawMesh, solids: Solids, faces: Mapping[str, Ints]) -> dict[str, Ints]:
    """Nodes of each set, edge and point of the file that a person named and that is no face.

    Parameters
    ----------
    raw : RawMesh
    solids : Solids
    faces : mapping of str to (f,) int array
        Faces of the file, whose names are taken.

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
