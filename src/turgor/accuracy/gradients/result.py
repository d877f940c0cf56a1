"""Gradient: derivatives of measures by numbers, with their units, as a value, a table and a file."""

import csv
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from turgor.foundation.errors import unknown
from turgor.foundation.response import COLUMN_UNITS, Column, unit_text
from turgor.foundation.store.atomic_files import whole

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Gradient:
    """Derivatives of measures by the numbers of a model, at one state.

    ``gradient["bending_angle", "wall"]`` is one of them, ``gradient["bending_angle"]`` all of a measure, in SI units.

    Parameters
    ----------
    measures : tuple of Column
        Each measure with its value at the state.
    numbers : tuple of Column
        Each number with its value; the name of a key has dots, ``keys`` holds it.
    keys : tuple of str
        What each number is called.
    values : (m, n) array [SI]
        Derivative of each measure by each number.
    load_factor : float
        That of the state.
    way : str
        ``"direct"`` or ``"adjoint"``.
    solves : int
        Solutions with the factors of the tangent.
    seconds : float [s]
        Wall time.
    residual : float
        Largest share of the forces of a change that the rates leave unbalanced, an estimate of the relative error.
    """

    measures: tuple[Column, ...]
    numbers: tuple[Column, ...]
    keys: tuple[str, ...]
    values: Array
    load_factor: float
    way: str
    solves: int
    seconds: float
    residual: float

    def __getitem__(self, key: str | tuple[str, str]) -> float | Array:
        """Return the derivatives of a measure, or that by one number [SI]."""
        if isinstance(key, str):
            return np.array(self.values[self._row(key)])
        return float(self.values[self._row(key[0]), self._column(key[1])])

    def by(self, measure: str) -> dict[str, float]:
        """Return the derivatives of a measure by the name of each number [SI].

        Parameters
        ----------
        measure : str

        Returns
        -------
        dict of str to float
        """
        return dict(zip(self.keys, self.values[self._row(measure)].tolist(), strict=True))

    def value(self, measure: str) -> float:
        """Return the value of a measure at the state [SI].

        Parameters
        ----------
        measure : str

        Returns
        -------
        float
        """
        return float(self.measures[self._row(measure)].values[0])

    def relative(self, measure: str) -> dict[str, float]:
        """Return by how much a measure changes where each number grows by 1 % of its size [SI].

        Parameters
        ----------
        measure : str

        Returns
        -------
        dict of str to float
        """
        grown = [0.01 * abs(float(each.values[0])) for each in self.numbers]
        slopes = self.values[self._row(measure)]
        return {key: float(slope * size) for key, slope, size in zip(self.keys, slopes, grown, strict=True)}

    def table(self) -> str:
        """Return a table for a person: how much each measure changes where a number grows by 1 %.

        Returns
        -------
        str
        """
        heads = ["number", "value", *(f"{each.words} per 1 %" for each in self.measures)]
        changes = [self.relative(each.name) for each in self.measures]
        rows = [heads]
        for key, number in zip(self.keys, self.numbers, strict=True):
            parts = [_shown(change[key], each.unit) for change, each in zip(changes, self.measures, strict=True)]
            rows.append([key, _shown(float(number.values[0]), number.unit), *parts])
        widths = [max(len(row[k]) for row in rows) for k in range(len(heads))]
        return "\n".join(
            "  ".join(text.ljust(width) for text, width in zip(row, widths, strict=True)).rstrip() for row in rows
        )

    def __repr__(self) -> str:
        values = ", ".join(f"{each.name} {_shown(float(each.values[0]), each.unit)}" for each in self.measures)
        return f"Gradient at load factor {self.load_factor:.4g} ({values}):\n{self.table()}"

    def to_csv(self, file: str | Path) -> Path:
        """Write a row for each number: its key, value and unit, and the derivative of each measure per unit of both.

        Parameters
        ----------
        file : str or Path

        Returns
        -------
        Path
        """
        path = Path(file)
        with whole(path) as part, part.open("w", newline="", encoding="utf-8") as stream:
            writer = csv.writer(stream)
            writer.writerow(["number", "value", "unit", *(f"d_{each.header}" for each in self.measures)])
            for place, (key, number) in enumerate(zip(self.keys, self.numbers, strict=True)):
                factor = COLUMN_UNITS[number.unit]
                slopes = [
                    repr(float(self.values[row, place] * factor / COLUMN_UNITS[each.unit]))
                    for row, each in enumerate(self.measures)
                ]
                writer.writerow([key, repr(float(number.in_unit[0])), number.unit, *slopes])
        return path

    def _row(self, measure: str) -> int:
        names = [each.name for each in self.measures]
        if measure not in names:
            raise unknown("measure of the gradient", measure, names)
        return names.index(measure)

    def _column(self, key: str) -> int:
        if key not in self.keys:
            raise unknown("number of the gradient", key, self.keys)
        return self.keys.index(key)


def numbers_in(values: Mapping[str, float], units: Mapping[str, str]) -> tuple[Column, ...]:
    """Return numbers as columns of one row.

    Parameters
    ----------
    values : mapping of str to float [SI]
    units : mapping of str to str

    Returns
    -------
    tuple of Column
    """
    return tuple(
        Column(f"number_{place}", units.get(name, ""), np.array([value]))
        for place, (name, value) in enumerate(values.items(), start=1)
    )


def _shown(value: float, unit: str) -> str:
    return f"{value / COLUMN_UNITS[unit]:.4g} {unit_text(unit)}".rstrip()
