"""Files of records: those of the library, and files of a user's own in the same form."""

import tomllib
from collections.abc import Mapping
from functools import cache
from importlib.resources import files
from pathlib import Path
from types import MappingProxyType
from typing import Any

from turgor.core.materials.library.record import FILE_KEYS, Record, read_record
from turgor.core.materials.table_keys import table
from turgor.foundation.errors import TurgorError, near_match
from turgor.foundation.toml_text import read_text, read_toml

_NO_SEPARATORS = str.maketrans("", "", "-_ ")


def library() -> tuple[str, ...]:
    """Return the names of all materials in the library.

    Examples
    --------
    >>> library()[:3]
    ('agilus30', 'body-double-silk', 'carbon-fiber')
    """
    folder = files("turgor.core.materials.library").joinpath("data")
    return tuple(sorted(file.name.removesuffix(".toml") for file in folder.iterdir() if file.name.endswith(".toml")))


def records(name: str) -> tuple[Record, ...]:
    """Return every record of a library material, or of a file of your own, in the order of the file.

    Parameters
    ----------
    name : str
        One of `library()`, or the path of a file that ends in ``.toml``.

    Examples
    --------
    >>> [record.name for record in records("paper")]
    ['hooke-polygerinos-2020', 'hooke-yang-2020', 'hooke-stellenbosch-2021']
    """
    if name.endswith(".toml"):
        return read_records(name)
    names = library()
    if name not in names:
        near = [known for known in names if known.replace("-", "") == name.lower().translate(_NO_SEPARATORS)]
        family = [known for known in names if known.startswith(f"{name.lower()}-")]
        hint = f"; did you mean '{near[0]}'?" if near else near_match(name.lower(), names) or "."
        if family and not near:
            hint = f"; did you mean {' or '.join(repr(each) for each in family)}?"
        raise TurgorError(f"unknown library material '{name}'{hint} Known: {', '.join(names)}.")
    return _library_records(name)


def all_records() -> tuple[Record, ...]:
    """Return every record of the library.

    Examples
    --------
    >>> len(all_records()) > 110
    True
    """
    return tuple(record for name in library() for record in records(name))


def read_records(path: str | Path) -> tuple[Record, ...]:
    """Read a file of records of your own, in the form of the library's files.

    Parameters
    ----------
    path : str or Path
        A TOML file with ``name`` and at least one table ``[records.NAME]``.

    Returns
    -------
    tuple of Record

    Raises
    ------
    TurgorError
        If the file is missing or is no such file; the message names the key.
    """
    if not Path(path).exists():
        raise TurgorError(f"there is no file '{path}' with records of a material.")
    return _read(read_text(Path(path)), str(path))


@cache  # every file of the library cites them
def references() -> Mapping[int, str]:
    """Return the references of Xavier, Fleming and Yong 2021 that the library cites, by their number there.

    Examples
    --------
    >>> references()[127]
    'F. Connolly, P. Polygerinos, C. Walsh, K. Bertoldi, Soft Robot. 2015, 2, 26'
    """
    text = files("turgor.core.materials.library").joinpath("references.toml").read_text(encoding="utf-8")
    return MappingProxyType({int(number): reference for number, reference in tomllib.loads(text).items()})


@cache
def _library_records(name: str) -> tuple[Record, ...]:
    return _read(
        files("turgor.core.materials.library").joinpath("data", f"{name}.toml").read_text(encoding="utf-8"), name
    )


def _read(text: str, name: str) -> tuple[Record, ...]:
    content: Mapping[str, Any] = read_toml(text, name)
    table(content, name, FILE_KEYS, ("name", "records"))
    table(content["records"], f"{name}: records")
    numbered = references()
    return tuple(read_record(content, name, key, numbered) for key in content["records"])
