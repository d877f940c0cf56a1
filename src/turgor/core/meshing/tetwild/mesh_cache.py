"""Meshes kept on disk, so that a job gives the same mesh again and gets it at once.

fTetWild inserts the facets in a random order that cannot be seeded: each call gives another mesh, and with it another
number within the mesh error.
"""

import os
import warnings
import zlib
from collections.abc import Callable, Mapping
from contextlib import suppress
from hashlib import sha256
from importlib.metadata import version
from pathlib import Path
from zipfile import BadZipFile

import numpy as np
from numpy.typing import NDArray

from turgor.foundation.store.caches import cache_folder

Array = NDArray[np.float64]
Ints = NDArray[np.int64]

#: What reading a damaged file raises.
_DAMAGE = (OSError, EOFError, ValueError, KeyError, TypeError, BadZipFile, zlib.error, RuntimeError, MemoryError)

#: Most meshes that are kept, each of about half a megabyte; the oldest go first.
MOST_MESHES = 200


def kept_cells(inputs: Mapping[str, object], make: Callable[[], tuple[Array, Ints]]) -> tuple[Array, Ints]:
    """Return the points and cells that were made for these inputs before, or make and keep them.

    Parameters
    ----------
    inputs : mapping of str to array or number
        All that the mesh depends on.
    make : callable
        Returns points (n, 3) and cells (m, 4).

    Notes
    -----
    A cache that cannot be read or written costs time, and no result depends on it.
    """
    folder = cache_folder("meshes")
    if folder is None:
        return make()
    path = folder / f"{_key(inputs)}.npz"
    try:
        with np.load(path, allow_pickle=False) as kept:
            return kept["points"], kept["cells"]
    except FileNotFoundError:
        pass
    except _DAMAGE as error:
        warnings.warn(f"a damaged mesh in the cache is made again ({type(error).__name__}).", stacklevel=2)
    points, cells = make()
    _keep(path, points, cells)
    return points, cells


def _key(inputs: Mapping[str, object]) -> str:
    """A name for the inputs: the same bytes and the same mesher give the same name."""
    digest = sha256(version("pytetwild").encode())
    for name, value in sorted(inputs.items()):
        array = np.ascontiguousarray(value)
        digest.update(f"{name} {array.dtype.str} {array.shape} ".encode())
        digest.update(array.tobytes())
    return digest.hexdigest()[:32]


def _keep(path: Path, points: Array, cells: Ints) -> None:
    """Write a mesh in one step, so that no other process reads half of it, and drop the oldest ones."""
    part = path.with_name(f"{path.stem}.{os.getpid()}.part")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        with part.open("wb") as file:
            np.savez_compressed(file, points=points, cells=cells)
        part.replace(path)
        by_age = sorted(path.parent.glob("*.npz"), key=lambda each: each.stat().st_mtime)
        for old in by_age[:-MOST_MESHES]:
            old.unlink(missing_ok=True)
    except OSError:
        with suppress(OSError):
            part.unlink(missing_ok=True)
