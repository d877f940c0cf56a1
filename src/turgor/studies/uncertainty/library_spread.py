"""Spread between laboratories of a rubber of a job: all its constants multiplied by one factor."""

from collections.abc import Mapping
from math import exp

from turgor.core.materials.library.spread import spread_of
from turgor.foundation.errors import TurgorError
from turgor.job.job import Job
from turgor.studies.runs.jobs.job_numbers import JobNumber
from turgor.studies.uncertainty.job_records import record_of
from turgor.studies.uncertainty.spread import Alternatives

#: The spread that the library knows of a rubber.
LIBRARY = "library"

#: Pressures of a material that are no stiffness of its law.
_NO_STIFFNESS = ("bulk_modulus",)


def laboratory_alternatives(keys: str, label: str, job: Job, numbers: Mapping[str, JobNumber]) -> Alternatives:
    """Return the rubber as it is, softer and stiffer by one standard deviation between laboratories.

    Parameters
    ----------
    keys : str
        Keys such as ``"materials.body"``, with commas between those that have one record.
    label : str
        Name in sentences and pictures; by default the keys.
    job : Job
    numbers : mapping of str to JobNumber
        Of the job.

    Returns
    -------
    Alternatives
        Their standard deviation is that of `turgor.core.materials.library.spread.spread_of` at a stretch of 2.

    Raises
    ------
    TurgorError
        If a key is unknown, its material is no rubber of the library, or the materials have different records.
    """
    names = [each.strip() for each in keys.split(",")]
    rubbers = {record_of(name, job) for name in names}
    if len(rubbers) > 1:
        raise TurgorError(f"the materials '{keys}' have different records; name one key each.")
    factor = exp(spread_of(rubbers.pop()[0]).deviation)
    moduli = {
        key: number.value
        for key, number in numbers.items()
        if number.dimension == "pressure"
        and any(key.startswith(f"{name}.") and key.removeprefix(f"{name}.") not in _NO_STIFFNESS for name in names)
    }
    sets = tuple({key: share * value for key, value in moduli.items()} for share in (1.0, 1 / factor, factor))
    return Alternatives(sets=sets, label=label or keys)
