"""Changes of a job file: other numbers, records of materials and choices by their keys, in the form of the file."""

from collections.abc import Mapping, Sequence
from typing import Any

from turgor.studies.runs.factor import Value
from turgor.studies.runs.jobs.job_numbers import any_number, numbers_of

#: Keys of a material that stay when it gets another record.
_OF_THE_JOB = (
    *("density", "viscoelasticity", "stress_softening", "permanent_set", "strength", "crack_growth"),
    *("thickness", "form", "compression", "warp", "bending_stiffness"),
)


def job_changes(content: Mapping[str, Any], values: Mapping[str, Value]) -> dict[str, Any]:
    """Return changes for `read_job` from numbers, records of materials and other choices.

    Parameters
    ----------
    content : mapping
        Of the job file.
    values : mapping of str to float, int or str
        By key, or by several keys with commas between them; numbers in SI units.

    Returns
    -------
    dict

    Raises
    ------
    TurgorError
        If the job has no number there, or a whole number gets another one.

    Examples
    --------
    >>> job = {"actuator": {"chambers": 4, "wall": "1 mm"}, "mesh": {"cells": "tetrahedra"}}
    >>> job_changes(job, {"actuator.chambers": 6, "mesh.cells": "hexahedra"})
    {'actuator.chambers': 6, 'mesh.cells': 'hexahedra'}
    """
    numbers = {keys: float(value) for keys, value in values.items() if not isinstance(value, str)}
    texts = {key: value for keys, value in values.items() if isinstance(value, str) for key in keys.split(",")}
    records = {key: value for key, value in texts.items() if is_material(content, key)}
    choices = {key: value for key, value in texts.items() if key not in records}
    # another file has another content than the one that the job states
    contents = {f"{key.removesuffix('.file')}.sha256": "" for key in choices if key.endswith(".file")}
    return changes_of(content, numbers) | record_changes(content, records) | choices | contents


def is_material(content: Mapping[str, Any], key: str) -> bool:
    """Whether a key of a job is that of a material, which has records as its values."""
    first, _, name = key.partition(".")
    return first == "materials" and name in content.get("materials", {})


def changes_of(content: Mapping[str, Any], numbers: Mapping[str, float], exact: bool = False) -> dict[str, Any]:
    """Return changes for `read_job` from numbers; a number in a list changes the list.

    Parameters
    ----------
    content : mapping
        Of the job file.
    numbers : mapping of str to float
        In SI units, by key, or by several keys with commas between them.
    exact : bool
        Whether all digits are written, as differences need them.

    Returns
    -------
    dict

    Raises
    ------
    TurgorError
        If the job has no number there.

    Examples
    --------
    >>> changes_of({"materials": {"body": {"mu": ["1 kPa", "2 kPa"]}}}, {"materials.body.mu.2": 3e3})
    {'materials.body.mu': ['1 kPa', '3.0 kPa']}
    """
    known = numbers_of(content)
    changes: dict[str, Any] = {}
    single = {key: number for keys, number in numbers.items() for key in keys.split(",")}
    for key, number in single.items():
        value = any_number(known, key).text(number, exact)
        above, _, last = key.rpartition(".")
        there = _at(content, above.split("."))
        if isinstance(there, list) and not isinstance(there[0], dict):
            changes.setdefault(above, list(there))[int(last) - 1] = value
        else:
            changes[key] = value
    return changes


def record_changes(content: Mapping[str, Any], records: Mapping[str, str]) -> dict[str, Any]:
    """Return changes for `read_job` that give materials other records of the library.

    Density, behavior in time and thickness stay those of the job.

    Parameters
    ----------
    content : mapping
        Of the job file.
    records : mapping of str to str
        Rubber and record with a slash between them, by the keys of the materials.

    Returns
    -------
    dict

    Examples
    --------
    >>> job = {"materials": {"body": {"law": "neo_hooke", "C10": "1 kPa", "density": "1070 kg/m³"}}}
    >>> record_changes(job, {"materials.body": "ecoflex-00-30/yeoh-steck-2019"})["materials.body"]["density"]
    '1070 kg/m³'
    """
    changes: dict[str, Any] = {}
    for keys, value in records.items():
        library, _, record = value.rpartition("/")
        for key in keys.split(","):
            table = _at(content, key.split("."))
            others = {name: table[name] for name in _OF_THE_JOB if name in table}
            changes[key] = {"library": library, "record": record, **others}
    return changes


def _at(content: Any, parts: Sequence[str]) -> Any:
    for part in parts:
        content = content[int(part) - 1] if isinstance(content, list) else content[part]
    return content
