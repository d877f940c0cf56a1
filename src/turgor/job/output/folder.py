"""Folder of results, created before the computation, so that no run fails when it writes its results."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryFile

from turgor.errors import TurgorError

RESPONSE = "response.csv"
STEPS = "steps.csv"
LOG = "run.log"
LOCK = "job.lock.toml"
REPORT = "report.html"
PLOT = "response.png"
UNDEFORMED = "undeformed.png"
DEFORMED = "deformed.png"
CONTACT = "contact.png"
FIELDS = "vtu"

#: Names of the files of a run; `clear` removes these and nothing else.
RESULTS = (
    RESPONSE, STEPS, LOG, LOCK, REPORT, PLOT, UNDEFORMED, DEFORMED, CONTACT, f"{FIELDS}/*.vtu", f"{FIELDS}/*.pvd",
)  # fmt: skip


def default_folder(name: str) -> Path:
    """Return the default folder of a run: ``<name>-results`` in the working directory.

    Examples
    --------
    >>> str(default_folder("fast_pneunet"))
    'fast_pneunet-results'
    """
    return Path(f"{name}-results")


@contextmanager
def claimed(folder: Path, force: bool) -> Iterator[Path]:
    """Create a folder and check that it can be written; remove it if it is empty after an error in the block.

    Parameters
    ----------
    folder : Path
        The folder; its parents are created too.
    force : bool
        Whether it may hold files already.

    Raises
    ------
    TurgorError
        If it is a file, is not empty (unless ``force``), or cannot be written.
    """
    if folder.exists() and not folder.is_dir():
        raise TurgorError(f"the output folder '{folder}' is a file; name another with --output OTHER.")
    if folder.is_dir() and any(folder.iterdir()) and not force:
        raise TurgorError(
            f"the output folder '{folder}' exists and is not empty; name another with --output OTHER, or replace the "
            "results in it with --force."
        )
    new = not folder.exists()
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with TemporaryFile(dir=folder):
            pass
    except OSError as error:
        raise TurgorError(f"the output folder '{folder}' cannot be written: {error.strerror}.") from error
    try:
        yield folder
    finally:
        if new and not any(folder.iterdir()):
            folder.rmdir()


def clear(folder: Path) -> None:
    """Remove the files of an earlier run, so that none of them stays beside the new ones."""
    for pattern in RESULTS:
        for file in folder.glob(pattern):
            file.unlink()
