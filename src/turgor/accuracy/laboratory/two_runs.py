"""Two runs side by side: in which keys their jobs differ, and by how much every column that both have."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from turgor.accuracy.laboratory.compare import Comparison, compare
from turgor.core.results.error_text import is_zero
from turgor.foundation.errors import TurgorError
from turgor.foundation.response import Column, Response

#: Sections of a lock file that say nothing about the actuator.
_LEFT_OUT = ("written_by", "output", "engine", "name")


@dataclass(frozen=True, slots=True, kw_only=True)
class RunDifference:
    """One column of two runs.

    Parameters
    ----------
    name, unit : str
    first, second : float [SI]
        At the largest drive that both have.
    rms : float [SI]
        Root of the mean square of the differences.
    relative : float [-]
        Over the range of the second run; infinite where this is zero.
    """

    name: str
    unit: str
    first: float
    second: float
    rms: float
    relative: float

    def cells(self) -> tuple[str, ...]:
        """Return the cells of a row of a table."""
        first, second, rms = Column(self.name, self.unit, np.array([self.first, self.second, self.rms])).in_unit
        named = f"{self.name} [{self.unit}]" if self.unit else self.name
        share = f"{self.relative:.1%}" if np.isfinite(self.relative) else "–"
        return named, f"{first:.4g}", f"{second:.4g}", f"{rms:.2g}", share


def differing_keys(first: Mapping[str, Any], second: Mapping[str, Any]) -> tuple[tuple[str, str, str], ...]:
    """Return the keys in which two jobs differ, with both values.

    Parameters
    ----------
    first, second : mapping
        Contents of lock files.

    Returns
    -------
    tuple of (str, str, str)
        A value that one of them lacks is a dash.

    Examples
    --------
    >>> differing_keys({"name": "a", "mesh": {"size": "2 mm"}}, {"name": "b", "mesh": {"size": "1 mm", "cells": "x"}})
    (('mesh.size', '2 mm', '1 mm'), ('mesh.cells', '–', 'x'))
    """
    one, other = dict(_flat(first)), dict(_flat(second))
    named = [key for key in dict.fromkeys((*one, *other)) if ".source." not in key]
    keys = [key for key in named if one.get(key) != other.get(key)]
    return tuple((key, _shown(one.get(key)), _shown(other.get(key))) for key in keys)


def differences(first: Response, second: Response, comparison: Comparison) -> tuple[RunDifference, ...]:
    """Return by how much all columns of two runs differ that both have; those that are zero in both are left out.

    Parameters
    ----------
    first, second : Response
    comparison : Comparison
        Of one column; it says what drives.
    """
    others = {column.name: column for column in second.columns}
    rows = []
    for column in first.quantities:
        name = column.name
        if name not in others or name in (comparison.x, "load_factor", "time", "stage"):
            continue
        if is_zero(column) and is_zero(others[name]):
            continue
        try:
            each = compare(first, second, name, x=comparison.x)
        except TurgorError:
            continue  # fewer than two rows of both are known
        last = int(np.argmax(each.rows[:, 0]))
        rows.append(
            RunDifference(
                name=name,
                unit=column.unit,
                first=float(each.rows[last, 2]),
                second=float(each.rows[last, 1]),
                rms=each.rms,
                relative=each.relative,
            )
        )
    return tuple(rows)


def _flat(table: Mapping[str, Any], above: tuple[str, ...] = ()) -> Iterator[tuple[str, Any]]:
    for name, value in table.items():
        if not above and name in _LEFT_OUT:
            continue
        if isinstance(value, Mapping):
            yield from _flat(value, (*above, name))
        else:
            yield ".".join((*above, name)), value


def _shown(value: Any) -> str:
    return "–" if value is None else str(value)
