"""Spreads of the numbers of a job file, as text and as tables."""

import csv
import re
from collections.abc import Iterable
from pathlib import Path

from turgor.foundation.errors import TurgorError
from turgor.studies.calibration.job_files import mean_and_deviation
from turgor.studies.runs.computation import Computation
from turgor.studies.runs.jobs.job_file import JobFile, keys_of
from turgor.studies.runs.jobs.job_numbers import JobNumber, find_number, read_number
from turgor.studies.runs.jobs.job_runs import solved_job
from turgor.studies.uncertainty.spread import Alternatives, Input, Spread
from turgor.units import UNITS

#: The column that drives most jobs, whose spread needs no run.
PRESSURE = JobNumber(key="pressure", value=0.0, unit="kPa")


def job_computation(job: JobFile, *, mesh_error: bool) -> Computation:
    """Return a job as a function of its numbers.

    Parameters
    ----------
    job : JobFile
    mesh_error : bool
        Whether the mesh error of the nominal run is estimated.

    Returns
    -------
    Computation
    """
    nominal = {"mesh_error": True} if mesh_error else {}
    return Computation(function=solved_job, values=job.values, nominal=nominal, gather="numbers")


def read_spreads(texts: Iterable[str], job: JobFile) -> list[Input]:
    """Read spreads such as ``"actuator.wall=0.1 mm"`` and ``"materials.body.C10=0.12 MPa +- 5 % as rubber"``.

    Parameters
    ----------
    texts : iterable of str
        ``KEY=DEVIATION`` or ``KEY=MEAN+-DEVIATION``, or replicates with semicolons between them; then ``as LABEL``.
        ``pressure`` is the pressure at which values are read.
    job : JobFile

    Returns
    -------
    list of Spread

    Raises
    ------
    TurgorError
        If a key is unknown or a value cannot be read.
    """
    found: list[Input] = []
    for text in texts:
        keys, sign, value = (part.strip() for part in text.partition("="))
        if not (sign and keys and value):
            raise TurgorError(f"--spread is '{text}'; write KEY=DEVIATION, such as actuator.wall='0.1 mm'.")
        if keys == PRESSURE.key:
            value, _, label = (part.strip() for part in value.partition(" as "))
            deviation = read_number(value, PRESSURE, f"--spread {keys}")
            found.append(Spread(name=keys, deviation=deviation, label=label))
            continue
        name = keys_of(keys, job, "--spread")
        found.append(read_spread(name, value, find_number(job.numbers, name.split(",")[0])))
    return found


def read_spread(name: str, text: str, number: JobNumber) -> Spread:
    """Read the spread of a number.

    Parameters
    ----------
    name : str
    text : str
        ``DEVIATION`` or ``MEAN+-DEVIATION``, or replicates with semicolons between them; then ``as LABEL``.
    number : JobNumber
        Whose unit the values have; its value is the mean where none is stated.

    Returns
    -------
    Spread

    Raises
    ------
    TurgorError
        If it cannot be read.

    Examples
    --------
    >>> read_spread("wall", "1.5 mm +- 2 %", JobNumber(key="wall", value=1e-3, unit="mm")).standard
    (0.0015, 3e-05)
    """
    value, _, label = (part.strip() for part in text.partition(" as "))
    where = f"--spread {name}"
    if ";" in value:
        replicates = tuple(read_number(each, number, where) for each in value.split(";"))
        return Spread(name=name, replicates=replicates, label=label)
    mean, deviation = mean_and_deviation(value, number, where)
    return Spread(name=name, mean=mean, deviation=deviation, label=label)


def read_sets(texts: Iterable[str], job: JobFile) -> list[Input]:
    """Read tables of constants that belong together, such as ``"rubber=specimens.csv"``.

    Parameters
    ----------
    texts : iterable of str
        ``LABEL=FILE``. The file is CSV: keys of the job with their units in brackets in the first line,
        ``materials.body.C10 (kPa)``, and a line for each specimen, batch or record; the first one is the nominal one.
    job : JobFile

    Returns
    -------
    list of Alternatives

    Raises
    ------
    TurgorError
        If a file cannot be read.
    """
    found: list[Input] = []
    for text in texts:
        label, sign, file = (part.strip() for part in text.partition("="))
        if not (sign and label and file):
            raise TurgorError(f"--sets is '{text}'; write LABEL=FILE, such as rubber=specimens.csv.")
        found.append(Alternatives(sets=tuple(_rows(Path(file), job)), label=label))
    return found


def _rows(file: Path, job: JobFile) -> list[dict[str, float]]:
    lines = list(csv.reader(file.read_text(encoding="utf-8-sig").splitlines()))
    if not lines:
        raise TurgorError(f"'{file}' is empty.")
    heads = [_head(text, job, file) for text in lines[0]]
    rows = []
    for number, line in enumerate(lines[1:], start=2):
        if not any(cell.strip() for cell in line):
            continue
        if len(line) != len(heads):
            raise TurgorError(f"'{file}', line {number}: {len(line)} cells; the first line has {len(heads)}.")
        rows.append({key: _cell(cell, file, number) * factor for (key, factor), cell in zip(heads, line, strict=True)})
    return rows


def _head(text: str, job: JobFile, file: Path) -> tuple[str, float]:
    """Key and value of the unit of a column."""
    match = re.fullmatch(r"\s*([^()\[\]]+?)\s*(?:[(\[](.+)[)\]])?\s*", text)
    if match is None:
        raise TurgorError(f"'{file}': '{text}' is no key with a unit, such as materials.body.C10 (kPa).")
    key = keys_of(match[1].replace("+", ","), job, f"'{file}'")
    number = find_number(job.numbers, key.split(",")[0])
    if not number.unit:
        return key, 1.0
    units = UNITS[number.dimension]
    if match[2] not in units:
        raise TurgorError(f"'{file}': '{text.strip()}' needs a unit in brackets: {', '.join(units)}.")
    return key, units[match[2]]


def _cell(cell: str, file: Path, line: int) -> float:
    try:
        return float(cell)
    except ValueError:
        raise TurgorError(f"'{file}', line {line}: '{cell}' is not a number.") from None
