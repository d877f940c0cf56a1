"""Boxes in a job file: planes along the axes, as many as are stated."""

from math import inf, isfinite

from turgor.job.text.quantities import Coordinate, Table
from turgor.units import format_quantity

#: Lowest and highest corner of a box [m].
Corners = tuple[tuple[float, float, float], tuple[float, float, float]]


class BoxTable(Table):
    """``[fibers.NAME.within]``: planes that threads do not cross, as many as are stated.

    Keys
    ----
    x_from, y_from, z_from : float [m]
        Lowest coordinate of the threads; no limit by default.
    x_to, y_to, z_to : float [m]
        Highest coordinate of the threads; no limit by default.
    """

    x_from: Coordinate = -inf
    x_to: Coordinate = inf
    y_from: Coordinate = -inf
    y_to: Coordinate = inf
    z_from: Coordinate = -inf
    z_to: Coordinate = inf

    @property
    def corners(self) -> Corners:
        """Its lowest and its highest corner."""
        return (self.x_from, self.y_from, self.z_from), (self.x_to, self.y_to, self.z_to)


def box_table(corners: Corners) -> dict[str, str]:
    """Write a box as a table of a job file; `BoxTable.corners` gives the same corners back.

    Parameters
    ----------
    corners : two points (3,) [m]
    """
    return {
        f"{axis}_{end}": format_quantity(place, "mm")
        for end, corner in zip(("from", "to"), corners, strict=True)
        for axis, place in zip("xyz", corner, strict=True)
        if isfinite(place)
    }
