"""Parts with dimensions as CAD files: a script is run, and a row of a table is chosen."""

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from hashlib import sha256
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from sys import version as python
from tempfile import TemporaryDirectory

import numpy as np

from turgor.core.geometry.cad.parametric.file_table import read_file_table
from turgor.core.geometry.cad.parametric.parameter import Parameter, Stated, arguments, shown_dimensions
from turgor.core.geometry.cad.parametric.running import draw, drawing
from turgor.core.geometry.cad.parametric.script import BUILD, digest_of, parameters_of, sources_of
from turgor.core.geometry.child_process import in_child
from turgor.foundation.errors import TurgorError
from turgor.foundation.store.cached_values import Cache

#: Endings of files that describe a part by dimensions, with what they are.
PARAMETRIC = {".py": "a script", ".csv": "a table of CAD files"}

#: Parts that scripts drew: some hundred STEP files.
PARTS = Cache("parts", 100e6)

#: Libraries that scripts draw with; another version of one may draw another part.
_LIBRARIES = ("build123d", "cadquery", "cadquery-ocp", "netgen-mesher")


def is_parametric(file: Path) -> bool:
    """Whether a file describes a part by dimensions, by its ending.

    Examples
    --------
    >>> is_parametric(Path("finger.py")), is_parametric(Path("finger.step"))
    (True, False)
    """
    return file.suffix.lower() in PARAMETRIC


def checksum(file: Path) -> str:
    """Return a hash of all that a part follows from besides its dimensions: a CAD file, a script, or a table."""
    match file.suffix.lower():
        case ".py":
            return digest_of(file)
        case ".csv":
            return read_file_table(file).digest
    return sha256(file.read_bytes()).hexdigest()


def files_of(file: Path) -> set[Path]:
    """Return a file with those that belong to it: modules that a script imports, or the CAD files of a table."""
    match file.suffix.lower():
        case ".py":
            return sources_of(file)
        case ".csv":
            return {file, *(part for _, part in read_file_table(file).rows)}
    return {file}


def dimensions_of(file: Path, function: str = BUILD) -> tuple[Parameter, ...]:
    """Return the dimensions that a script or a table takes; none for a CAD file."""
    match file.suffix.lower():
        case ".py":
            return parameters_of(file, function)
        case ".csv":
            return read_file_table(file).parameters
    return ()


def check_dimensions(
    file: Path, function: str, stated: Mapping[str, Stated], unit: str | float | None = None
) -> dict[str, Stated]:
    """Return the arguments that dimensions are for a script or a table; parameters as those of `part_file`.

    Raises
    ------
    TurgorError
        If a dimension is unknown, missing or not allowed, or a CAD file has any.
    """
    if not is_parametric(file):
        if stated:
            raise TurgorError(
                f"dimensions are {', '.join(stated)}, but '{file.name}' is a drawn part, and no CAD file carries "
                "dimensions; name a script (.py) that draws it, or a table (.csv) of files with their dimensions."
            )
        return {}
    owner = f"'{file.name}'" if file.suffix.lower() == ".csv" else f"the function {function} of '{file.name}'"
    return arguments(dimensions_of(file, function), stated, unit, owner)


@contextmanager
def part_file(
    file: Path, function: str = BUILD, stated: Mapping[str, Stated] | None = None, unit: str | float | None = None
) -> Iterator[Path]:
    """Give the CAD file of a part: the file itself, that of a row of a table, or the one that a script draws.

    Parameters
    ----------
    file : Path
        CAD file, script or table.
    function : str
        Function of a script.
    stated : mapping of str to float, int, str or bool, optional
        Dimensions, as a job states them.
    unit : str or float, optional
        Unit of the lengths that a script takes; millimeters by default.

    Yields
    ------
    Path
        It is there as long as the context is.

    Raises
    ------
    TurgorError
        If the part cannot be drawn, with its dimensions.
    """
    stated = stated or {}
    given = check_dimensions(file, function, stated, unit)
    if file.suffix.lower() == ".csv":
        yield read_file_table(file).file(stated)
    elif not is_parametric(file):
        yield file
    else:
        with TemporaryDirectory(prefix="turgor-") as folder:
            yield _drawn(file.resolve(), function, given, shown_dimensions(stated), Path(folder))


def _drawn(script: Path, function: str, given: Mapping[str, Stated], shown: str, folder: Path) -> Path:
    """Write the part of a script into a folder, as it was when it was first drawn with these dimensions."""
    key = digest_of(script), function, sorted(given.items()), python, [_version(each) for each in _LIBRARIES]
    saved = PARTS.get(*key)
    if isinstance(saved, list):
        ending, content = saved
        path = folder / f"{script.stem}{ending}"
        path.write_bytes(content.tobytes())
        return path
    try:
        drawn, others = in_child(drawing(script, shown), draw, script, function, dict(given), folder)
    except TurgorError as error:
        raise TurgorError(_placed(str(error), script, shown)) from None
    path = drawn.rename(folder / f"{script.stem}{drawn.suffix}")
    if not others:
        PARTS.put([path.suffix, np.frombuffer(path.read_bytes(), dtype=np.uint8)], *key)
    return path


def _placed(sentence: str, script: Path, shown: str) -> str:
    """An error of a script with the names of the script and the dimensions, where it has them not yet."""
    if shown in sentence:
        return sentence
    comma = ", " if sentence.startswith("line ") else ": "
    return f"'{script.name}'{comma}{sentence} The dimensions were {shown}."


def _version(library: str) -> str:
    try:
        return version(library)
    except PackageNotFoundError:
        return ""
