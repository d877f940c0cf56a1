"""Folder of compiled loops: where numba keeps them, or another one where nothing can be written there."""

import os
import tempfile
import warnings
from pathlib import Path

import numba

from turgor.loops import VARIABLE, elsewhere, usual, writable


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
    if any(map(writable, [Path(stated)] if stated else [])) or any(map(writable, usual())):
        return None
    other = elsewhere()
    if not writable(other):
        other = Path(tempfile.mkdtemp(prefix="turgor-compiled-"))
    numba.config.CACHE_DIR = os.environ[VARIABLE] = str(other)
    warnings.warn(
        f"compiled code is kept in {other}, because neither the folder of turgor nor the user's cache can be written; "
        f"set {VARIABLE} to choose another folder.",
        stacklevel=2,
    )
    return other
