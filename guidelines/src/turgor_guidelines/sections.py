"""Sections in studies: solved with two sizes of cells, so that their columns have a mesh error too."""

from collections.abc import Callable

import turgor as tg
from turgor.studies import Computed
from turgor_guidelines.pictures import outline_of
from turgor_guidelines.values import MESH_ERROR

#: How much larger the cells of the second solve are.
COARSER = 2.0


def solved_twice(solve: Callable[[float], tg.sections.SectionSolution], size: float) -> Computed:
    """Solve a section with cells of a size and with cells twice as large.

    Parameters
    ----------
    solve : callable
        Solves the section with cells of a size [m]; a path that ends early is no error.
    size : float [m]
        Longest edge of the cells.

    Returns
    -------
    Computed
        The values of the smaller cells, the difference of both as mesh error, and the outline as picture.

    Raises
    ------
    TurgorError
        If one of them has no state.
    """
    fine, coarse = solve(size), solve(COARSER * size)
    return Computed(response=compared(fine.response, coarse.response), picture=outline_of(fine))


def compared(fine: tg.Response, coarse: tg.Response) -> tg.Response:
    """Put the differences from a coarser response next to each column, as mesh errors.

    Parameters
    ----------
    fine, coarse : Response
        Of the same columns and drive, one row for each load.

    Returns
    -------
    Response
        As many rows as both have; columns without any difference get no mesh error.

    Raises
    ------
    TurgorError
        If one of them has no rows.

    Examples
    --------
    >>> import numpy as np
    >>> import turgor as tg
    >>> def response(*values):
    ...     twist = tg.experiments.Column("twist", "1/m", np.array(values))
    ...     return tg.Response(columns=(twist,), source=tg.laws.Source(text="cells"))
    >>> print(compared(response(1.0, 2.0), response(1.1, 1.8)).mesh_error("twist").round(3))
    [0.1 0.2]
    """
    rows = min(len(fine), len(coarse))
    if not rows:
        raise tg.TurgorError(f"the section has no state: {fine.message or coarse.message}")
    columns: list[tg.experiments.Column] = []
    for column, other in zip(fine.columns, coarse.columns, strict=True):
        error = abs(column.values[:rows] - other.values[:rows])
        columns.append(tg.experiments.Column(column.name, column.unit, column.values[:rows]))
        if error.any():
            columns.append(tg.experiments.Column(column.name + MESH_ERROR, column.unit, error))
    ended = fine if len(fine) == rows else coarse
    return tg.Response(columns=tuple(columns), source=fine.source, status=ended.status, message=ended.message)
