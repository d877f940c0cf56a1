"""Edits: values of a TOML text by their dotted keys; what is not named keeps its form, comments included."""

from collections.abc import Mapping
from typing import Any

import tomlkit
from tomlkit.exceptions import TOMLKitError
from tomlkit.items import Table

from turgor.foundation.errors import TurgorError


def with_values(text: str, values: Mapping[str, Any]) -> str:
    r"""Return a TOML text with values set or removed.

    Parameters
    ----------
    text : str
    values : mapping of str to value
        By dotted keys; None removes a key, and a mapping replaces a table. A number in a key is the place in a list
        of tables, from 1.

    Returns
    -------
    str

    Raises
    ------
    TurgorError
        If the text is no TOML, or a part of a key is no table.

    Examples
    --------
    >>> text = "[actuator] # a finger\nwall = '1 mm' # thin"
    >>> print(with_values(text, {"actuator.wall": "2 mm", "mesh.size": "3 mm"}))
    [actuator] # a finger
    wall = "2 mm" # thin
    <BLANKLINE>
    [mesh]
    size = "3 mm"
    <BLANKLINE>
    """
    try:
        document = tomlkit.parse(text)
    except TOMLKitError as error:
        raise TurgorError(f"the file is no TOML: {error}. Mend its text first.") from error
    for key, value in values.items():
        _set(document, key, value)
    return tomlkit.dumps(document)


def _set(document: Any, key: str, value: Any) -> None:
    *outer, last = key.split(".")
    table = document
    for depth, name in enumerate(outer, start=1):
        if isinstance(table, list):
            if not name.isdigit() or not 1 <= int(name) <= len(table):
                raise TurgorError(f"'{key}': there is no entry '{name}'; there are {len(table)}.")
            table = table[int(name) - 1]
            continue
        if name not in table:
            if value is None:
                return
            table[name] = tomlkit.table()
        table = table[name]
        if not isinstance(table, dict | list):
            raise TurgorError(f"'{key}': '{'.'.join(outer[:depth])}' is a value, not a table.")
    if isinstance(table, list):
        raise TurgorError(f"'{key}' names no key of a table.")
    if value is None:
        table.pop(last, None)
    elif isinstance(value, Mapping) and isinstance(table.get(last), Table):
        _fill(table[last], value)
    else:
        table[last] = _item(value)


def _fill(table: Table, values: Mapping[str, Any]) -> None:
    """Give a table with lines of its own other values; it stays where it is."""
    for key in [key for key in table if key not in values]:
        del table[key]
    for key, value in values.items():
        if isinstance(value, Mapping) and isinstance(table.get(key), Table):
            _fill(table[key], value)
        else:
            table[key] = _item(value)


def _item(value: Any) -> Any:
    """A value as it is written: a table within one line, so that it can stand between the keys of another."""
    if not isinstance(value, Mapping):
        return value
    table = tomlkit.inline_table()
    for key, part in value.items():
        table[key] = _item(part)
    return table
