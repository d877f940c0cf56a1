"""Mirror planes of a deck: sets of nodes with the name that turgor gives them, fixed across."""

import numpy as np

from turgor.job.decks.names import MeshNames
from turgor.job.decks.steps import Path


def take_mirrors(path: Path, names: MeshNames) -> int:
    """Make fixed sets called ``symmetry_x``, ``symmetry_y`` and ``symmetry_z`` the mirror planes of a half or quarter.

    Their nodes need no support then. Nodes that are fixed in another direction, too, keep theirs.

    Parameters
    ----------
    path : Path
        Loses the supports that follow from the planes.
    names : MeshNames
        Takes the planes.

    Returns
    -------
    int
        How many images the whole body is.
    """
    for freedom, axis in enumerate("xyz", start=1):
        nodes = names.deck.nodes(f"symmetry_{axis}")
        if (
            names.deck.plane
            or nodes is None
            or not len(nodes)
            or not all((node, freedom) in path.fixed for node in nodes.tolist())
        ):
            continue
        if np.ptp([names.deck.place[int(node)][freedom - 1] for node in nodes]) == 0 and names.is_face(nodes):
            names.mirrors[f"symmetry_{axis}"] = nodes
    across = {"xyz".index(name[-1]) + 1 for name in names.mirrors}
    for name, nodes in names.mirrors.items():
        freedom = "xyz".index(name[-1]) + 1
        for node in nodes.tolist():
            if not any((node, each) in path.fixed for each in {1, 2, 3} - across):
                path.fixed.pop((node, freedom))
    return int(2 ** len(names.mirrors))
