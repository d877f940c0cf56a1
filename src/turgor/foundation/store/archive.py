"""Archive: one file of JSON and arrays, a zip archive that any program can open.

``content.json`` holds the format, its version, the version of turgor that wrote it, the kind of the content, and the
content itself; ``arrays/NAME.npy`` holds each array in NumPy's own format. docs/reference/saved-files.md describes it.
"""

import errno
import json
import math
from collections.abc import Mapping
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path
from typing import IO, Any
from zipfile import ZipFile

import numpy as np
from numpy.lib import format as npy
from numpy.typing import NDArray

from turgor.foundation.errors import TurgorError
from turgor.foundation.store.atomic_files import whole
from turgor.foundation.store.limits import check_unpacked

#: Version of the format; a reader refuses others.
FORMAT, VERSION = "turgor", 1


@dataclass(frozen=True, slots=True, eq=False)
class Content:
    """Content of an archive: the kind of its content, the content as JSON, and the arrays by their names."""

    kind: str
    tree: Any
    arrays: Mapping[str, NDArray[Any]]


def write_archive(file: Path | IO[bytes], content: Content) -> None:
    """Write an archive; a file appears whole or not at all.

    Parameters
    ----------
    file : Path or binary stream
    content : Content

    Raises
    ------
    OSError
        If it cannot be written, with the name of the file; what stood there before stays.
    """
    if not isinstance(file, Path):
        _write(file, content)
        return
    with whole(file) as part, part.open("wb") as stream:
        _write(stream, content)


def _write(stream: IO[bytes], content: Content) -> None:
    head = {"format": FORMAT, "version": VERSION, "written_by": f"turgor {version('turgor')}", "kind": content.kind}
    with ZipFile(stream, "w") as archive:
        archive.writestr("content.json", json.dumps(head | {"content": content.tree}, allow_nan=False))
        for name, array in content.arrays.items():
            with archive.open(f"arrays/{name}.npy", "w", force_zip64=True) as member:
                npy.write_array(member, np.asarray(array), allow_pickle=False)


def read_archive(file: Path | IO[bytes]) -> Content:
    """Read an archive.

    Raises
    ------
    TurgorError
        If there is no such file, it is damaged or no archive of turgor, or its format is of another version.
    """
    named = f"'{file}'" if isinstance(file, Path) else "the data"
    try:
        with ZipFile(file) as archive:
            parts = archive.infolist()
            check_unpacked(named, sum(each.compress_size for each in parts), sum(each.file_size for each in parts))
            head = json.loads(archive.read("content.json"))
            _check(head, named)
            arrays = {
                Path(name).stem: _array(archive, name) for name in archive.namelist() if name.startswith("arrays/")
            }
            return Content(head["kind"], head["content"], arrays)
    except FileNotFoundError:
        raise TurgorError(f"there is no file {named}.") from None
    except TurgorError:
        raise
    except OSError as error:
        if error.errno not in (errno.EINVAL, None):
            raise
        raise TurgorError(
            f"{named} is damaged: bytes are missing."
        ) from None  # a place before the beginning of the file
    except Exception as error:  # zip, zlib, JSON and NumPy fail in any way on damaged, encrypted or re-packed data
        raise TurgorError(f"{named} is damaged, or no file that turgor saved ({_short(error)}).") from None


def _short(error: Exception) -> str:
    """Return the text of an error, cut to a line; its class where it has none."""
    text = " ".join(str(error).split()) or type(error).__name__
    return text if len(text) < 120 else f"{text[:117]}..."


def _check(head: Any, named: str) -> None:
    if not isinstance(head, dict) or head.get("format") != FORMAT:
        raise TurgorError(f"{named} is no file that turgor saved.")
    if head.get("version") != VERSION:
        raise TurgorError(
            f"{named} was written by {head.get('written_by')} in version {head.get('version')} of the format; "
            f"this turgor {version('turgor')} reads version {VERSION}."
        )


def _array(archive: ZipFile, name: str) -> NDArray[Any]:
    """Read an array whose header states as many bytes as follow."""
    with archive.open(name) as member:
        form = npy.read_magic(member)
        shape, _, kind = npy.read_array_header_1_0(member) if form == (1, 0) else npy.read_array_header_2_0(member)
        size, there = math.prod(shape) * kind.itemsize, archive.getinfo(name).file_size - member.tell()
        if size != there:
            raise TurgorError(f"array '{name}' needs {size} bytes, and {there} are there.")
    with archive.open(name) as member:
        return np.asarray(npy.read_array(member, allow_pickle=False))
