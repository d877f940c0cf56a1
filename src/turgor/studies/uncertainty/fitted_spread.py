"""Spread of a fitted rubber of a job: the record in its file says how far the constants are off."""

from collections.abc import Mapping
from dataclasses import fields
from pathlib import Path
from typing import Any

from turgor.core.materials.laws.conventions import law_from_printed
from turgor.core.materials.library.fit_spread import SCATTER
from turgor.core.materials.library.record import Record
from turgor.core.materials.library.records import find_record
from turgor.foundation.errors import TurgorError, unknown
from turgor.studies.runs.jobs.job_numbers import JobNumber
from turgor.studies.uncertainty.spread import Alternatives

#: The spread that a record of a fitted rubber states.
FITTED = "fitted"

_ONE_CURVE = "Specimens and batches differ by more; fit several with --by."


def fitted_alternatives(
    keys: str, label: str, materials: Mapping[str, Any], folder: Path, numbers: Mapping[str, JobNumber]
) -> Alternatives:
    """Return sets of constants that have the spread of a fitted record, for keys such as ``"materials.body"``.

    Parameters
    ----------
    keys : str
        Keys of materials, with commas between those of one record.
    label : str
        Name in sentences and pictures; by default the keys.
    materials : mapping
        ``[materials]`` as the job file states it.
    folder : Path
        Of the job file; files of records are relative to it.
    numbers : mapping of str to JobNumber
        Of the job.

    Returns
    -------
    Alternatives
        The fitted constants are the nominal ones.

    Raises
    ------
    TurgorError
        If a key is unknown, its material is no record of a file, or the record states no spread.
    """
    names = [each.strip() for each in keys.split(",")]
    stated = {f"materials.{name}": entry for name, entry in materials.items()}
    sets: list[dict[str, float]] = []
    for name in names:
        if name not in stated:
            raise unknown("material of the job", name, stated)
        own = [_numbers(name, each) for each in _laws(name, stated[name], folder)]
        for each in own:
            for key in each:
                if key not in numbers:
                    raise unknown("number of the job", key, numbers)
        sets = own if not sets else [{**one, **other} for one, other in zip(sets, own, strict=True)]
    of = _record(names[0], stated[names[0]], folder).spread
    more = f" {_ONE_CURVE}" if of is not None and of.of == SCATTER else ""
    note = f"The spread of {keys} is that of the fit: {of.of if of else ''}.{more}"
    return Alternatives(sets=tuple(sets), label=label or keys, note=note)


def _record(name: str, entry: Any, folder: Path) -> Record:
    """Record of a file that a material of a job names."""
    library = entry.get("library") if isinstance(entry, Mapping) else None
    if not isinstance(library, str):
        raise TurgorError(
            f"{name} states its constants itself; a fitted spread is that of a file of 'turgor fit --output', written "
            f'as {name.split(".")[-1]} = {{ library = "fitted/strip.toml", record = "yeoh" }}.'
        )
    file = str(folder / library) if library.endswith(".toml") else library
    return find_record(file, entry.get("record"))


def _laws(name: str, entry: Any, folder: Path) -> list[Any]:
    """Laws with the constants of each set of a record."""
    record = _record(name, entry, folder)
    if record.spread is None:
        raise TurgorError(
            f"{name}: the record '{record.name}' of '{record.library}' states no spread, because it was not fitted "
            "by turgor or its tests leave a constant open. Name a deviation, or take --records of a library material."
        )
    return [
        law_from_printed(record.law, record.convention, {**each, **record.assumed})
        for each in record.spread.sets(record.constants)
    ]


def _numbers(name: str, law: Any) -> dict[str, float]:
    """Constants of a law by the keys of a job."""
    numbers: dict[str, float] = {}
    for item in fields(law):
        value = getattr(law, item.name)
        several = value if isinstance(value, tuple) else (value,)
        for place, each in enumerate(several, start=1):
            numbers[f"{name}.{item.name}{f'.{place}' if isinstance(value, tuple) else ''}"] = float(each)
    return numbers
