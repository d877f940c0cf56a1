"""Numbers of a job file, by their keys; they are read from text with a unit and written as such."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from turgor.foundation.errors import TurgorError, unknown
from turgor.studies.runs.rounding import rounded
from turgor.units import UNITS, parse_quantity, split_quantity, unit_value

#: Sections of a job whose numbers are no quantities of the actuator.
_LEFT_OUT = ("written_by", "output", "engine", "name")

#: Tables of a material that the response does not depend on.
_NO_NUMBERS = ("source", "strength")


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
    >>> numbers = numbers_of({"materials": {"body": {"law": "ogden", "mu": ["1 kPa", "2 kPa"], "alpha": [2.0, 4.0]}}})
    >>> numbers["materials.body.mu.2"]
    JobNumber(key='materials.body.mu.2', value=2000.0, unit='kPa', whole=False)
    """
    numbers: dict[str, JobNumber] = {}
    for name in content:
        if name not in _LEFT_OUT:
            _gather(name, content[name], numbers)
    return numbers


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


def shared_number(numbers: Mapping[str, JobNumber], text: str) -> tuple[str, JobNumber]:
    """Return the name and the number of several keys with commas between them, of which one value fits all.

    Parameters
    ----------
    numbers : mapping of str to JobNumber
    text : str

    Returns
    -------
    (str, JobNumber)

    Raises
    ------
    TurgorError
        If one is unknown or a whole number, or they measure different things.
    """
    keys = [each.strip() for each in text.split(",")]
    matches = [find_number(numbers, each) for each in keys]
    units = {each.dimension for each in matches}
    if len(units) > 1:
        raise TurgorError(f"'{text.strip()}': {' and '.join(sorted(units))} cannot have one value.")
    return ",".join(keys), matches[0]


def mean_and_deviation(text: str, number: JobNumber, where: str) -> tuple[float, float]:
    """Read ``"0.12 MPa +- 5 %"``; without a mean it is the number of the job.

    Parameters
    ----------
    text : str
    number : JobNumber
        Whose unit the value has.
    where : str
        Beginning of messages.

    Returns
    -------
    (float, float) [SI]

    Raises
    ------
    TurgorError
        If it cannot be read.
    """
    first, sign, second = text.replace("±", "+-").partition("+-")
    mean, deviation = (first, second) if sign else ("", first)
    middle = read_number(mean, number, where) if mean.strip() else number.value
    if deviation.strip().endswith("%"):
        try:
            return middle, abs(middle) * float(deviation.strip().removesuffix("%")) / 100
        except ValueError:
            raise TurgorError(f"{where}: '{deviation.strip()}' is no share in percent; write it as '5 %'.") from None
    return middle, read_number(deviation, number, where)


def _gather(key: str, value: Any, numbers: dict[str, JobNumber]) -> None:
    if isinstance(value, Mapping):
        for name, each in value.items():
            if name not in _NO_NUMBERS:
                _gather(f"{key}.{name}", each, numbers)
    elif isinstance(value, list):
        for number, each in enumerate(value, start=1):
            _gather(f"{key}.{number}", each, numbers)
    elif isinstance(value, int | float) and not isinstance(value, bool):
        numbers[key] = JobNumber(key=key, value=float(value), unit="", whole=isinstance(value, int))
    elif isinstance(value, str):
        read = split_quantity(value)
        if read is not None:
            numbers[key] = JobNumber(key=key, value=read[0] * unit_value(read[1]), unit=read[1])
