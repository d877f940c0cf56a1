"""Factors of a job: any number, record of a material or choice, by its dotted key, with levels or a range as text."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from turgor.foundation.errors import TurgorError
from turgor.job.read import read_job
from turgor.job.text.problems import ARGUMENT, JobError
from turgor.studies.runs.factor import Factor, Value
from turgor.studies.runs.jobs.job_changes import is_material, job_changes
from turgor.studies.runs.jobs.job_numbers import JobNumber, any_number, read_number
from turgor.studies.runs.rounding import rounded

#: Keys of a range.
RANGE = ("low", "high", "levels")


def job_factor(key: str, given: Any, content: Mapping[str, Any], numbers: Mapping[str, JobNumber]) -> Factor:
    """Return a factor of a job from what a study file states.

    Parameters
    ----------
    key : str
        Dotted key, or several with commas between them that have one value.
    given : list or mapping
        Levels such as ``["1 mm", "2 mm"]``; or ``low``, ``high`` and, if need be, a number of ``levels``.
    content : mapping
        Of the job with every value.
    numbers : mapping of str to JobNumber
        Its numbers.

    Returns
    -------
    Factor

    Raises
    ------
    TurgorError
        If the key is unknown, or a value has a wrong unit.
    """
    keys = [each.strip() for each in key.split(",")]
    name = ",".join(keys)
    if isinstance(given, list):
        if not given:
            raise TurgorError("the list is empty; give levels.")
        if all(isinstance(each, str) for each in given) and not all(each in numbers for each in keys):
            _check_key(keys, content, numbers)
            return Factor(name=name, levels=tuple(given))
        number = _number(keys, numbers)
        values = tuple(_value(each, number) for each in given)
        return Factor(name=name, levels=values, unit=number.unit, whole=number.whole)
    if isinstance(given, Mapping) and {"low", "high"} <= set(given) <= set(RANGE):
        number = _number(keys, numbers)
        low, high = (_value(given[each], number) for each in ("low", "high"))
        whole = Factor(name=name, low=float(low), high=float(high), unit=number.unit, whole=number.whole)
        count = given.get("levels")
        if count is None:
            return whole
        if not isinstance(count, int) or count < 2:
            raise TurgorError(f"levels is {count!r}; allowed is a whole number of 2 or more.")
        return Factor(name=name, levels=whole.spaced(count), unit=number.unit, whole=number.whole)
    raise TurgorError(f"{given!r} is neither a list of levels nor a range {{ low = ..., high = ... }}.")


def check_choices(
    file: Path, changes: Mapping[str, Any], factors: Sequence[Factor], content: Mapping[str, Any]
) -> None:
    """Read a job with each choice of each factor, so that a missing record is reported before anything runs.

    Parameters
    ----------
    file : Path
        The job.
    changes : mapping of str to value
        Other changes of it.
    factors : sequence of Factor
    content : mapping
        Of the job with every value.

    Raises
    ------
    TurgorError
        If the job refuses a choice.
    """
    for each in factors:
        for level in each.levels if each.is_choice else ():
            try:
                read_job(file, {**changes, **job_changes(content, {each.name: level})})
            except JobError as error:
                sentences = [text.removeprefix(f"{ARGUMENT}: ") for text in error.problems]
                raise TurgorError(f"with '{level}', the job has a problem: {' '.join(sentences)}") from None


def _check_key(keys: Sequence[str], content: Mapping[str, Any], numbers: Mapping[str, JobNumber]) -> None:
    """Raise an error for a key that leads nowhere, where a near one exists."""
    for key in keys:
        if is_material(content, key):
            continue
        first, _, rest = key.partition(".")
        if first not in content or not rest or first == "materials":
            any_number(numbers, key)


def _number(keys: Sequence[str], numbers: Mapping[str, JobNumber]) -> JobNumber:
    matches = [any_number(numbers, key) for key in keys]
    if len({each.dimension for each in matches}) > 1:
        raise TurgorError(f"{' and '.join(sorted({each.dimension for each in matches}))} cannot have one value.")
    return matches[0]


def _value(given: Any, number: JobNumber) -> Value:
    """Read a value: text with a unit, or a number where the key has none."""
    if isinstance(given, bool) or not isinstance(given, int | float | str):
        raise TurgorError(f"{given!r} is not a value of '{number.key}'.")
    if number.unit and not isinstance(given, str):
        raise TurgorError(f"{given!r} needs a unit, such as '{given} {number.unit}'.")
    value = read_number(str(given), number, number.key) if isinstance(given, str) else float(given)
    if number.whole:
        return int(number.text(value))
    return rounded(value)
