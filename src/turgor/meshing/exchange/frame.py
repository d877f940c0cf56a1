"""Frame: the unit and the axes of a file, and the way from there to meters and the axes of this package."""

from dataclasses import dataclass

import numpy as np

from turgor.errors import TurgorError
from turgor.meshing.exchange.formats.raw import Array
from turgor.units import length_unit


@dataclass(frozen=True, slots=True, kw_only=True)
class Frame:
    """How coordinates of a file are to be read.

    Parameters
    ----------
    unit : str or float
        Unit of length: a key of the lengths in `turgor.units.UNITS`, or its length in meters.
    axes : (str, str, str)
        Direction in the file of our x (from the fixed end to the tip), y (across) and z (up), such as
        ``("-x", "z", "y")``. They must be right-handed, or the part would be mirrored.

    Examples
    --------
    >>> Frame(unit="cm", axes=("z", "x", "y")).meters(np.array([[1.0, 2.0, 3.0]])).tolist()
    [[0.03, 0.01, 0.02]]
    """

    unit: str | float = "mm"
    axes: tuple[str, str, str] = ("x", "y", "z")

    def __post_init__(self) -> None:
        length_unit(self.unit)  # refuses what is none
        if len(self.axes) != 3 or {str(axis).lstrip("+-") for axis in self.axes} != {"x", "y", "z"}:
            raise TurgorError(f"axes are {self.axes!r}; name x, y and z of the file once each, such as '-x', 'z', 'y'.")
        if np.linalg.det(self._rotation) < 0:
            raise TurgorError(f"axes {', '.join(self.axes)} are left-handed and would mirror the part; turn one sign.")

    @property
    def scale(self) -> float:
        """Length of one unit [m]."""
        return length_unit(self.unit)

    @property
    def _rotation(self) -> Array:
        rows = np.zeros((3, 3))
        for row, axis in zip(rows, self.axes, strict=True):
            row["xyz".index(axis[-1])] = -1.0 if axis.startswith("-") else 1.0
        return rows

    def meters(self, points: Array) -> Array:
        """Bring points (n, 3) of the file into meters and our axes."""
        return np.asarray(points @ self._rotation.T * self.scale)
