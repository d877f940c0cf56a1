"""Numba's cache of compiled kernels: its folder, and what happens to damaged files."""

import os
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from hashlib import sha256
from io import BytesIO
from pathlib import Path
from typing import IO, Any

import numba
from numba.core.caching import Cache, IndexDataCacheFile

from turgor.foundation.startup.kernel_folder import VARIABLE, folder


def prepare_kernel_cache() -> Path | None:
    """Choose a folder in which numba can save compiled kernels.

    Numba saves them next to its sources, or else in the user's cache folder, and fails where it can write neither, as
    in a container with a read-only home.

    Returns
    -------
    Path or None
        The folder; None where numba chooses one by itself.
    """
    place = folder()
    Cache.load_overload = _load_or_drop
    IndexDataCacheFile._open_for_write = _open_sealed
    IndexDataCacheFile._load_index, IndexDataCacheFile._load_data = _checked_index, _checked_data
    if place is not None:
        numba.config.CACHE_DIR = os.environ[VARIABLE] = str(place)
    return place


_load, _open = Cache.load_overload, IndexDataCacheFile._open_for_write
_load_index, _load_data = IndexDataCacheFile._load_index, IndexDataCacheFile._load_data

#: Ends a file of the cache, before a hash of all that stands before it. A pickle ends earlier, so numba can do without.
_SEAL = b"turgor sha256"


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


@contextmanager
def _open_sealed(cache: Any, path: str) -> Iterator[IO[bytes]]:
    """Write a file of the cache with its hash: compiled code with one wrong bit would crash, or give another number."""
    with _open(cache, path) as file:
        content = BytesIO()
        yield content
        file.write(content.getvalue() + _SEAL + sha256(content.getvalue()).digest())


def _checked_index(cache: Any) -> Any:
    _check_seal(Path(cache._index_path))
    return _load_index(cache)


def _checked_data(cache: Any, name: str) -> Any:
    _check_seal(Path(cache._data_path(name)))
    return _load_data(cache, name)


def _check_seal(file: Path) -> None:
    """Refuse a file that is not as it was written; one without a hash is of an earlier version or another program."""
    content = file.read_bytes() if file.exists() else b""
    before, seal, hashed = content.rpartition(_SEAL)
    if seal and sha256(before).digest() != hashed:
        raise ValueError(f"'{file}' is damaged.")
