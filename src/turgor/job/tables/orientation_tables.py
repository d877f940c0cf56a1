"""The table ``orientation`` of a material with directions, read and written."""

from typing import Any

from turgor.core.materials.library.table_keys import table
from turgor.core.materials.orientation import Orientation
from turgor.units import format_quantity

_KEYS = ("along", "across", "around", "angle")


def read_orientation(values: Any) -> Orientation:
    """Read the directions of a material from a table.

    Parameters
    ----------
    values : mapping
        With ``along``, and ``across`` or ``around``, and perhaps ``angle``; see `Orientation`.

    Examples
    --------
    >>> read_orientation({"along": [1, 0, 0], "across": [0, 1, 0], "angle": "30 deg"}).angle
    0.5235987755982988
    """
    return Orientation(**table(values, "orientation", _KEYS, ("along",)))


def orientation_table(orientation: Orientation) -> dict[str, Any]:
    """Write the directions of a material as a table that reads back to the same.

    Examples
    --------
    >>> orientation_table(Orientation(along=(0, 0, 1), around=(0, 0, 0)))
    {'along': [0.0, 0.0, 1.0], 'around': ['0 mm', '0 mm', '0 mm']}
    """
    values: dict[str, Any] = {"along": list(orientation.along)}
    if orientation.across is not None:
        values["across"] = list(orientation.across)
    if orientation.around is not None:
        values["around"] = [format_quantity(each, "mm") for each in orientation.around]
    if orientation.angle:
        values["angle"] = format_quantity(orientation.angle, "deg")
    return values
