"""Numbers in study files: with their units, alone and in lists, and a check of keys."""

from collections.abc import Mapping, Sequence
from typing import Any

from turgor.foundation.errors import TurgorError, unknown
from turgor.units import parse_quantity, split_quantity, unit_value

Table = Mapping[str, Any]


def number_in(given: Any, where: str) -> float:
    """Read a number, with its unit where it is a quantity [SI].

    Parameters
    ----------
    given : object
        Number, or text with a unit or a percent sign.
    where : str
        Beginning of messages.

    Returns
    -------
    float

    Raises
    ------
    TurgorError
        If it is neither.

    Examples
    --------
    >>> number_in("30 kPa", "at"), number_in("1 %", "tolerance")
    (30000.0, 0.01)
    """
    if isinstance(given, bool) or not isinstance(given, int | float | str):
        raise TurgorError(f'{where} is {given!r}; a number, or a text with its unit such as "30 kPa" is needed.')
    if not isinstance(given, str):
        return float(given)
    if given.strip().endswith("%"):
        given = given.strip().removesuffix("%").strip()
        return number_in(float(given) if _is_number(given) else given, where) / 100
    read = split_quantity(given)
    if read is None:
        raise TurgorError(f"{where}: '{given}' is no number with a known unit, such as \"30 kPa\".")
    return read[0] * unit_value(read[1])


def numbers_in(given: Any, where: str, dimension: str, example: str) -> list[float]:
    """Read numbers with one unit behind them [SI].

    Parameters
    ----------
    given : object
        Text.
    where : str
        Beginning of messages.
    dimension : str
        What they measure, such as ``"length"``.
    example : str
        For messages.

    Returns
    -------
    list of float

    Raises
    ------
    TurgorError
        If it is no such text.

    Examples
    --------
    >>> numbers_in("0, 10, 20 kPa", "pressure", "pressure", "0, 10 kPa")
    [0.0, 10000.0, 20000.0]
    """
    parts, _, unit = str(given).strip().rpartition(" ")
    if not isinstance(given, str) or not parts:
        raise TurgorError(f'{where} is {given!r}; write numbers and their unit, such as "{example}".')
    try:
        return [parse_quantity(f"{part.strip()} {unit}", dimension) for part in parts.split(",")]
    except TurgorError as error:
        raise TurgorError(f"{where}: {error}") from None


def unit_in(given: Any) -> str:
    """Return the unit of a quantity; empty for what is none."""
    read = split_quantity(given) if isinstance(given, str) else None
    return "" if read is None else read[1]


def check_keys(table: Table, known: Sequence[str], where: str) -> None:
    """Raise an error for a key that is not known, with the near match."""
    for key in table:
        if key not in known:
            raise unknown(f"key in {where}", key, known)


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True
