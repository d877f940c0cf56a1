"""History table: what a reduced model answers along a history, as columns with units."""

import numpy as np

from turgor.foundation.response import Column, Response
from turgor.foundation.source import Source
from turgor.reduced.states.following import Followed
from turgor.reduced.states.reduced import Reduced

#: Column of the estimated errors.
ESTIMATE = "estimated_error"


def input_columns(reduced: Reduced) -> tuple[str, ...]:
    """Return the names of the columns of the inputs, in order, such as ``loads_pressure``."""
    return tuple(key.replace(".", "_") for key in reduced.inputs.keys)


def further_columns(reduced: Reduced) -> tuple[str, ...]:
    """Return the names of all columns of a history but time and tip."""
    return (*input_columns(reduced), *(f"volume_{face}" for face in reduced.faces), ESTIMATE)


def history_table(reduced: Reduced, followed: Followed) -> Response:
    """Return times, inputs, tip, volumes and estimated errors of a history as columns."""
    answers = followed.answers
    columns = [Column("time", "s", followed.times)]
    for place, (name, unit) in enumerate(zip(input_columns(reduced), reduced.inputs.units, strict=True)):
        columns.append(Column(name, unit, np.array([each.inputs[place] for each in answers])))
    if reduced.tip.any():
        columns += [Column(f"tip_{axis}", "mm", followed.tip[:, k]) for k, axis in enumerate("xyz")]
    for face in reduced.faces:
        columns.append(Column(f"volume_{face}", "mL", np.array([each.volumes[face] for each in answers])))
    columns.append(Column(ESTIMATE, "", np.array([each.estimate for each in answers])))
    return Response(columns=tuple(columns), source=Source(text="a reduced model along a history"))
