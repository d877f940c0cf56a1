"""Response table: the values of a response as text, for reports and notebooks."""

from typing import Any

import numpy as np

from turgor.response import Column, Response
from turgor.results.report.error_text import with_error

#: Rows that a page shows at most; the file has all.
ROWS = 13


def response_table(response: Response) -> dict[str, Any]:
    """Return labels and rows of a response as text, thinned out evenly where there are many.

    Parameters
    ----------
    response : Response

    Returns
    -------
    dict
        ``labels`` and ``rows``, and how many rows there are (``count``) and are not shown (``left_out``).
    """
    count = len(response)
    rows = shown_rows(count)
    columns = [
        list(response.stages) if column.name == "stage" and response.stages else _written(response, column)
        for column in response.quantities
    ]
    return {
        "labels": [column.label for column in response.quantities],
        "rows": [[column[row] for column in columns] for row in rows],
        "left_out": count - len(rows),
        "count": count,
    }


def shown_rows(count: int) -> list[int]:
    """Choose which of some rows a short table shows: evenly spaced ones with the first and the last.

    Examples
    --------
    >>> shown_rows(4), len(shown_rows(1000))
    ([0, 1, 2, 3], 13)
    """
    step = max(1, -(-(count - 1) // (ROWS - 1)))
    return [*range(0, count - 1, step), count - 1]


def _written(response: Response, column: Column) -> list[str]:
    """Values of a column in its unit, with mesh errors where they are known.

    A value without one has as many decimals as give the largest five digits, four at most.
    """
    largest = max((abs(v) for v in column.in_unit.tolist() if abs(v) < float("inf")), default=0.0)
    before = len(str(int(largest)))
    decimals = min(4, max(0, 5 - before))
    errors = response.mesh_error(column.name)
    known = errors if errors is not None else np.full(len(response), np.nan)
    return [
        with_error(value, error, column.unit).removesuffix(column.unit).rstrip()
        if error > 0
        else f"{shown:.{decimals}f}"
        for value, shown, error in zip(column.values.tolist(), column.in_unit.tolist(), known.tolist(), strict=True)
    ]
