"""Changes of a job: values by their dotted keys, laid over the content of a file before it is read."""

import tomllib
from collections.abc import Iterable, Mapping
from copy import deepcopy
from typing import Any

from turgor.foundation.errors import TurgorError, near_match
from turgor.job.text.lines import Key, Place, dotted_key
from turgor.job.text.problems import ARGUMENT, OPTION
from turgor.job.text.quantities import shown


def _error(sentence: str, colon: str = ": ") -> TurgorError:
    return TurgorError(python=f"{ARGUMENT}{colon}{sentence}", command=f"{OPTION}{colon}{sentence}")


def parse_changes(texts: Iterable[str]) -> dict[str, Any]:
    """Read changes such as ``loads.pressure=30 kPa``; text that is no TOML value is taken as it stands.

    Parameters
    ----------
    texts : iterable of str
        A dotted key, an equals sign and a value each; of two values for a key the last one counts.

    Returns
    -------
    dict of str to value
        For `read_job`.

    Raises
    ------
    TurgorError
        If a text has no key or no value.

    Examples
    --------
    >>> parse_changes(["loads.pressure=30 kPa", "mesh.wall_cells = 2", "procedure.at = [0.5, 1]"])
    {'loads.pressure': '30 kPa', 'mesh.wall_cells': 2, 'procedure.at': [0.5, 1]}
    """
    changes = {}
    for text in texts:
        key, equals, value = text.partition("=")
        if not (key.strip() and equals and value.strip()):
            raise _error(f"is '{text}'; write a key and its value, such as loads.pressure='30 kPa'.", " ")
        changes[key.strip()] = _value(key.strip(), value.strip())
    return changes


def _value(key: str, text: str) -> Any:
    """Read a value of TOML, or a text without quotes."""
    try:
        (value,) = tomllib.loads(f"value = {text}").values()
    except tomllib.TOMLDecodeError as error:
        if text.startswith(("[", "{", '"', "'")):
            raise _error(f"{key}: {text} is not valid TOML: {str(error).split(' (at')[0]}.") from None
        return text
    except ValueError:  # several lines with keys of their own
        return text
    return value


def changed(
    content: Mapping[str, Any], defaults: Mapping[str, Mapping[str, Any]], changes: Mapping[str, Any]
) -> dict[str, Any]:
    """Return the content of a job file with changes laid over it; what they do not name stays.

    Parameters
    ----------
    content : mapping
        The file.
    defaults : mapping
        Content of sections that the file leaves out; a change starts from it.
    changes : mapping of str to value
        New values by dotted key. A stage is named by its name or its number, from 1.

    Returns
    -------
    dict

    Raises
    ------
    TurgorError
        If a part of a key is a value, not a table.
    """
    merged: dict[str, Any] = deepcopy(dict(content))
    for text, value in changes.items():
        key = _key(text)
        if len(key) > 1 and key[0] in defaults:
            merged.setdefault(key[0], dict(defaults[key[0]]))
        _table(merged, key)[key[-1]] = value
    return merged


def changed_places(lines: Mapping[Key, Place], changes: Mapping[str, Any]) -> dict[Key, Place]:
    """Return where each key stands: in a line of the file, or in a change.

    Examples
    --------
    >>> changed_places({("mesh",): 1, ("mesh", "size"): 2}, {"mesh.size": "2 mm", "loads.pressure": "1 kPa"})
    {('mesh',): 1, ('mesh', 'size'): 'changes', ('loads',): 'changes', ('loads', 'pressure'): 'changes'}
    """
    places = dict(lines)
    for key in map(_key, changes):
        places = {other: place for other, place in places.items() if other[: len(key)] != key or other == key}
        for length in range(1, len(key)):
            places.setdefault(key[:length], ARGUMENT)
        places[key] = ARGUMENT
    return places


def _key(text: str) -> Key:
    key = dotted_key(text)
    if key is None:
        raise _error(f"'{text}' is no key; write names with points between them: loads.pressure.")
    return key


def _table(content: dict[str, Any], key: Key) -> dict[str, Any]:
    """Table with the last part of a key; missing ones are added."""
    table: Any = content
    for depth, part in enumerate(key[:-1], start=1):
        table = _stage(table, key[:depth]) if isinstance(table, list) else table.setdefault(part, {})
        inner = key[depth:]
        if not isinstance(table, dict) and not (_are_tables(table) and len(inner) > 1):
            whole, outer = ".".join(key), ".".join(key[:depth])
            raise _error(f"{whole}: {outer} is {_kind_of(table)}, which has no key '{inner[0]}'.")
    return table


def _kind_of(value: Any) -> str:
    return "a list of tables" if _are_tables(value) else shown(value)


def _are_tables(value: Any) -> bool:
    return isinstance(value, list) and bool(value) and all(isinstance(each, dict) for each in value)


def _stage(tables: list[dict[str, Any]], key: Key) -> dict[str, Any]:
    """Table of a list, by its name or its number."""
    names = [str(table.get("name", number)) for number, table in enumerate(tables, start=1)]
    if key[-1] in names:
        return tables[names.index(key[-1])]
    if key[-1].isdigit() and 1 <= int(key[-1]) <= len(tables):
        return tables[int(key[-1]) - 1]
    hint = near_match(key[-1], names) or "."
    raise _error(f"{'.'.join(key)}: there is no '{key[-1]}'{hint} Known: {', '.join(names)}.")
