"""Caches: folders of this user alone for files that can be made again, such as meshes and compiled kernels."""

import os
import stat
from pathlib import Path

from platformdirs import user_cache_path

#: Environment variable that names another folder than the user's folder for caches; it moves all of them.
FOLDER = "TURGOR_CACHE"

#: The caches, by the name of their folder.
PARTS = {
    "families": "shapes and meshes of actuator families",
    "meshes": "tetrahedral meshes of STL files",
    "parts": "parts that scripts drew",
    "laws": "derivatives of laws",
    "runs": "numbers of iterations of the last runs",
    "compiled": "compiled kernels",
}


def caches() -> Path:
    """Return the folder of all caches: the one that ``TURGOR_CACHE`` names, or that of the user."""
    stated = os.environ.get(FOLDER)
    return Path(stated) if stated else user_cache_path("turgor")


def cache_folder(part: str) -> Path | None:
    """Return the folder of one of `PARTS`, made where it is missing; None where it is not this user's alone."""
    folder = caches() / part
    return folder if private(folder) else None


def private(folder: Path) -> bool:
    """Make a folder, and return whether it belongs to this user and nobody else can write into it.

    A process trusts what it reads from a cache, and compiled kernels are code. So a folder of another user, or a link,
    is not used, and a folder of this user that others could write into is closed to them. Nor is one that others could
    replace by their own after it was checked, because they may rename what lies in a folder above it.

    Parameters
    ----------
    folder : Path

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> with TemporaryDirectory() as here:
    ...     private(Path(here) / "new"), private(Path(here) / "new" / "again")
    (True, True)
    """
    try:
        folder.parent.mkdir(parents=True, exist_ok=True)
        folder.mkdir(mode=0o700, exist_ok=True)
        about = folder.lstat()
        if not stat.S_ISDIR(about.st_mode):
            return False
        if hasattr(os, "getuid"):
            if about.st_uid != os.getuid():
                return False
            if about.st_mode & (stat.S_IWGRP | stat.S_IWOTH):
                folder.chmod(0o700)
            if any(map(_others_rename, {*folder.absolute().parents, *folder.resolve().parents})):
                return False
        return os.access(folder, os.W_OK | os.X_OK)
    except OSError:
        return False


def _others_rename(folder: Path) -> bool:
    """Whether others may rename what lies in a folder: they may write there, and it is not sticky as ``/tmp`` is."""
    about = folder.stat()
    if about.st_mode & stat.S_ISVTX:
        return False
    return bool(about.st_mode & stat.S_IWOTH or (about.st_mode & stat.S_IWGRP and not _own_group(about.st_gid)))


def _own_group(number: int) -> bool:
    """Whether a group is that of this user alone, which is named like the user."""
    import grp  # not on Windows
    import pwd

    try:
        return grp.getgrgid(number).gr_name == pwd.getpwuid(os.getuid()).pw_name
    except KeyError:
        return False
