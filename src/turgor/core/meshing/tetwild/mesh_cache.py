"""Meshes of fTetWild on disk, so that the same part gets the same mesh again, and at once.

fTetWild inserts the facets in a random order that cannot be seeded: each call gives another mesh, and with it another
number within the mesh error.
"""

from collections.abc import Callable, Mapping
from importlib.metadata import version

import numpy as np
from numpy.typing import NDArray

from turgor.foundation.store.cached_values import Cache, without_order

Array = NDArray[np.float64]
Ints = NDArray[np.int64]

#: The meshes, each of about a megabyte.
MESHES = Cache("meshes", 200e6)


def cached_cells(inputs: Mapping[str, object], make: Callable[[], tuple[Array, Ints]]) -> tuple[Array, Ints]:
    """Return the points and cells that were made for these inputs before, or make and save them.

    Parameters
    ----------
    inputs : mapping of str to array or number
        All that the mesh depends on.
    make : callable
        Returns points (n, 3) and cells (m, 4).
    """
    key = version("pytetwild"), without_order(inputs)
    match MESHES.get(*key):
        case np.ndarray() as points, np.ndarray() as cells:
            return points, cells
    new = make()
    MESHES.put(new, *key)
    return new
