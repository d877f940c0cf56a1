"""Values of a file of a mechanism: known keys, tables, quantities."""

from collections.abc import Mapping
from typing import Any

from turgor.foundation.errors import TurgorError, unknown
from turgor.units import parse_quantity


def checked_keys(given: Mapping[str, Any], known: tuple[str, ...], where: str) -> None:
    """Refuse keys that are not known."""
    for key in given:
        if key not in known:
            raise unknown(f"key of {where}", key, known)


def table(value: Any, where: str) -> Mapping[str, Any]:
    """Return a table, or refuse another value."""
    if not isinstance(value, Mapping):
        raise TurgorError(f"{where} is {value!r}; a table is needed.")
    return value


def quantity(value: Any, dimension: str, where: str) -> float:
    """Return a quantity in SI units; its error begins with the key."""
    try:
        return parse_quantity(value, dimension)
    except TurgorError as error:
        raise TurgorError(f"{where}: {error}") from None


def vector(given: Mapping[str, Any], key: str, dimension: str, where: str) -> tuple[float, ...]:
    """Return three quantities in SI units; zeros where the key is missing."""
    value = given.get(key, [0, 0, 0])
    if not isinstance(value, list) or len(value) != 3:
        raise TurgorError(f"{where}.{key} is {value!r}; three values are needed.")
    return tuple(0.0 if each == 0 else quantity(each, dimension, f"{where}.{key}") for each in value)
