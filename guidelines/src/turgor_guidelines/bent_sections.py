"""Sections as benders of a length: one pressure, and the angle that the actuator bends by."""

from collections.abc import Callable, Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

import turgor as tg
from turgor.studies import Computed
from turgor_guidelines.sections import solved_twice
from turgor_guidelines.values import MESH_ERROR

Array = NDArray[np.float64]

#: Pressure of all cavities, or of each by its name [Pa], one value for each state.
Pressures = Sequence[float] | Array | Mapping[str, Sequence[float] | Array]


def bent_section(
    section_of: Callable[[float], tg.Section], size: float, pressure: Pressures, length: float, driven: str = ""
) -> Computed:
    """Solve a section on two meshes, and give the bending angle of so much length of it.

    Parameters
    ----------
    section_of : callable
        Gives the section for a size of cells [m].
    size : float [m]
        Of the finer mesh.
    pressure : sequence of float, or mapping of str to it [Pa]
    length : float [m]
        The angle ``bending_angle`` is the curvature about y times this.
    driven : str
        The cavity whose pressure the column ``pressure`` has, where cavities have different ones.

    Returns
    -------
    Computed
    """
    result = solved_twice(lambda cells: section_of(cells).solve(pressure, throw=False, mesh_error=False), size)
    response = result.response
    columns = []
    for column in response.columns:
        if column.name == f"{driven}_pressure":
            columns.append(tg.experiments.Column("pressure", "kPa", column.values))
        elif not column.name.endswith("_pressure"):
            columns.append(column)
    for end in ("", MESH_ERROR):
        if f"curvature_y{end}" in response:
            columns.append(
                tg.experiments.Column(f"bending_angle{end}", "deg", response.column(f"curvature_y{end}") * length)
            )
    bent = tg.Response(columns=tuple(columns), source=response.source, status=response.status, message=response.message)
    return Computed(response=bent, picture=result.picture)
