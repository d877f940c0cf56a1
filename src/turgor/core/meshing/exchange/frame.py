"""Frame: the unit and the axes of a file, and the way from there to meters and the axes of this package."""

from dataclasses import dataclass

import numpy as np

from turgor.core.geometry.directions import FileAxes, rotation_to
from turgor.core.meshing.exchange.formats.raw import Array
from turgor.units import length_unit


@dataclass(frozen=True, slots=True, kw_only=True)
class Frame:
    """How coordinates of a file are to be read.

    Parameters
    ----------
    unit : str or float
        Unit of length: a key of the lengths in `turgor.units.UNITS`, or its length in meters.
    axes : tuple of three str or (3,) floats
        Direction in the file of our x (from the fixed end to the tip), y (across) and z (up), such as
        ``("-x", "z", "y")``; three numbers where a direction is none of those. They must be right-handed, or the part
        would be mirrored.

    Examples
    --------
    >>> Frame(unit="cm", axes=("z", "x", "y")).meters(np.array([[1.0, 2.0, 3.0]])).tolist()
    [[0.03, 0.01, 0.02]]
    """

    unit: str | float = "mm"
    axes: FileAxes = ("x", "y", "z")

    def __post_init__(self) -> None:
        length_unit(self.unit)  # refuses what is none
        rotation_to(self.axes)

    @property
    def scale(self) -> float:
        """Length of one unit [m]."""
        return length_unit(self.unit)

    def meters(self, points: Array) -> Array:
        """Bring points (n, 3) of the file into meters and our axes."""
        return np.asarray(points @ rotation_to(self.axes).T * self.scale)
