"""Forms: tables of a job file with units, ranges and meanings, for the page."""

import re
from collections.abc import Iterable
from dataclasses import asdict
from functools import lru_cache
from pathlib import Path
from typing import Any

from turgor.core.geometry.geometry import Geometry
from turgor.foundation.errors import TurgorError
from turgor.job.job import ACTUATORS
from turgor.job.read import read_job
from turgor.job.reference.tables import JobKey, JobTable, family_table
from turgor.job.tables.sections import read_actuator
from turgor.job.text.problems import JobError, Problems
from turgor.studio.tasks.building import built
from turgor.studio.tasks.content import actuator_in, at_key, content_of, plain
from turgor.studio.tasks.reach import reach

#: A range in a sentence, such as ``0.01 mm to 10.967 mm, so that …`` or ``a whole number from 1 to 100``.
_RANGE = re.compile(r"(-?[\d.]+)(?: ([^\s\d,]+))? to (-?[\d.]+)(?: ([^\s\d,]+))?")

#: What a sentence says of a key that is left out by a zero.
_ZERO = re.compile(r"\b0 (?:\(none\)|leaves it out)")


#: Header of the table of a material of the library.
LIBRARY = "[materials.NAME], from the library"


def table_as_json(table: JobTable) -> dict[str, Any]:
    """Return a table with the limits of its keys as numbers.

    Examples
    --------
    >>> from turgor.job.reference.tables import family_table
    >>> keys = table_as_json(family_table("fast_pneunet"))["keys"]
    >>> next(key["limits"] for key in keys if key["name"] == "gap")
    {'low': 0.01, 'high': 10.967, 'unit': 'mm', 'zero': False}
    """
    keys = [{**asdict(key), "limits": limits(key), "choices": choices(key)} for key in table.keys]
    return {"header": table.header, "words": table.words, "keys": keys}


def limits(key: JobKey) -> dict[str, Any] | None:
    """Return the smallest and the largest value of a key, with their unit; None where no range is stated."""
    match = _RANGE.search(key.allowed)
    if match is None or (key.units and match[4] not in key.units):
        return None
    zero = _ZERO.search(key.allowed) is not None
    return {"low": float(match[1]), "high": float(match[3]), "unit": match[4] if key.units else "", "zero": zero}


def choices(key: JobKey) -> list[str]:
    """Return the texts that a key may be; none where it takes others."""
    words = key.allowed.split(", ")
    plain_words = all(re.fullmatch(r"[\w-]+", word) for word in words)
    return words if key.kind == "text" and plain_words and len(words) > 1 else []


def form_of_actuator(table: dict[str, Any]) -> dict[str, Any] | None:
    """Return the form of the dimensions of a family, with ranges where its other dimensions stay.

    Where the table has a mistake, ranges are those around the defaults.
    """
    kind = str(table.get("type"))
    if kind not in ACTUATORS:
        return None
    actuator = read_actuator(table, Problems("", {}))
    given = {key: value for key, value in table.items() if key != "type"} if actuator is not None else {}
    form = table_as_json(family_table(kind, given))
    for key in form["keys"]:
        if actuator is not None and key["limits"]:
            key["limits"] = reach(actuator, key["name"], key["limits"])
    return form


def forms_of(file: Path, headers: Iterable[str]) -> dict[str, Any]:
    """Return the forms of some tables of a job by the beginnings of their headers, and the content of the job."""
    content, problems = content_of(file)
    shape = built(actuator_in(content), problems)
    if shape is None:
        raise TurgorError("the shape has a mistake; mend it on the screen Shape first.")
    wanted = tuple(headers)
    wrong: tuple[str, ...] = ()
    try:
        read_job(file)
    except JobError as error:
        wrong = error.problems
    return {
        "problems": [at_key(entry, str(file)) for entry in wrong],
        "content": plain(content),
        "faces": list(shape.faces),
        "regions": list(shape.regions),
        "cavities": list(shape.cavities),
        "tables": [each for each in _tables(shape) if each["header"].startswith(wanted)],
    }


@lru_cache(maxsize=4)
def _tables(shape: Geometry) -> list[dict[str, Any]]:
    from turgor.job.reference.sections import section_tables  # here: it loads the engine, and a picture needs none

    # a part without such a face has no range of a layer, but may have a layer all the same
    library = next(table for table in section_tables() if table.header == LIBRARY)
    tables = (library if table.header == LIBRARY else table for table in section_tables(shape))
    return [table_as_json(table) for table in tables]
