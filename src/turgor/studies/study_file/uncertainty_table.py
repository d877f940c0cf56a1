"""``[uncertainty]`` of a study file: how the spreads of its factors, and sets of constants, are propagated."""

from collections.abc import Mapping
from functools import partial
from pathlib import Path
from typing import Any

from pydantic import Field

from turgor.foundation.errors import TurgorError
from turgor.job.text.problems import Problems
from turgor.job.text.quantities import Table, read_table
from turgor.studies.runs.jobs.job_numbers import read_number
from turgor.studies.study_file.job_base import JobBase
from turgor.studies.uncertainty.fitted_spread import FITTED, fitted_alternatives
from turgor.studies.uncertainty.job_records import check_records, read_records
from turgor.studies.uncertainty.job_spreads import PRESSURE, read_set, read_spread
from turgor.studies.uncertainty.job_uncertainty import UncertaintyPlan
from turgor.studies.uncertainty.library_spread import LIBRARY, laboratory_alternatives
from turgor.studies.uncertainty.spread import Input

#: The table of an uncertainty analysis.
UNCERTAINTY = ("uncertainty",)


class UncertaintyTable(Table):
    """``[uncertainty]``: how spreads are propagated to the response.

    Keys
    ----
    method : str
        ``"linear"``, ``"quadratic"`` or ``"interactions"``.
    at : str
        Pressure at which values are reported, such as ``"40 kPa"``.
    mesh_error : bool
        Whether the mesh error of the nominal run is estimated.
    sets : table
        CSV files of constants that belong together by their labels, a line for each specimen or record.
    records : table
        Labels by the keys of materials, such as ``{ "materials.body" = "rubber" }``: all records of the rubber in the
        library, each with a run of its own.
    leave_out_doubtful : bool
        Whether records with a caveat are left out.
    """

    method: str = "linear"
    at: str | None = None
    mesh_error: bool = True
    sets: dict[str, str] = Field(default_factory=dict)
    records: dict[str, str] = Field(default_factory=dict)
    leave_out_doubtful: bool = False


def read_uncertainty(
    given: Any, factors: Mapping[tuple[str, ...], Any], base: JobBase, folder: Path, problems: Problems
) -> UncertaintyPlan | None:
    """Read ``[uncertainty]``.

    Parameters
    ----------
    given : mapping
        The table.
    factors : mapping of tuple of str to value
        ``[factors]`` by the parts of their keys; those with a ``spread`` count.
    base : JobBase
    folder : Path
        Where relative paths begin.
    problems : Problems

    Returns
    -------
    UncertaintyPlan or None
        None if there is any problem.
    """
    table: UncertaintyTable | None = read_table(UncertaintyTable, given, UNCERTAINTY, problems)
    if table is None:
        return None
    entries: list[Input | None] = []
    for place, value in factors.items():
        if isinstance(value, Mapping) and "spread" in value:
            entries.append(problems.attempt(("factors", *place), partial(_spread, ".".join(place), value, base)))
    for label, file in table.sets.items():
        entries.append(
            problems.attempt((*UNCERTAINTY, "sets", label), partial(read_set, label, folder / file, base.numbers))
        )
    for keys, label in table.records.items():
        listed = partial(read_records, keys, label, base.job, leave_out_doubtful=table.leave_out_doubtful)
        entries.append(problems.attempt((*UNCERTAINTY, "records"), listed))
    at = None
    if table.at is not None:
        at = problems.attempt(UNCERTAINTY, partial(read_number, table.at, PRESSURE, "at"))
    inputs = tuple(each for each in entries if each is not None)
    problems.attempt((*UNCERTAINTY, "records"), partial(check_records, inputs))
    if problems.entries:
        return None
    return UncertaintyPlan(inputs=inputs, method=table.method, at=at, mesh_error=table.mesh_error)


def _spread(key: str, given: Mapping[str, Any], base: JobBase) -> Input:
    if given["spread"] == LIBRARY:
        return laboratory_alternatives(key, str(given.get("label", "")), base.job, base.numbers)
    if given["spread"] == FITTED:
        label = str(given.get("label", ""))
        return fitted_alternatives(key, label, base.stated_materials, base.file.parent, base.numbers)
    if not isinstance(given["spread"], str):
        raise TurgorError(f'spread is {given["spread"]!r}; write a text with its unit, such as "0.1 mm".')
    if key.removeprefix("materials.") in base.stated_materials:
        raise TurgorError(
            f"'{key}' is a whole material, and its spread is '{given['spread']}'; write {LIBRARY}, for the spread "
            f"between laboratories, or {FITTED}, for that of a fit. A deviation belongs to one constant, such as "
            f"{key}.C10."
        )
    name, number = (key, PRESSURE) if key == PRESSURE.key else base.number(key)
    return read_spread(name, given["spread"], number, str(given.get("label", "")))
