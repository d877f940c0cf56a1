"""Tables of the measured actuators, and distances from them."""

import csv
from pathlib import Path

import numpy as np
from fit_data import DATA

__all__ = ["DATA", "distance", "numbers", "table"]


def table(path: Path) -> list[dict[str, str]]:
    """Rows of a table with a header, as text."""
    with path.open(encoding="utf-8") as file:
        return list(csv.DictReader(file))


def numbers(path: Path) -> dict[str, np.ndarray]:
    """Columns of a table of numbers; empty cells are nan."""
    rows = table(path)
    return {name: np.array([float(row[name] or "nan") for row in rows]) for name in rows[0]}


def distance(computed: np.ndarray, measured: np.ndarray) -> float:
    """Root mean square of the difference [-], as a share of the range of the measured values, from zero on."""
    span = max(np.max(measured), 0.0) - min(np.min(measured), 0.0)
    return float(np.sqrt(np.mean((np.asarray(computed) - measured) ** 2)) / span)
