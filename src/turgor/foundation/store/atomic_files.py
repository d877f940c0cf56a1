"""Files that appear whole or not at all."""

import errno
import os
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path


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
    part = file.with_name(f"{file.name}.{os.getpid()}.part")
    try:
        yield part
        with part.open("rb+") as written:  # on disk before it has the name: a power failure leaves no empty file
            os.fsync(written.fileno())
        os.replace(part, file)
    except OSError as error:
        raise OSError(error.errno or errno.EIO, error.strerror or str(error), str(file)) from error
    finally:
        with suppress(OSError):
            part.unlink(missing_ok=True)


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
