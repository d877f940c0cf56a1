"""Folder of compiled loops: where numba keeps them, or another one where nothing can be written there."""

import os
import tempfile
import warnings
from pathlib import Path

import numba
from platformdirs import user_cache_path

#: Variable that names the folder, read by numba.
VARIABLE = "NUMBA_CACHE_DIR"


def keep_compiled_loops() -> Path | None:
    """See to it that compiled loops can be kept, and say in one sentence where, if that is not the usual folder.

    numba keeps them beside its sources, or else in the user's cache folder, and fails where it can write neither, as
    in a container with a read-only home. They then go into a folder of the user below that for temporary files.

    Returns
    -------
    Path or None
        The other folder; None where a usual one serves.
    """
    stated = os.environ.get(VARIABLE)
    if any(map(_writable, [Path(stated)] if stated else [])) or any(map(_writable, _usual())):
        return None
    other = Path(tempfile.gettempdir()) / f"turgor-compiled-{os.getuid() if hasattr(os, 'getuid') else 'user'}"
    if not _writable(other):
        other = Path(tempfile.mkdtemp(prefix="turgor-compiled-"))
    numba.config.CACHE_DIR = os.environ[VARIABLE] = str(other)
    warnings.warn(
        f"compiled code is kept in {other}, because neither the folder of turgor nor the user's cache can be written; "
        f"set {VARIABLE} to choose another folder.",
        stacklevel=2,
    )
    return other


def _usual() -> tuple[Path, ...]:
    """The folders that numba tries by itself."""
    return Path(__file__).parent / "cells" / "__pycache__", user_cache_path("numba")


def _writable(folder: Path) -> bool:
    """Whether a file can be made in a folder, which is made where it is missing."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=folder):
            return True
    except OSError:
        return False
