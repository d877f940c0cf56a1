"""Records of the rubbers of a job as alternatives."""

from collections.abc import Iterable, Sequence
from dataclasses import replace

from turgor.core.materials.library.record_files import all_records
from turgor.core.materials.library.records import material_of
from turgor.core.model.sheets import Sheet
from turgor.foundation.errors import TurgorError, unknown
from turgor.job.job import Job
from turgor.studies.uncertainty.cases import library_alternatives
from turgor.studies.uncertainty.spread import Alternatives, Input


def read_records(
    texts: Iterable[str], job: Job, others: Sequence[Input], *, leave_out_doubtful: bool = False
) -> list[Input]:
    """Add the records of the rubbers of a job to other inputs, for keys such as ``"materials.body"``.

    Parameters
    ----------
    texts : iterable of str
        Keys of materials, with commas between those that have one record; then ``as LABEL``. The record of the job
        is the nominal one.
    job : Job
    others : sequence of Spread or Alternatives
        Other inputs, which must not vary a constant of these materials.
    leave_out_doubtful : bool
        Whether records with a doubt are left out.

    Returns
    -------
    list of Spread or Alternatives

    Raises
    ------
    TurgorError
        If a key is unknown, its material is not from the library, its rubber has one record only, or a constant has a
        spread too.
    """
    found: list[Input] = [*others]
    for text in texts:
        keys, _, label = (part.strip() for part in text.partition(" as "))
        names = [each.strip() for each in keys.split(",")]
        rubbers = {_record_of(name, job) for name in names}
        if len(rubbers) > 1:
            raise TurgorError(f"--records is '{keys}': the materials have different records; name one key each.")
        library, record = rubbers.pop()
        found_here = library_alternatives(
            ",".join(names), library, nominal=record, leave_out_doubtful=leave_out_doubtful, label=label
        )
        sets = tuple({name: f"{library}/{value}" for name, value in each.items()} for each in found_here.sets)
        found.append(replace(found_here, sets=sets))
    _check(found)
    return found


def _check(inputs: Sequence[Input]) -> None:
    """Raise an error if a constant of a material has a spread beside the records of this material."""
    names = [name for each in inputs for name in (each.sets[0] if isinstance(each, Alternatives) else (each.name,))]
    single = [key for name in names for key in name.split(",")]
    wholes = [key for each in inputs if isinstance(each, Alternatives) and each.names
              for name in each.sets[0] for key in name.split(",")]  # fmt: skip
    for key in single:
        for whole in wholes:
            if key.startswith(f"{whole}.") or single.count(whole) > 1:
                raise TurgorError(f"'{key}' has two spreads, its own and --records {whole}; give it one.")


def _record_of(key: str, job: Job) -> tuple[str, str]:
    """Rubber and record of a material of a job."""
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
        f"--records {key}: '{material.name}' is no record of the library. Write it in the job as "
        f'{key.split(".")[-1]} = {{ library = "...", record = "..." }}, or give constants of your own with --sets.'
    )
