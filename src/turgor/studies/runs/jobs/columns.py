"""Columns that the response of a job will have, known before anything is computed."""

from collections.abc import Mapping, Sequence

from turgor.core.geometry.names import measured_faces
from turgor.core.results.measures.energies import ENERGIES
from turgor.core.results.measures.field_measures import BY_REGION, as_column
from turgor.core.results.measures.measures import MEASURES, find_measure
from turgor.core.solvers.procedures.listed import prescribed_columns
from turgor.foundation.errors import TurgorError, unknown
from turgor.job.job import Job, standard_measures

#: What may drive a path besides what procedures prescribe in cavities, with the units of the columns.
DRIVES: Mapping[str, str] = {"load_factor": "", "stage": "", "time": "s", "pressure": "kPa"}

#: Measures that each region or cavity has by itself too, and how the names of these end.
PARTS = {"cavity_volume": "_volume", **{each.name: each.name for each in BY_REGION}}

#: Measures of contact and of setups that the standard measures bring along, and the ends of those that bear a name.
OF_CONTACT = (
    "blocked_force", "bearing_distance", "pull_distance", "grip_force", "holding_force", "contact_area",
    "maximum_contact_pressure", "deepest_penetration",
)  # fmt: skip


def unit_of_column(job: Job, name: str, measures: Sequence[str] = ()) -> str:
    """Return the unit of a column that responses of a job will have.

    Parameters
    ----------
    job : Job
        Its dimensions may vary, but not its cavities and regions.
    name : str
        What drives the job, such as ``"pressure"``, or a measure.
    measures : sequence of str
        What is measured; by default what the job requests.

    Returns
    -------
    str
        One of `turgor.foundation.response.COLUMN_UNITS`.

    Raises
    ------
    TurgorError
        If there will be no such column, with the near match.
    """
    given = [find_measure(each) for each in measures] or list(job.output.chosen())
    known = {**_drives(job), **{each.name: each.unit for each in given}}
    if name in known:
        return known[name]
    part_of = next((each for each in given if each.name in PARTS and name.endswith(PARTS[each.name])), None)
    if part_of is not None:
        return part_of.unit
    faces = measured_faces(job.geometry().faces, job.geometry().cavities)
    if not measures and job.output.measures in (standard_measures(), standard_measures(faces)) and _comes(job, name):
        return find_measure(name).unit
    if name in MEASURES:
        raise TurgorError(f"'{name}' is not measured; add it to the measures.")
    raise unknown("column", name, known)


def _drives(job: Job) -> dict[str, str]:
    """Names and units of what drives a job; which of several pressures are equal may vary."""
    cavities = [as_column(each) for each in job.geometry().cavities]
    units = {**DRIVES, **prescribed_columns()}
    if len(cavities) > 1:
        for cavity in cavities:
            units[f"{cavity}_pressure"] = "kPa"
            units |= {f"{name}_{cavity}": unit for name, unit in prescribed_columns().items()}
    return units | (dict.fromkeys(ENERGIES, "mJ") if all(each.has_energies for each in job.procedure.parts()) else {})


def _comes(job: Job, name: str) -> bool:
    """Whether a column of contact, of a setup or of a reference point comes with the standard measures."""
    return name in OF_CONTACT or name.startswith(("blocked_force_", *job.points)) or name.endswith("_force")
