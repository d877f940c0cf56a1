"""Job files as functions of their values: the keys that hold numbers, and a job solved with other numbers."""

import json
import tomllib
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from hashlib import sha256
from pathlib import Path
from shutil import rmtree
from socket import gethostname
from typing import Any

from turgor.adaptivity.measure import measure
from turgor.engine.runtime import EngineOptions
from turgor.errors import NotHere, TurgorError, unknown
from turgor.job.job import Job
from turgor.job.output.lock import lock_text
from turgor.job.prepare import prepare
from turgor.job.read import read_job
from turgor.response import Response
from turgor.solvers.solution import Solution, Status
from turgor.solvers.solve import resume, solve
from turgor.store.whole import whole
from turgor.study.rounding import rounded
from turgor.units import UNITS, parse_quantity, split_quantity

Value = float | int | str

#: Sections of a job whose numbers are no quantities of the actuator.
_LEFT_OUT = ("written_by", "output", "engine", "name")

#: Folder beside the job for paths that are being followed: each goes when its run has ended, the folder with the last.
PATHS = "paths"

#: How often the folder of a path is made: other runs may remove the one above it while it is empty.
ATTEMPTS = 10

#: Keys of a material that stay when it gets another record.
_OF_THE_JOB = ("density", "viscoelasticity", "stress_softening", "thickness", "form", "compression")


@dataclass(frozen=True, slots=True, kw_only=True)
class JobNumber:
    """A number in a job file.

    Parameters
    ----------
    key : str
        Dotted key, such as ``"materials.body.C10"``; the place in a list is its last part, from 1.
    value : float
        In SI units.
    unit : str
        Unit in which the file states it; empty for a pure number.
    whole : bool
        Whether it is a whole number, such as a number of chambers.
    """

    key: str
    value: float
    unit: str
    whole: bool = False

    @property
    def factor(self) -> float:
        """Value of the unit in SI."""
        return unit_value(self.unit)

    @property
    def dimension(self) -> str:
        """What the number measures, such as ``"length"``; ``"number"`` for a pure one."""
        return next((name for name, units in UNITS.items() if self.unit in units), "number")

    def text(self, value: float, exact: bool = False) -> float | int | str:
        """Return an SI value in the form of a job file; with all its digits if ``exact``."""
        if self.whole:
            if value != round(value):
                raise TurgorError(f"'{self.key}' is a whole number; {value:g} is none.")
            return round(value)
        number = value / self.factor if exact else rounded(value / self.factor)
        return f"{number!r} {self.unit}" if self.unit else number


def unit_value(unit: str) -> float:
    """Return the value of a unit in SI; 1 for a pure number.

    Parameters
    ----------
    unit : str

    Returns
    -------
    float

    Examples
    --------
    >>> unit_value("kPa"), unit_value("")
    (1000.0, 1.0)
    """
    return next((units[unit] for units in UNITS.values() if unit in units), 1.0)


def write_whole_job(job: Job, file: Path) -> dict[str, JobNumber]:
    """Write a job with every value, defaults and constants of library materials included, and return its numbers.

    Parameters
    ----------
    job : Job
    file : Path

    Returns
    -------
    dict of str to JobNumber
        By key.
    """
    text = lock_text(job, {})
    if not file.is_file() or file.read_text(encoding="utf-8") != text:
        file.parent.mkdir(parents=True, exist_ok=True)
        with whole(file) as part:  # tasks on several machines may write it at once
            part.write_text(text, encoding="utf-8")
    return numbers_of(tomllib.loads(text))


def numbers_of(content: Mapping[str, Any]) -> dict[str, JobNumber]:
    """Find the numbers in the content of a job file, with and without unit.

    Parameters
    ----------
    content : mapping

    Returns
    -------
    dict of str to JobNumber

    Examples
    --------
    >>> found = numbers_of({"materials": {"body": {"law": "ogden", "mu": ["1 kPa", "2 kPa"], "alpha": [2.0, 4.0]}}})
    >>> found["materials.body.mu.2"]
    JobNumber(key='materials.body.mu.2', value=2000.0, unit='kPa', whole=False)
    """
    found: dict[str, JobNumber] = {}
    for name in content:
        if name not in _LEFT_OUT:
            _gather(name, content[name], found)
    return found


def find_number(numbers: Mapping[str, JobNumber], key: str) -> JobNumber:
    """Return the number at a key.

    Parameters
    ----------
    numbers : mapping of str to JobNumber
    key : str

    Returns
    -------
    JobNumber

    Raises
    ------
    TurgorError
        If the job has no number there, with the near match, or a whole one, which cannot vary by little.
    """
    number = any_number(numbers, key)
    if number.whole:
        raise TurgorError(f"'{key}' is a whole number, {number.value:g}, which cannot vary by little.")
    return number


def any_number(numbers: Mapping[str, JobNumber], key: str) -> JobNumber:
    """Return the number at a key, which may be a whole one.

    Parameters
    ----------
    numbers : mapping of str to JobNumber
    key : str

    Returns
    -------
    JobNumber

    Raises
    ------
    TurgorError
        If the job has no number there, with the near match.
    """
    if key not in numbers:
        same = [each for each in numbers if each.split(".")[0] == key.split(".")[0]]
        raise unknown("number of the job", key, same or numbers)
    return numbers[key]


def read_number(text: str, number: JobNumber, where: str) -> float:
    """Read another value of a number, with its unit.

    Parameters
    ----------
    text : str
    number : JobNumber
    where : str
        Beginning of messages.

    Returns
    -------
    float
        In SI units.

    Raises
    ------
    TurgorError
        If the unit is missing or measures something else.
    """
    try:
        return parse_quantity(text.strip(), number.dimension) if number.unit else float(text)
    except TurgorError as error:
        raise TurgorError(f"{where}: {error}") from None
    except ValueError:
        raise TurgorError(f"{where}: '{text.strip()}' is not a number.") from None


def solved_job(
    job: str, digest: str, numbers: Mapping[str, Value], mesh_error: bool = False, measures: Sequence[str] = ()
) -> Response:
    """Solve a job with other numbers and measure it, with one thread; `Run` and others call it in other processes.

    A run that is killed in the middle goes on from its last accepted state when it is called again.

    Parameters
    ----------
    job : str
        A file of `write_whole_job`.
    digest : str
        `digest_of` the file, so that runs of another job are not taken for those of this one.
    numbers : mapping of str to float, int or str
        Values by key; numbers are in SI units, and several keys with commas between them have one value. The keys of a
        material, such as ``"materials.body"``, have a record of the library: ``"ecoflex-00-30/yeoh-steck-2019"``; other
        texts are choices, such as the kind of the cells.
    mesh_error : bool
        Whether the mesh error is estimated, which takes up to half the time of the solve.
    measures : sequence of str
        What is measured; by default what the job asks for.

    Returns
    -------
    Response
        As far as the path goes; its message says why it ended early.

    Raises
    ------
    TurgorError
        If the job cannot be read, meshed or held with these numbers.
    """
    asked, solution = solution_of_job(job, digest, numbers)
    response = measured_job(asked, solution, mesh_error=mesh_error, measures=measures)
    forget_path(job, digest, numbers)
    return response


def solution_of_job(job: str, digest: str, numbers: Mapping[str, Value]) -> tuple[Job, Solution]:
    """Solve a job with other numbers, with one thread; the path as far as it goes.

    The path is kept beside the job until `forget_path`, so that a run that is killed goes on from its last state.

    Parameters
    ----------
    job, digest, numbers
        As those of `solved_job`.

    Returns
    -------
    (Job, Solution)
        The job with these numbers.
    """
    if not Path(job).is_file():
        raise NotHere(
            f"the job of the study, '{job}', is not seen on the machine '{gethostname()}'; "
            "studies of jobs need a folder that all machines share."
        )
    content = tomllib.loads(Path(job).read_text(encoding="utf-8"))
    asked = read_job(job, job_changes(content, numbers))
    solution = _followed(asked, EngineOptions(threads=1), _path_of(job, digest, numbers))
    if solution.status is Status.INTERRUPTED:
        raise KeyboardInterrupt  # Ctrl-C ends the study; the run has not ended, and goes on when it is called again
    return asked, solution


def forget_path(job: str, digest: str, numbers: Mapping[str, Value]) -> None:
    """Remove the states that `solution_of_job` has kept on its way, once what they are for is kept.

    Parameters
    ----------
    job, digest, numbers
        As those of `solved_job`.
    """
    folder = _path_of(job, digest, numbers)
    rmtree(folder, ignore_errors=True)
    with suppress(OSError):  # the paths of other runs are there
        folder.parent.rmdir()


def _path_of(job: str, digest: str, numbers: Mapping[str, Value]) -> Path:
    return Path(job).parent / PATHS / path_name(digest, numbers)


def measured_job(asked: Job, solution: Solution, *, mesh_error: bool = False, measures: Sequence[str] = ()) -> Response:
    """Measure what `solution_of_job` gave; the message says why the path ended early.

    Parameters
    ----------
    asked : Job
    solution : Solution
    mesh_error, measures
        As those of `solved_job`.

    Returns
    -------
    Response
    """
    options = EngineOptions(threads=1)
    estimated = mesh_error and len(solution.states) > 1
    response = measure(solution, *(measures or asked.output.chosen()), mesh_error=estimated, options=options)
    message = "" if solution.complete else f"{solution.message} {solution.advice}".strip()
    return replace(response, message=message)


def _followed(job: Job, options: EngineOptions, folder: Path) -> Solution:
    """Follow the path of a job, or go on with it where it was killed: every accepted state is in the folder at once."""
    if folder.exists():
        try:
            return resume(folder, options=options, throw=False)
        except TurgorError:  # killed as the folder was begun
            rmtree(folder)
    model, _ = prepare(job)
    _make(folder)
    return solve(model, job.procedure, options=options, folder=folder, throw=False)


def _make(folder: Path) -> None:
    """Make the folder of a path, again if a run that ended has removed the empty one above it in between."""
    for _ in range(ATTEMPTS):
        with suppress(FileNotFoundError):
            folder.mkdir(parents=True, exist_ok=True)
            return


def path_name(digest: str, numbers: Mapping[str, Value]) -> str:
    """Return the name of the folder of a path that is being followed: a hash of the job and its values."""
    return sha256(json.dumps([digest, dict(numbers)], sort_keys=True).encode()).hexdigest()[:16]


def digest_of(file: Path) -> str:
    """Return a hash of what a file holds.

    Parameters
    ----------
    file : Path

    Returns
    -------
    str
    """
    return sha256(file.read_bytes()).hexdigest()[:16]


def job_changes(content: Mapping[str, Any], values: Mapping[str, Value]) -> dict[str, Any]:
    """Return changes for `read_job` from numbers, records of materials and other choices.

    Parameters
    ----------
    content : mapping
        Of the job file.
    values : mapping of str to float, int or str
        By key, or by several keys with commas between them; numbers in SI units.

    Returns
    -------
    dict

    Raises
    ------
    TurgorError
        If the job has no number there, or a whole number gets another one.

    Examples
    --------
    >>> job = {"actuator": {"chambers": 4, "wall": "1 mm"}, "mesh": {"cells": "tetrahedra"}}
    >>> job_changes(job, {"actuator.chambers": 6, "mesh.cells": "hexahedra"})
    {'actuator.chambers': 6, 'mesh.cells': 'hexahedra'}
    """
    numbers = {keys: float(value) for keys, value in values.items() if not isinstance(value, str)}
    texts = {key: value for keys, value in values.items() if isinstance(value, str) for key in keys.split(",")}
    records = {key: value for key, value in texts.items() if is_material(content, key)}
    choices = {key: value for key, value in texts.items() if key not in records}
    return changes_of(content, numbers) | record_changes(content, records) | choices


def is_material(content: Mapping[str, Any], key: str) -> bool:
    """Whether a key of a job is that of a material, which has records as its values."""
    first, _, name = key.partition(".")
    return first == "materials" and name in content.get("materials", {})


def changes_of(content: Mapping[str, Any], numbers: Mapping[str, float], exact: bool = False) -> dict[str, Any]:
    """Return changes for `read_job` from numbers; a number in a list changes the list.

    Parameters
    ----------
    content : mapping
        Of the job file.
    numbers : mapping of str to float
        In SI units, by key, or by several keys with commas between them.
    exact : bool
        Whether all digits are written, as differences need them.

    Returns
    -------
    dict

    Raises
    ------
    TurgorError
        If the job has no number there.

    Examples
    --------
    >>> changes_of({"materials": {"body": {"mu": ["1 kPa", "2 kPa"]}}}, {"materials.body.mu.2": 3e3})
    {'materials.body.mu': ['1 kPa', '3.0 kPa']}
    """
    known = numbers_of(content)
    changes: dict[str, Any] = {}
    single = {key: number for keys, number in numbers.items() for key in keys.split(",")}
    for key, number in single.items():
        value = any_number(known, key).text(number, exact)
        above, _, last = key.rpartition(".")
        there = _at(content, above.split("."))
        if isinstance(there, list) and not isinstance(there[0], dict):
            changes.setdefault(above, list(there))[int(last) - 1] = value
        else:
            changes[key] = value
    return changes


def record_changes(content: Mapping[str, Any], records: Mapping[str, str]) -> dict[str, Any]:
    """Return changes for `read_job` that give materials other records of the library.

    Density, behavior in time and thickness stay those of the job.

    Parameters
    ----------
    content : mapping
        Of the job file.
    records : mapping of str to str
        Rubber and record with a slash between them, by the keys of the materials.

    Returns
    -------
    dict

    Examples
    --------
    >>> job = {"materials": {"body": {"law": "neo_hooke", "C10": "1 kPa", "density": "1070 kg/m³"}}}
    >>> record_changes(job, {"materials.body": "ecoflex-00-30/yeoh-steck-2019"})["materials.body"]["density"]
    '1070 kg/m³'
    """
    changes: dict[str, Any] = {}
    for keys, value in records.items():
        library, _, record = value.rpartition("/")
        for key in keys.split(","):
            table = _at(content, key.split("."))
            kept = {name: table[name] for name in _OF_THE_JOB if name in table}
            changes[key] = {"library": library, "record": record, **kept}
    return changes


def _at(content: Any, parts: Sequence[str]) -> Any:
    for part in parts:
        content = content[int(part) - 1] if isinstance(content, list) else content[part]
    return content


def _gather(key: str, value: Any, found: dict[str, JobNumber]) -> None:
    if isinstance(value, Mapping):
        for name, each in value.items():
            if name != "source":
                _gather(f"{key}.{name}", each, found)
    elif isinstance(value, list):
        for number, each in enumerate(value, start=1):
            _gather(f"{key}.{number}", each, found)
    elif isinstance(value, int | float) and not isinstance(value, bool):
        found[key] = JobNumber(key=key, value=float(value), unit="", whole=isinstance(value, int))
    elif isinstance(value, str):
        read = split_quantity(value)
        if read is not None:
            found[key] = JobNumber(key=key, value=read[0] * unit_value(read[1]), unit=read[1])
