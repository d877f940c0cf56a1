"""Cache of compiled loops: where numba keeps them, and what happens to damaged ones."""

import os
import warnings
from pathlib import Path
from typing import Any

import numba
from numba.core.caching import Cache

from turgor.foundation.kernel_cache import VARIABLE, folder


def keep_compiled_loops() -> Path | None:
    """See to it that compiled loops can be kept.

    numba keeps them beside its sources, or else in the user's cache folder, and fails where it can write neither, as
    in a container with a read-only home.

    Returns
    -------
    Path or None
        The folder; None where numba looks by itself.
    """
    place = folder()
    Cache.load_overload = _load_or_drop
    if place is not None:
        numba.config.CACHE_DIR = os.environ[VARIABLE] = str(place)
    return place


_load = Cache.load_overload


def _load_or_drop(cache: Any, *which: Any) -> Any:
    """Load a compiled loop; what is damaged, as after a power failure, is dropped and compiled again."""
    try:
        return _load(cache, *which)
    except Exception as error:  # pickles of a damaged file fail in any way
        cache.flush()
        warnings.warn(
            f"a damaged file in the cache of compiled loops was dropped ({type(error).__name__}) and is made again.",
            stacklevel=2,
        )
        return None
