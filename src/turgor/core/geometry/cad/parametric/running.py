"""Running of a script that draws a part, in a child process: it may load another CAD kernel, and it may crash."""

import importlib
import runpy
import sys
import traceback
from collections.abc import Mapping
from pathlib import Path
from shutil import copyfile
from typing import Any

from turgor.core.geometry.cad.parametric.parameter import Stated
from turgor.core.geometry.child_process import Work
from turgor.foundation.errors import TurgorError

#: Seconds after which a script is stopped: drawings take seconds, but the first import of a CAD kernel on a shared disk
#: may take minutes.
LONGEST_RUN = 600.0

#: Endings of files that a function may return.
ENDINGS = (".step", ".stp", ".brep", ".brp", ".stl")

_ALLOWED = (
    "return a part of build123d, a Workplane or Assembly of CadQuery, a shape of netgen.occ or OCP, or the path of a "
    "STEP, BREP or STL file."
)


def drawing(script: Path, shown: str) -> Work:
    """Return the run of a script in words, for the child process that does it."""
    return Work(
        who=f"'{script.name}' with {shown}",
        doing="drawing the part",
        advice="Run the function by itself with these dimensions to see why.",
        limit=LONGEST_RUN,
    )


def draw(script: Path, function: str, arguments: Mapping[str, Stated], folder: Path) -> tuple[Path, bool]:
    """Call a function of a script, and write the part that it returns.

    Parameters
    ----------
    script : Path
    function : str
    arguments : mapping of str to float, int, str or bool
    folder : Path
        Where the file goes.

    Returns
    -------
    (Path, bool)
        STEP, unless the function returns the path of another CAD file; and whether the script has read a file of its
        folder that is no module, so that its text does not say what it draws.

    Raises
    ------
    TurgorError
        If the script or the function raises an error, with its line, or returns no part.
    """
    sys.path.insert(0, str(script.parent))
    sys.argv = [str(script)]
    data: set[Path] = set()
    sys.addaudithook(lambda event, given: _note(event, given, script.parent, data))
    try:
        part = runpy.run_path(str(script), run_name=script.stem)[function](**arguments)
    except BaseException as error:  # a script may call sys.exit
        raise TurgorError(_line_of(error, script)) from None
    try:
        return _written(part, script, function, folder), any(each.is_file() for each in data)
    except TurgorError:
        raise
    except Exception as error:
        what = f"{type(error).__name__}: {error}".rstrip(":. ")
        raise TurgorError(f"{function} returned a part that cannot be written as STEP ({what}).") from None


def _note(event: str, given: tuple[Any, ...], folder: Path, data: set[Path]) -> None:
    """Note a file of a folder that is read and is no module."""
    if event == "open" and isinstance(given[0], str) and "r" in str(given[1] or "r"):
        path = Path(given[0]).absolute()
        if folder in path.parents and path.suffix not in (".py", ".pyc"):
            data.add(path)


def _line_of(error: BaseException, script: Path) -> str:
    """Write an error of a script with the line of the script in which it arose."""
    frames = [each for each in traceback.extract_tb(error.__traceback__) if Path(each.filename) == script]
    where = f"line {frames[-1].lineno}, in {frames[-1].name}: " if frames else ""
    what = f"{type(error).__name__}: {error}".rstrip(":. ")
    if isinstance(error, ModuleNotFoundError):
        package = str(error.name).partition(".")[0]
        return f"{where}{what}. Install '{package}' into the environment of turgor: {sys.executable}."
    return f"{where}{what}."


def _written(part: Any, script: Path, function: str, folder: Path) -> Path:
    if part is None:
        raise TurgorError(f"{function} returned nothing; {_ALLOWED}")
    if isinstance(part, str | Path):
        return _copied(script.parent / part, function, folder)
    target, library = folder / "part.step", type(part).__module__.split(".")[0]
    part = getattr(part, "part", part) if library == "build123d" else part  # what `with BuildPart()` has made
    if library in ("build123d", "list", "builtins") and isinstance(part, list | tuple) and part:
        library = type(part[0]).__module__.split(".")[0]
        part = importlib.import_module(library).Compound(children=list(part)) if library == "build123d" else None
    if library == "build123d" and hasattr(part, "wrapped"):
        importlib.import_module("build123d").export_step(part, str(target))
    elif library == "cadquery" and hasattr(part, "export"):
        part.export(str(target))
    elif library == "netgen" and hasattr(part, "WriteStep"):
        part.WriteStep(str(target))
    elif library == "OCP":
        _write_shape(part, target)
    else:
        raise TurgorError(f"{function} returned {type(part).__name__}, which is no part; {_ALLOWED}")
    return target


def _copied(file: Path, function: str, folder: Path) -> Path:
    if file.suffix.lower() not in ENDINGS:
        raise TurgorError(f"{function} returned '{file}'; allowed are files that end in {', '.join(ENDINGS)}.")
    if not file.is_file():
        raise TurgorError(f"{function} returned '{file}', and there is no such file.")
    return Path(copyfile(file, folder / f"part{file.suffix.lower()}"))


def _write_shape(shape: Any, target: Path) -> None:
    """Write a plain shape of OCP, the CAD kernel of build123d and CadQuery."""
    step = importlib.import_module("OCP.STEPControl")
    writer = step.STEPControl_Writer()
    writer.Transfer(shape, step.STEPControl_StepModelType.STEPControl_AsIs)
    writer.Write(str(target))
