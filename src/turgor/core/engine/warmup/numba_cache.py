"""Numba's cache of compiled kernels: its folder, and what happens to damaged files."""

import os
import warnings
from pathlib import Path
from typing import Any

import numba
from numba.core.caching import Cache

from turgor.foundation.startup.kernel_folder import VARIABLE, folder
from turgor.foundation.store.caches import FOLDER


def prepare_kernel_cache() -> Path | None:
    """Choose a folder in which numba can save compiled kernels, and warn if it is one that nobody would expect.

    Numba saves them next to its sources, or else in the user's cache folder, and fails where it can write neither, as
    in a container with a read-only home.

    Returns
    -------
    Path or None
        The folder; None where numba chooses one by itself.
    """
    stated = os.environ.get(VARIABLE)
    place = folder()
    Cache.load_overload = _load_or_drop
    if place is None:
        return None
    numba.config.CACHE_DIR = os.environ[VARIABLE] = str(place)
    if str(place) != stated and not os.environ.get(FOLDER):
        warnings.warn(
            f"compiled code goes to {place}, because neither the folder of turgor nor the cache of the user can be "
            f"written by this user alone; set {FOLDER} to choose another folder.",
            stacklevel=2,
        )
    return place


_load = Cache.load_overload


def _load_or_drop(cache: Any, *which: Any) -> Any:
    """Load a compiled kernel; a damaged file, as after a power failure, is removed and the kernel compiled again."""
    try:
        return _load(cache, *which)
    except Exception as error:  # pickles of a damaged file fail in any way
        cache.flush()
        warnings.warn(
            f"a damaged file in the cache of compiled kernels was removed ({type(error).__name__}) and is made again.",
            stacklevel=2,
        )
        return None
