"""Folder of results, created before the computation, so that no run fails when it writes its results."""

from collections.abc import Collection, Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path
from tempfile import TemporaryFile

from filelock import FileLock, Timeout

from turgor.core.solvers.checkpoints.record import INDEX, SOLUTION
from turgor.core.solvers.load import PATH_FOLDER
from turgor.foundation.errors import TurgorError
from turgor.foundation.store.atomic_files import PART
from turgor.job.output.manifest import MANIFEST, listed, own_files, refuse_foreign, remove

RESPONSE = "response.csv"
STEPS = "steps.csv"
LOG = "run.log"
LOCK = "job.lock.toml"
REPORT = "report.html"
PLOT = "response.png"
UNDEFORMED = "undeformed.png"
DEFORMED = "deformed.png"
CONTACT = "contact.png"
BONDS = "bonds.png"
FIELDS = "vtu"
#: Folder of what was compared with a run; a new run leaves it.
COMPARISONS = "comparisons"

#: Locked while a run writes into the folder; the system unlocks it when the run ends, however it ends.
IN_USE = ".in-use"

#: Names of the files of a run besides its path.
RESULTS = (
    RESPONSE, STEPS, LOG, LOCK, REPORT, PLOT, UNDEFORMED, DEFORMED, CONTACT, BONDS,
    f"{FIELDS}/*.vtu", f"{FIELDS}/*.pvd",
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
def claimed(folder: Path, force: bool, resume: bool = False, files: Sequence[str] = RESULTS) -> Iterator[Path]:
    """Create a folder, lock it and check that it can be written; remove it if it is empty after an error in the block.

    Nothing that turgor did not write is replaced, with ``force`` neither.

    Parameters
    ----------
    folder : Path
        The folder; its parents are created too.
    force : bool
        Whether the results of an earlier run in it are removed.
    resume : bool
        Whether an earlier run in it continues.
    files : sequence of str
        Names and patterns of what will be written.

    Raises
    ------
    TurgorError
        If it is a file, another run writes into it, it is not empty (unless ``force``, or ``resume`` where it holds a
        run), it holds one of the files that turgor did not write, or it cannot be written.
    """
    if folder.exists() and not folder.is_dir():
        raise TurgorError(f"the output folder '{folder}' is a file; name another.")
    new = not folder.exists()
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with TemporaryFile(dir=folder):
            pass
    except OSError as error:
        raise TurgorError(f"the output folder '{folder}' cannot be written: {error.strerror}.") from error
    try:
        with _locked(folder / IN_USE):
            _check_empty(folder, force, resume)
            refuse_foreign(folder, (*files, f"{PATH_FOLDER}/{INDEX}"))
            yield folder
    except Timeout:
        raise TurgorError(
            f"another run is writing into the output folder '{folder}'; wait for it, or name another."
        ) from None
    finally:
        if new and not any(folder.iterdir()):
            folder.rmdir()


@contextmanager
def _locked(file: Path) -> Iterator[None]:
    """Lock a file, and remove it at the end."""
    with FileLock(file, timeout=0):
        if not file.exists():  # the run that had locked it removed it in this moment
            raise Timeout(str(file))
        try:
            yield
        finally:
            with suppress(OSError):  # Windows does not remove a file that is open
                file.unlink()


def _check_empty(folder: Path, force: bool, resume: bool) -> None:
    """Refuse a folder that holds files, unless these may be replaced or are those of the run to continue."""
    if force or all(each.name in {IN_USE, f"{MANIFEST}{PART}"} for each in folder.iterdir()):
        return
    if resume and not listed(folder):
        raise TurgorError(
            f"the output folder '{folder}' holds files, and none of a run that could continue.",
            python="Name another one.",
            command="Name another with --output OTHER.",
        )
    if resume:
        return
    unfinished = _unfinished(folder)
    raise TurgorError(
        f"the output folder '{folder}' exists and is not empty.",
        python=f"{'Go on with the unfinished run in it (resume=True), name' if unfinished else 'Name'} another folder, "
        "or replace the results in it (force=True).",
        command=f"{'Go on with the unfinished run in it with --resume, name' if unfinished else 'Name'} another with "
        "--output OTHER, or replace the results in it with --force.",
    )


def _unfinished(folder: Path) -> bool:
    """Whether a folder holds a run that has not ended."""
    path = folder / PATH_FOLDER
    return (path / INDEX).exists() and not (path / f"{SOLUTION}.turgor").exists()


def clear_drawn(folder: Path, current: Collection[str] = ()) -> None:
    """Remove what turgor drew of a run: pictures, plot, report and fields, but for what of `RESULTS` is current."""
    patterns = [each for each in RESULTS if each not in (RESPONSE, STEPS, LOG, LOCK, *current)]
    drawn = {file for pattern in patterns for file in folder.glob(pattern)}
    remove(folder, [file for file in own_files(folder) if file in drawn])
