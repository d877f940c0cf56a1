"""Folder of compiled kernels: where it is, and which groups of kernels are compiled. Nothing here imports numba."""

import hashlib
import os
import sys
import tempfile
import warnings
from functools import cache
from importlib.util import find_spec
from pathlib import Path

from platformdirs import user_cache_path

from turgor.foundation.store import caches

#: Variable that names the folder of compiled kernels, read by numba.
VARIABLE = "NUMBA_CACHE_DIR"

#: Group of kernels that every model needs: where these are compiled, so are probably the others.
FIRST = "pattern"

#: Endings of what numba writes, and of a `marker`.
_COMPILED = frozenset({".nbi", ".nbc", ".compiled"})

_ENGINE = Path(__file__).parents[2] / "core" / "engine"


def usual() -> tuple[Path, ...]:
    """Return the folders that numba tries by itself: one of the package, and one of the user."""
    return _ENGINE / "cells" / "__pycache__", user_cache_path("numba")


def folder() -> Path | None:
    """Return the folder of compiled kernels: a stated one, or one of this user alone.

    numba loads what it finds there as code, so a folder that others could write into is not used. The name of the
    folder for temporary files can be predicted. So that folder serves only if it is this user's alone; else a new one
    with a random name serves this process and those that it starts. A warning says which folder was chosen so.

    Returns
    -------
    Path or None
        None where numba chooses one by itself.
    """
    stated = os.environ.get(VARIABLE)
    if stated and caches.private(Path(stated).resolve()):
        return Path(stated)
    if os.environ.get(caches.FOLDER):
        own = caches.cache_folder("compiled")
        if own is not None:
            return own
    elif writable(usual()[0]) or caches.private(usual()[1]):
        return None
    shared = Path(tempfile.gettempdir()) / f"turgor-compiled-{os.getuid() if hasattr(os, 'getuid') else 'user'}"
    other = shared if caches.private(shared) else Path(tempfile.mkdtemp(prefix="turgor-compiled-"))
    os.environ[VARIABLE] = str(other)
    chosen = os.environ.get(caches.FOLDER)
    others = f"'{chosen}' cannot" if chosen else "neither the folder of turgor nor the cache of the user can"
    warnings.warn(
        f"compiled code goes to {other}, because {others} be written by this user alone; set {caches.FOLDER} to choose "
        "another folder.",
        stacklevel=2,
    )
    return other


def compiled_files() -> list[Path]:
    """Return the files of compiled kernels, in whatever folder they are."""
    place = folder()
    if place is not None:
        return sorted(file for file in place.rglob("*") if file.suffix in _COMPILED)
    files = {file for file in _ENGINE.rglob("__pycache__/*") if file.suffix in _COMPILED}
    for source in {file.parent for file in _ENGINE.rglob("*.py")}:  # numba names its folders so
        name = f"{source.name}_{hashlib.sha1(str(source).encode(), usedforsecurity=False).hexdigest()}"
        files |= {file for file in (usual()[1] / name).glob("*") if file.suffix in _COMPILED}
    return sorted(files)


def writable(folder: Path) -> bool:
    """Return whether a file can be written into a folder, which is made where it is missing."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=folder):
            return True
    except OSError:
        return False


def marker(name: str) -> Path:
    """Return the file that says that a group of kernels is compiled.

    It lies in the folder of the kernels and is removed with them. Its name changes with the versions of Python and
    numba and with the sources, as these make numba compile again.
    """
    place = folder() or next(filter(writable, usual()))
    return place / f"turgor-{name}-{_circumstances()}.compiled"


@cache
def _circumstances() -> str:
    numba = find_spec("numba")
    sources = [*_ENGINE.rglob("*.py"), *([Path(numba.origin)] if numba and numba.origin else [])]
    newest = max((file.stat().st_mtime_ns for file in sources), default=0)  # none in a frozen program
    circumstances = (sys.version, os.name, str(_ENGINE), len(sources), newest)
    return hashlib.sha256(str(circumstances).encode()).hexdigest()[:10]
