"""Spreads of the numbers of a job: as text, and as tables of sets."""

import csv
import re
from collections.abc import Mapping
from pathlib import Path

from turgor.foundation.errors import TurgorError
from turgor.studies.runs.jobs.job_numbers import JobNumber, mean_and_deviation, read_number, shared_number
from turgor.studies.uncertainty.spread import Alternatives, Spread
from turgor.units import UNITS

#: The column that drives most jobs, whose spread needs no run.
PRESSURE = JobNumber(key="pressure", value=0.0, unit="kPa")


def read_spread(name: str, text: str, number: JobNumber, label: str = "") -> Spread:
    """Read the spread of a number.

    Parameters
    ----------
    name : str
    text : str
        ``DEVIATION`` or ``MEAN+-DEVIATION``, or replicates with semicolons between them.
    number : JobNumber
        Whose unit the values have; its value is the mean if none is stated.
    label : str
        Name in sentences and pictures.

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
    if name == PRESSURE.key:
        return Spread(name=name, deviation=read_number(text, PRESSURE, "spread"), label=label)
    if ";" in text:
        replicates = tuple(read_number(each, number, "spread") for each in text.split(";"))
        return Spread(name=name, replicates=replicates, label=label)
    mean, deviation = mean_and_deviation(text, number, "spread")
    return Spread(name=name, mean=mean, deviation=deviation, label=label)


def read_set(label: str, file: Path, numbers: Mapping[str, JobNumber]) -> Alternatives:
    """Read a table of constants that belong together.

    Parameters
    ----------
    label : str
        Name in sentences and pictures.
    file : Path
        CSV: keys of the job with their units in brackets in the first line, ``materials.body.C10 (kPa)``, and a line
        for each specimen, batch or record; the first one is the nominal one.
    numbers : mapping of str to JobNumber
        Of the job.

    Returns
    -------
    Alternatives

    Raises
    ------
    TurgorError
        If the file cannot be read.
    """
    return Alternatives(sets=tuple(_rows(file, numbers)), label=label)


def _rows(file: Path, numbers: Mapping[str, JobNumber]) -> list[dict[str, float]]:
    lines = list(csv.reader(file.read_text(encoding="utf-8-sig").splitlines()))
    if not lines:
        raise TurgorError(f"'{file}' is empty.")
    heads = [_head(text, numbers, file) for text in lines[0]]
    rows = []
    for number, line in enumerate(lines[1:], start=2):
        if not any(cell.strip() for cell in line):
            continue
        if len(line) != len(heads):
            raise TurgorError(f"'{file}', line {number}: {len(line)} cells; the first line has {len(heads)}.")
        rows.append({key: _cell(cell, file, number) * factor for (key, factor), cell in zip(heads, line, strict=True)})
    return rows


def _head(text: str, numbers: Mapping[str, JobNumber], file: Path) -> tuple[str, float]:
    """Key and value of the unit of a column."""
    match = re.fullmatch(r"\s*([^()\[\]]+?)\s*(?:[(\[](.+)[)\]])?\s*", text)
    if match is None:
        raise TurgorError(f"'{file}': '{text}' is no key with a unit, such as materials.body.C10 (kPa).")
    key, number = shared_number(numbers, match[1].replace("+", ","))
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
