"""Cached values: what is slow to make, saved on disk under a name that follows from all that it depends on.

An entry is never outdated, because its name is a hash of its key. A damaged entry is removed and made again. What
cannot be read or written costs time, and no result depends on it. The page docs/startup.md lists the caches.
"""

import json
import os
import warnings
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass
from functools import cache
from hashlib import sha256
from importlib.util import find_spec
from pathlib import Path

from turgor.foundation.errors import TurgorError
from turgor.foundation.store.archive import Content, read_archive, write_archive
from turgor.foundation.store.caches import cache_folder
from turgor.foundation.store.codec import Decoder, Encoder
from turgor.foundation.store.saved_objects import ENDING

#: An entry may take this share of a cache, so that one large entry does not push out all others.
LARGEST_SHARE = 0.25

#: What reading a damaged entry raises.
_DAMAGE = (
    TurgorError, OSError, LookupError, TypeError, ValueError, AttributeError, ArithmeticError, MemoryError,
    RuntimeError,
)  # fmt: skip


@dataclass(frozen=True, slots=True)
class Cache:
    """Entries of one kind in a folder of this user.

    Parameters
    ----------
    part : str
        Name of the folder, one of `turgor.foundation.store.caches.PARTS`.
    most_bytes : float
        Size of all entries together; the entries that were not used for longest are removed first. With 0, nothing is
        saved or found.
    """

    part: str
    most_bytes: float

    def file(self, *key: object) -> Path | None:
        """Return the file of a key, which is plain values, arrays and dataclasses; None where nothing is cached."""
        folder = cache_folder(self.part) if self.most_bytes else None
        return None if folder is None else folder / f"{_digest(key)}{ENDING}"

    def has(self, *key: object) -> bool:
        """Return whether there is an entry for a key."""
        file = self.file(*key)
        return file is not None and file.exists()

    def get(self, *key: object) -> object:
        """Return the value that was saved for a key; None where there is none, or where it is damaged."""
        file = self.file(*key)
        if file is None or not file.exists():
            return None
        try:
            content = read_archive(file)
            value = _checked(Decoder(content.arrays, _nothing_elsewhere).decode(content.tree))
        except _DAMAGE as error:
            warnings.warn(
                f"a damaged entry in the cache of {self.part} was removed ({type(error).__name__}) and is made again.",
                stacklevel=2,
            )
            with suppress(OSError):
                file.unlink()
            return None
        with suppress(OSError):
            os.utime(file)
        return value

    def put(self, value: object, *key: object) -> None:
        """Save a value for a key, in place of an older one."""
        file, encoder = self.file(*key), Encoder()
        if file is None:
            return
        with suppress(OSError, TurgorError):
            content = Content("cached", encoder.encode([_digest((value,)), value]), encoder.arrays)
            if sum(array.nbytes for array in encoder.arrays.values()) > LARGEST_SHARE * self.most_bytes:
                return
            write_archive(file, content)
            self._remove_oldest(file.parent)

    def _remove_oldest(self, folder: Path) -> None:
        """Remove what was not used for longest, until the rest is small enough."""
        entries = []
        for each in folder.iterdir():
            with suppress(OSError):  # another process has removed it
                about = each.stat()
                entries.append((about.st_mtime_ns, about.st_size, each))
        total = sum(size for _, size, _ in entries)
        for _, size, each in sorted(entries):
            if total <= self.most_bytes:
                return
            each.unlink(missing_ok=True)
            total -= size


@cache
def sources(package: str) -> str:
    """Return a hash of the names, sizes and times of the files of a package, part of the key of what these make.

    The files count as they were when this process first called the function: it has loaded them by then.

    Parameters
    ----------
    package : str
        Dotted name; without files, as in a frozen program, the hash is that of nothing.

    Returns
    -------
    str
    """
    spec = find_spec(package)
    folders = [Path(each) for each in (spec.submodule_search_locations or ())] if spec else []
    files = sorted(file for folder in folders for file in folder.rglob("*.py"))
    listed = [(str(file), about.st_size, about.st_mtime_ns) for file in files for about in (file.stat(),)]
    return sha256(str(listed).encode()).hexdigest()


def _checked(entry: object) -> object:
    """Return the value of an entry if its hash is right: a damaged number would change a result unnoticed."""
    stated, value = entry if isinstance(entry, list) and len(entry) == 2 else ("", None)
    if stated != _digest((value,)):
        raise ValueError("the entry is not as it was written.")
    return value


def _digest(key: tuple[object, ...]) -> str:
    """Hash of a key or of a value: of its text, and of the bytes of its arrays."""
    encoder = Encoder()
    digest = sha256(json.dumps(encoder.encode(list(key))).encode())
    for name, array in encoder.arrays.items():
        digest.update(f"{name} {array.dtype.str} {array.shape} ".encode())
        digest.update(array.tobytes())
    return digest.hexdigest()[:32]


def without_order(values: Mapping[str, object]) -> list[tuple[str, object]]:
    """Return a mapping as a list that does not depend on the order of its items, for a key.

    Examples
    --------
    >>> without_order({"b": 1, "a": 2})
    [('a', 2), ('b', 1)]
    """
    return sorted(values.items())


def _nothing_elsewhere(name: str) -> object:
    raise TurgorError(f"an entry refers to '{name}' elsewhere.")
