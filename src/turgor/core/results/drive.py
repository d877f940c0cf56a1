"""Drive: the columns of a response for what drove the actuator, such as pressure or volume."""

import numpy as np

from turgor.core.solvers.procedures.listed import prescribed_columns
from turgor.core.solvers.solution import Solution
from turgor.foundation.response import Column, Response


def pressures_in(response: Response) -> tuple[Column, ...]:
    """Return the columns of the pressures: ``pressure``, or ``cavity_1_pressure`` and the like where they differ.

    Parameters
    ----------
    response : Response

    Returns
    -------
    tuple of Column

    Examples
    --------
    >>> from turgor.foundation.source import Source
    >>> columns = (Column("load_factor", "", [0, 1]), Column("cavity_1_pressure", "kPa", [0, 2e4]))
    >>> [column.name for column in pressures_in(Response(columns=columns, source=Source(text="a gauge")))]
    ['cavity_1_pressure']
    """
    return tuple(
        c
        for c in response.columns
        if c.unit == "kPa" and f"_{c.name}".endswith("_pressure") and not c.name.endswith("contact_pressure")
    )


def drive_of(response: Response) -> str:
    """Return the name of the column that others are shown against.

    The time, if there is one; the stage in a sequence; what was prescribed, such as a volume or an amount of
    gas, because the pressure may fall then; the pressure, if there is one; else the first column.

    Parameters
    ----------
    response : Response

    Returns
    -------
    str
    """
    known = ("time", "stage", *prescribed_columns(), "pressure")
    return next((name for name in known if name in response.names), response.names[0])


def stage_column(solution: Solution) -> tuple[Column, ...]:
    """Return the column ``stage`` of a sequence: how many stages are finished, and the load factor of the next one.

    Parameters
    ----------
    solution : Solution

    Returns
    -------
    tuple of Column
        Empty where there are no stages.
    """
    if not solution.procedure.stages:
        return ()
    finished = {stage.name: number for number, stage in enumerate(solution.procedure.stages)}
    progress = np.array([finished[each.stage] + each.load_factor for each in solution.states])
    return (Column("stage", "", np.round(progress, 12)),)


def face_of(column: Column) -> str:
    """Return the name of the face that a column of pressures or volumes belongs to.

    Parameters
    ----------
    column : Column

    Returns
    -------
    str

    Examples
    --------
    >>> face_of(Column("cavity_1_pressure", "kPa", [0.0]))
    'cavity_1'
    """
    return column.name.rpartition("_")[0]
