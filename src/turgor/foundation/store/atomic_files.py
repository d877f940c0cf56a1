"""Files that appear whole or not at all."""

import errno
import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

if sys.platform != "win32":
    import fcntl

#: Ending of what is written next to a file before it takes its place.
PART = ".turgor-part"


@contextmanager
def whole(file: Path) -> Iterator[Path]:
    """Give a path in the same folder to write to, which replaces the file at the end.

    Parameters
    ----------
    file : Path

    Yields
    ------
    Path

    Raises
    ------
    OSError
        If it cannot be written, with the name of the file; what stood there before stays.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> with TemporaryDirectory() as folder:
    ...     with whole(Path(folder) / "a.txt") as part:
    ...         _ = part.write_text("all of it")
    ...     [each.name for each in Path(folder).iterdir()]
    ['a.txt']
    """
    if file.exists() and not file.is_file():  # a device or a pipe
        yield file
        return
    part, lock = _part(file)
    try:
        if lock is None:
            part.unlink(missing_ok=True)  # others may have put a link there, in a folder that they can write
        yield part
        with part.open("rb+") as written:  # on disk before it has the name: a power failure leaves no empty file
            os.fsync(written.fileno())
        os.replace(part, file)
    except BaseException as error:
        with suppress(OSError):
            part.unlink(missing_ok=True)
        if isinstance(error, OSError):
            raise OSError(error.errno or errno.EIO, error.strerror or str(error), str(file)) from error
        raise
    finally:
        if lock is not None:
            os.close(lock)


def _part(file: Path) -> tuple[Path, int | None]:
    """Return the path to write to, and the descriptor whose lock makes it this writer's.

    All processes have one name for it, so that the next one writes over what a killed one left. While another writer
    has it, and where the system has no such locks, the name has the number of the process.
    """
    part, own = file.with_name(f"{file.name}{PART}"), file.with_name(f"{file.name}.{os.getpid()}{PART}")
    if sys.platform == "win32":
        return own, None
    try:
        lock = os.open(part, os.O_RDWR | os.O_CREAT | os.O_NOFOLLOW, 0o666)
    except OSError:  # the caller opens a file there and says why it cannot
        return own, None
    try:
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        if os.path.samestat(os.fstat(lock), os.stat(part)):  # else another writer has given it its place meanwhile
            return part, lock
    except OSError:
        pass
    os.close(lock)
    return own, None


def write_whole(file: Path, text: str) -> None:
    """Write a text as UTF-8; the file appears whole or not at all, and a link in its place is replaced, not followed.

    Raises
    ------
    OSError
        If it cannot be written, with the name of the file; what stood there before stays.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> with TemporaryDirectory() as folder:
    ...     write_whole(Path(folder) / "a.txt", "all of it")
    ...     (Path(folder) / "a.txt").read_text()
    'all of it'
    """
    with whole(file) as part:
        part.write_text(text, encoding="utf-8")
