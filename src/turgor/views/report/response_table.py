"""Response table: the values of a response as text, for reports and notebooks."""

from typing import Any

import numpy as np

from turgor.core.results.drive import drive_of, pressures_in
from turgor.core.results.error_text import is_zero, with_error
from turgor.foundation.display import MOST_ENTRIES, MOST_ROWS
from turgor.foundation.response import Column, Response


def response_table(response: Response) -> dict[str, Any]:
    """Return labels and rows of a response as text, thinned out evenly where there are many.

    The load factor is left out where something else drives, and so are columns that are zero throughout.

    Parameters
    ----------
    response : Response

    Returns
    -------
    dict
        ``labels`` and ``rows``, the labels of the columns that are zero throughout (``zeros``), and how many rows there
        are (``count``) and are not shown (``left_out``).
    """
    count = len(response)
    rows = shown_rows(count)
    drives = {drive_of(response), *(column.name for column in pressures_in(response))}
    shown = [c for c in response.quantities if c.name in drives or (c.name != "load_factor" and not is_zero(c))]
    columns = [
        list(response.stages) if column.name == "stage" and response.stages else _written(response, column)
        for column in shown
    ]
    return {
        "labels": [column.label for column in shown],
        "rows": [[column[row] for column in columns] for row in rows],
        "zeros": [c.words for c in response.quantities if c not in shown and c.name != "load_factor"],
        "left_out": count - len(rows),
        "count": count,
    }


def parted(table: dict[str, Any], most: int = MOST_ENTRIES) -> list[dict[str, Any]]:
    """Part a table with many columns into tables below each other, each with the first column.

    Parameters
    ----------
    table : dict
        With ``labels`` and ``rows``.
    most : int
        Columns of each part.

    Examples
    --------
    >>> parts = parted({"labels": list("pabcd"), "rows": [list("12345")]}, most=3)
    >>> [part["labels"] for part in parts], parts[1]["rows"]
    ([['p', 'a', 'b'], ['p', 'c', 'd']], [['1', '4', '5']])
    """
    others = range(1, len(table["labels"]))
    number = max(1, -(-len(others) // (most - 1)))
    each = max(1, -(-len(others) // number))
    parts = [[0, *others[start : start + each]] for start in range(0, max(1, len(others)), each)]
    return [
        {"labels": [table["labels"][k] for k in part], "rows": [[row[k] for k in part] for row in table["rows"]]}
        for part in parts
    ]


def shown_rows(count: int) -> list[int]:
    """Choose which of some rows a short table shows: evenly spaced ones with the first and the last.

    Examples
    --------
    >>> shown_rows(4), len(shown_rows(1000))
    ([0, 1, 2, 3], 20)
    """
    step = max(1, -(-(count - 1) // (MOST_ROWS - 1)))
    return [*range(0, count - 1, step), count - 1]


def _written(response: Response, column: Column) -> list[str]:
    """Values of a column in its unit, with mesh errors where they are known.

    A value without one has as many decimals as give the largest four digits, four decimals at most.
    """
    largest = max((abs(v) for v in column.in_unit.tolist() if abs(v) < float("inf")), default=0.0)
    decimals = 4 if largest < 1 else min(3, max(0, 4 - len(str(int(largest)))))
    errors = response.mesh_error(column.name)
    known = errors if errors is not None else np.full(len(response), np.nan)
    return [
        with_error(value, error, column.unit).removesuffix(column.unit).rstrip()
        if error > 0
        else _plain(shown, decimals)
        for value, shown, error in zip(column.values.tolist(), column.in_unit.tolist(), known.tolist(), strict=True)
    ]


def _plain(value: float, decimals: int) -> str:
    return "0" if value == 0 else f"{value:.{decimals}f}".replace("-", "−").replace("nan", "–")
