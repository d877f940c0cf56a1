"""Estimates: an answer within seconds, of a part of the actuator: its cross-section, or two of its chambers."""

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from turgor.foundation.errors import TurgorError

if TYPE_CHECKING:
    from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
    from turgor.foundation.response import Response
    from turgor.job.job import Job

#: States of an estimate: enough for a curve, few enough for a second.
ROWS = 4

#: What is shown of a section, where it changes.
SHOWN = ("curvature_y", "curvature_z", "twist", "stretch", "cavity_ballooning", "outside_ballooning")

#: Curvatures [1/m] and stretches that change by less do not change.
ROUND_OFF = 1e-9

#: Steps of the load: few, for a curve of a few points.
FIRST, LONGEST = 0.2, 0.5

#: Fewest chambers of a finger for which two of them save time.
FEWEST = 4


def estimate(file: Path) -> dict[str, Any]:
    """Return what a part of the actuator of a job says, and of which part; a reason where there is none.

    Parameters
    ----------
    file : Path
        A job file.
    """
    from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
    from turgor.job.read import read_job

    try:
        job = read_job(file)
        if isinstance(job.actuator, FastPneuNet) and job.actuator.chambers >= FEWEST:
            response = _of_two_chambers(file, job.actuator)
            return {"columns": _columns(response), "part": "two of its chambers", "reason": ""}
        response = _of_section(job)
    except TurgorError as error:
        return {"columns": [], "part": "", "reason": error.on_command_line}
    return {"columns": _columns(response), "part": "its cross-section, far from the ends", "reason": response.message}


def _of_section(job: "Job") -> "Response":
    from turgor.job.section import section_of, solve_section

    response = solve_section(job, section_of(job), ROWS).response
    drive = response.columns[0].name
    names = [drive, *(name for name in SHOWN if name in response and np.ptp(response[name]) > ROUND_OFF)]
    return replace(response, columns=tuple(map(response.find, names)))


def _of_two_chambers(file: Path, finger: "FastPneuNet") -> "Response":
    """Bending of a finger with two chambers for each gap, times the gaps: every gap bends alike.

    For the demo finger with 11 chambers, both of draft tetrahedra, it is 6 to 10 % more than that of the whole one up
    to 18 kPa.
    """
    from turgor.core.results.measures.measures import find_measure, measure
    from turgor.core.solvers.solve import solve
    from turgor.foundation.registry import name_in
    from turgor.foundation.response import Column
    from turgor.job.prepare import prepare
    from turgor.job.read import read_job
    from turgor.job.tables.procedures import PROCEDURES
    from turgor.job.text.overrides import parse_changes
    from turgor.studio.tasks.runs.checks import coarse_of

    count = finger.chambers
    length = f"{2e3 * finger.length / count:.9g} mm"
    changes = parse_changes(coarse_of(file)) | {"actuator.chambers": 2, "actuator.length": length}
    if name_in(PROCEDURES, read_job(file).procedure) == "static":
        changes |= {"procedure.first_step": FIRST, "procedure.max_step": LONGEST}
    short = read_job(file, changes)
    solution = solve(prepare(short)[0], short.procedure, throw=False, progress=False)
    response = measure(solution, find_measure("bending_angle"))
    angle = response.find("bending_angle")
    drive = next(each for each in response.columns if each.name in ("pressure", "load_factor"))
    drive = response.find("pressure") if "pressure" in response else drive
    return replace(response, columns=(drive, Column(angle.name, angle.unit, (count - 1) * angle.values)))


def _columns(response: "Response") -> list[dict[str, Any]]:
    """Columns as the page reads them, in their units."""
    from turgor.foundation.response import COLUMN_UNITS, MESH_ERROR

    columns = []
    for column in response.columns:
        if column.name.endswith(MESH_ERROR):
            continue
        error = response.mesh_error(column.name)
        scale = COLUMN_UNITS[column.unit]
        shown = None if error is None else (error / scale).tolist()
        columns.append(
            {"name": column.name, "unit": column.unit, "values": column.in_unit.tolist(), "error": shown}
        )  # fmt: skip
    return columns
