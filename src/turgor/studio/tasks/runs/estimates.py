"""Estimates: the answer of the cross-section, in a second or two where an actuator has a uniform one."""

from pathlib import Path
from typing import Any

import numpy as np

from turgor.foundation.errors import TurgorError

#: States of an estimate: enough for a curve, few enough for a second.
ROWS = 4

#: What is shown of a section, where it changes.
SHOWN = ("curvature_y", "curvature_z", "twist", "stretch", "cavity_ballooning", "outside_ballooning")


def estimate(file: Path) -> dict[str, Any]:
    """Return what the cross-section of a job says; a reason where it has none.

    Parameters
    ----------
    file : Path
        A job file.
    """
    from turgor.job.read import read_job
    from turgor.job.section import section_of, solve_section

    try:
        job = read_job(file)
        response = solve_section(job, section_of(job), ROWS).response
    except TurgorError as error:
        return {"columns": [], "reason": error.on_command_line}
    drive = response.columns[0].name
    names = [drive, *(name for name in SHOWN if name in response and np.ptp(response[name]) > 0)]
    columns = []
    for column in map(response.find, names):
        error = response.mesh_error(column.name)
        scale = column.values / np.where(column.in_unit == 0, 1.0, column.in_unit)
        shown = None if error is None else (error / np.where(scale == 0, 1.0, scale)).tolist()
        columns.append(
            {"name": column.name, "unit": column.unit, "values": column.in_unit.tolist(), "error": shown}
        )  # fmt: skip
    return {"columns": columns, "reason": response.message}
