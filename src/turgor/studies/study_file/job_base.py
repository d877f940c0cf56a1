"""The job of a study file, and the factors of it: levels, ranges, starts, priors and spreads by key."""

import tomllib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from turgor.foundation.errors import TurgorError, unknown
from turgor.foundation.toml_text import read_text, read_toml
from turgor.job.job import Job
from turgor.job.output.lock import lock_text
from turgor.job.read import read_job
from turgor.job.text.overrides import changed
from turgor.studies.runs.designs import Designs
from turgor.studies.runs.factor import Factor, Value
from turgor.studies.runs.files.designs_csv import read_designs
from turgor.studies.runs.jobs.job_factors import RANGE, check_choices, job_factor
from turgor.studies.runs.jobs.job_numbers import JobNumber, numbers_of, shared_number

#: Keys of a factor.
KEYS = (*RANGE, "start", "prior", "spread", "label")


@dataclass(frozen=True, slots=True)
class JobBase:
    """The job that a study varies.

    Parameters
    ----------
    file : Path
    changes : mapping
        Of the command line.
    """

    file: Path
    changes: Mapping[str, Any]
    job: Job = field(init=False)
    whole: Mapping[str, Any] = field(init=False)
    numbers: Mapping[str, JobNumber] = field(init=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "job", read_job(self.file, self.changes))
        object.__setattr__(self, "whole", tomllib.loads(lock_text(self.job, {})))
        object.__setattr__(self, "numbers", numbers_of(self.whole))

    @property
    def stated_materials(self) -> Mapping[str, Any]:
        """``[materials]`` as the file and the changes state it: names of records, not their constants."""
        content = changed(read_toml(read_text(self.file), str(self.file)), {}, self.changes)
        return dict(content.get("materials", {}))

    def factor(self, key: str, given: Any) -> Factor:
        """Return a factor with levels or a range that the job takes."""
        if isinstance(given, Mapping):
            given = {name: value for name, value in given.items() if name in RANGE}
        factor = job_factor(key, given, self.whole, self.numbers)
        check_choices(self.file, self.changes, [factor], self.whole)
        return factor

    def range(self, key: str, given: Any) -> tuple[Factor, Value]:
        """Return a factor with a range, and where a search starts: at the value of the job by default."""
        if not isinstance(given, Mapping):
            raise TurgorError(f'{given!r} is not a range; write {{ low = "1 mm", high = "2 mm" }}.')
        for end in ("low", "high"):
            if end not in given:
                raise TurgorError(f"'{end}' is missing.")
        factor = job_factor(key, {end: given[end] for end in ("low", "high")}, self.whole, self.numbers)
        number = self.numbers[factor.name.split(",")[0]]
        start = number.value
        if "start" in given:
            start = float(job_factor(key, [given["start"]], self.whole, self.numbers).levels[0])
        low, high = factor.bounds
        return factor, round(start) if number.whole else min(max(start, low), high)

    def number(self, key: str) -> tuple[str, JobNumber]:
        """Return the name of a factor and its number, which is not a whole one; several keys have one value."""
        return shared_number(self.numbers, key)

    def table(self, file: Path) -> Designs:
        """Return the designs of a table that the job takes."""
        designs = read_designs(file, self.numbers)
        check_choices(self.file, self.changes, designs.factors, self.whole)
        return designs


def flat_keys(given: Mapping[str, Any], above: tuple[str, ...] = ()) -> Iterator[tuple[tuple[str, ...], Any]]:
    """Iterate over factors, whether their keys stand in quotes or as tables within tables.

    Parameters
    ----------
    given : mapping
        ``[factors]`` of a study file.
    above : tuple of str
        Keys of the tables around it.

    Yields
    ------
    (tuple of str, value)
        The parts of the key, and levels or a table of `KEYS`.

    Examples
    --------
    >>> dict(flat_keys({"actuator": {"wall": {"low": "1 mm", "high": "2 mm"}}}))
    {('actuator', 'wall'): {'low': '1 mm', 'high': '2 mm'}}
    """
    for name, value in given.items():
        if isinstance(value, Mapping) and value and not set(value) & set(KEYS):
            yield from flat_keys(value, (*above, name))
        else:
            yield (*above, name), value


def check_factor(given: Any) -> None:
    """Raise an error for a key that no factor has, with the near match."""
    for key in given if isinstance(given, Mapping) else ():
        if key not in KEYS:
            raise unknown("key of a factor", key, KEYS)
