"""Spreads of the numbers of a job: as text, and as tables of sets."""

from collections.abc import Mapping
from pathlib import Path

from turgor.studies.runs.files.designs_csv import read_designs
from turgor.studies.runs.jobs.job_numbers import JobNumber, mean_and_deviation, read_number, shared_number
from turgor.studies.uncertainty.spread import Alternatives, Spread

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
    designs = read_designs(file, numbers)
    for each in designs.factors:
        shared_number(numbers, each.name)
    sets = tuple({name: float(value) for name, value in values.items()} for values in designs.values)
    return Alternatives(sets=sets, label=label)
