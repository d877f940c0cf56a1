"""Records of the rubbers of a job as alternatives."""

from collections.abc import Sequence
from dataclasses import replace

from turgor.core.materials.library.record_files import all_records
from turgor.core.materials.library.records import material_of
from turgor.core.model.sheets import Sheet
from turgor.foundation.errors import TurgorError, unknown
from turgor.job.job import Job
from turgor.studies.uncertainty.cases import library_alternatives
from turgor.studies.uncertainty.spread import Alternatives, Input


def read_records(keys: str, label: str, job: Job, *, leave_out_doubtful: bool = False) -> Alternatives:
    """Return the records of the rubber of a job as alternatives, for keys such as ``"materials.body"``.

    Parameters
    ----------
    keys : str
        Keys of materials, with commas between those that have one record. The record of the job is the nominal one.
    label : str
        Name in sentences and pictures.
    job : Job
    leave_out_doubtful : bool
        Whether records with a caveat are left out.

    Returns
    -------
    Alternatives

    Raises
    ------
    TurgorError
        If a key is unknown, its material is not from the library, or its rubber has one record only.
    """
    names = [each.strip() for each in keys.split(",")]
    rubbers = {record_of(name, job) for name in names}
    if len(rubbers) > 1:
        raise TurgorError(f"the materials '{keys}' have different records; name one key each.")
    library, record = rubbers.pop()
    alternatives = library_alternatives(
        ",".join(names), library, nominal=record, leave_out_doubtful=leave_out_doubtful, label=label
    )
    sets = tuple({name: f"{library}/{value}" for name, value in each.items()} for each in alternatives.sets)
    return replace(alternatives, sets=sets)


def check_records(inputs: Sequence[Input]) -> None:
    """Raise an error if a constant of a material has a spread besides the records of this material.

    Parameters
    ----------
    inputs : sequence of Spread or Alternatives
    """
    names = [name for each in inputs for name in (each.sets[0] if isinstance(each, Alternatives) else (each.name,))]
    single = [key for name in names for key in name.split(",")]
    wholes = [key for each in inputs if isinstance(each, Alternatives) and each.names
              for name in each.sets[0] for key in name.split(",")]  # fmt: skip
    for key in single:
        for whole in wholes:
            if key.startswith(f"{whole}.") or single.count(whole) > 1:
                raise TurgorError(f"'{key}' has two spreads, its own and that of the records of {whole}; give it one.")


def record_of(key: str, job: Job) -> tuple[str, str]:
    """Return the names of rubber and record of a material of a job, for a key such as ``"materials.body"``."""
    known = {f"materials.{name}": entry for name, entry in job.materials.items()}
    if key not in known:
        raise unknown("material of the job", key, known)
    entry = known[key]
    material = entry.material if isinstance(entry, Sheet) else entry
    for record in all_records():
        try:
            same = material_of(record)
        except TurgorError:
            continue  # no law can have its constants
        if same.law == material.law and same.source == material.source:
            return record.library, record.name
    raise TurgorError(
        f"{key}: '{material.name}' is no record of the library. Write it in the job as "
        f'{key.split(".")[-1]} = {{ library = "...", record = "..." }}, or give sets of constants.'
    )
