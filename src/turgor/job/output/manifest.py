"""Manifest: the files that turgor wrote into a folder of results. Only these are replaced or removed."""

import json
import os
import re
from collections.abc import Iterable, Iterator
from contextlib import suppress
from pathlib import Path, PurePosixPath
from typing import Any

from turgor.core.solvers.checkpoints.record import INDEX, SOLUTION
from turgor.core.solvers.load import PATH_FOLDER
from turgor.foundation.errors import TurgorError
from turgor.foundation.store.atomic_files import PART, write_whole
from turgor.foundation.store.saved_objects import ENDING

#: The list, in the folder.
MANIFEST = ".turgor-files.json"

#: Folder in which the results of an earlier run wait until those of the new one exist.
PREVIOUS = "previous"

#: Its name while files are moved there.
MOVING = ".previous"

#: Files of a path: the index and the archives, also parts of them that a killed process left.
_OF_A_PATH = re.compile(
    rf"({re.escape(INDEX)}|(question|solution|(model|state|path|loop)(-\d+)+)\.turgor)((\.\d+)?{re.escape(PART)})?"
)


def listed(folder: Path) -> frozenset[str]:
    """Return the names of the files that turgor wrote, relative to a folder; none where it holds no manifest."""
    names = _content(folder).get("files")
    return frozenset(name for name in names if _inside(name)) if isinstance(names, list) else frozenset()


def _inside(name: object) -> bool:
    """Whether a name of a manifest stays in its folder; a manifest is a file that others may have changed."""
    path = PurePosixPath(str(name))
    return isinstance(name, str) and not path.is_absolute() and ".." not in path.parts and "\\" not in name


def list_files(folder: Path, names: Iterable[str]) -> None:
    """Add files to the manifest of a folder, before they are written.

    Parameters
    ----------
    folder : Path
    names : iterable of str
        Relative to the folder.

    Raises
    ------
    TurgorError
        If one exists that turgor did not write.
    """
    known, added = listed(folder), list(names)
    refuse_foreign(folder, added)
    if not known.issuperset(added):
        _write(folder, {"files": sorted(known.union(added))})


def note_job(folder: Path, digest: str) -> None:
    """Note in the manifest which job the run in a folder is of, so that a damaged lock file does not stop it."""
    _write(folder, {"job": digest})


def job_digest(folder: Path) -> str:
    """Return what `note_job` noted; nothing where there is nothing."""
    return str(_content(folder).get("job", ""))


def _content(folder: Path) -> dict[str, Any]:
    try:
        content = json.loads((folder / MANIFEST).read_text("utf-8"))
    except (OSError, ValueError, RecursionError):
        return {}
    return content if isinstance(content, dict) else {}


def _write(folder: Path, more: dict[str, Any]) -> None:
    write_whole(folder / MANIFEST, json.dumps(_content(folder) | more, indent=1) + "\n")


def refuse_foreign(folder: Path, patterns: Iterable[str]) -> None:
    """Raise an error if a file with one of some names or patterns exists that turgor did not write.

    Raises
    ------
    TurgorError
        That names the file; also where a folder of results is a link, behind which the files of others may lie.
    """
    known = listed(folder)
    for pattern in patterns:
        parent = folder / PurePosixPath(pattern).parent
        if parent != folder and parent.is_symlink():
            raise TurgorError(
                f"'{parent}' is a link to '{os.readlink(parent)}'; remove the link, or name another folder."
            )
        for file in sorted(folder.glob(pattern)):
            if not file.is_dir() and file.relative_to(folder).as_posix() not in known and not _of_a_run(file, known):
                raise TurgorError(
                    f"'{file}' would be replaced, and no run of turgor wrote it ('{MANIFEST}' lists what runs wrote).",
                    python="Move it, or name another folder as output.",
                    command="Move it, or name another folder with --output OTHER.",
                )


def _of_a_run(file: Path, known: frozenset[str]) -> bool:
    """Whether a file is the index of the path that the manifest names."""
    return file.name == INDEX and file.parent.name in known


def own_files(folder: Path) -> list[Path]:
    """Return the files of a folder that turgor wrote, also in part: those of the manifest, then those of the paths."""
    names = listed(folder)
    own = [f"{name}{ending}" for name in sorted(names) for ending in ("", PART)]
    files = [folder / name for name in own if not _behind_a_link(folder, name)]
    files_there = [file for file in files if file.is_symlink() or file.is_file()]
    return [*files_there, *_of_path(folder / PATH_FOLDER)] if PATH_FOLDER in names else files_there


def _of_path(folder: Path) -> Iterator[Path]:
    """Files of a path."""
    if folder.is_symlink() or not folder.is_dir():
        return
    yield from (file for file in folder.iterdir() if _OF_A_PATH.fullmatch(file.name))


def _behind_a_link(folder: Path, name: str) -> bool:
    return any((folder / parent).is_symlink() for parent in list(PurePosixPath(name).parents)[:-1])


def remove(folder: Path, files: Iterable[Path]) -> None:
    """Remove files of a folder, and the folders in it that are empty then."""
    for file in files:
        file.unlink(missing_ok=True)
    remove_empty(folder)


def remove_empty(folder: Path) -> None:
    """Remove the folders of a path, of fields and of an earlier run that hold nothing any more."""
    for name in (PATH_FOLDER, "vtu"):
        if not (folder / name).is_symlink():
            with suppress(OSError):
                (folder / name).rmdir()


def set_aside(folder: Path) -> None:
    """Move the results of an earlier run into a folder of their own, where they stay until `drop_previous`.

    A run that had not ended is removed if complete results of an earlier one wait there already. A process that is
    killed here leaves a part of the files in `MOVING`, from where the next call continues.
    """
    previous, moving = folder / PREVIOUS, folder / MOVING
    files = own_files(folder)
    if not files and not moving.exists():
        return
    if (folder / PATH_FOLDER / f"{SOLUTION}{ENDING}").exists():
        drop_previous(folder)
    if (previous / MANIFEST).exists():
        remove(folder, [*files, folder / MANIFEST])
        return
    if previous.exists():
        raise TurgorError(
            f"'{previous}' is where the results of the earlier run would wait; rename it, or name another folder."
        )
    moving.mkdir(exist_ok=True)
    if not (moving / MANIFEST).exists():
        write_whole(moving / MANIFEST, (folder / MANIFEST).read_text("utf-8"))
    _move(files, folder, moving)
    os.replace(moving, previous)
    (folder / MANIFEST).unlink(missing_ok=True)
    remove_empty(folder)


def _move(files: Iterable[Path], source: Path, target: Path) -> None:
    for file in files:
        place = target / file.relative_to(source)
        place.parent.mkdir(parents=True, exist_ok=True)
        os.replace(file, place)


def drop_previous(folder: Path) -> None:
    """Remove the results of an earlier run that `set_aside` has moved; what others put there stays."""
    previous = folder / PREVIOUS
    if previous.is_symlink() or not (previous / MANIFEST).exists():
        return
    remove(previous, [*own_files(previous), previous / MANIFEST])
    with suppress(OSError):
        previous.rmdir()


def bring_back(folder: Path) -> None:
    """Move the results of an earlier run back, after the run that should replace them has failed at its beginning.

    A process that is killed here leaves what one leaves that is killed in `set_aside`: the next call of that continues.
    """
    previous, moving = folder / PREVIOUS, folder / MOVING
    if previous.is_symlink() or not (previous / MANIFEST).exists():
        return
    remove(folder, [*own_files(folder), folder / MANIFEST])
    os.replace(previous, moving)
    write_whole(folder / MANIFEST, (moving / MANIFEST).read_text("utf-8"))
    _move(own_files(moving), moving, folder)
    (moving / MANIFEST).unlink()
    remove_empty(moving)
    try:
        moving.rmdir()
    except OSError:  # what others put there stays
        os.replace(moving, previous)
