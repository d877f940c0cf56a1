"""Wedge: one of n equal sectors of a part about an axis, whose cut faces move alike."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.core.geometry.shapes.tolerances import TOLERANCE
from turgor.foundation.errors import TurgorError

Array = NDArray[np.float64]
Ints = NDArray[np.int64]

#: Names of the two cut faces of a wedge: a turn by its angle, right-handed about its axis, brings LOW onto HIGH.
LOW, HIGH = "cyclic_low", "cyclic_high"

#: Orders of a wedge: a half up to a slice that is still wide enough for cells of a good shape.
LEAST_FOLD, MOST_FOLD = 2, 36


@dataclass(frozen=True, slots=True, kw_only=True)
class Wedge:
    """One of n equal sectors of a part that is the same after each of n turns about an axis.

    The displacement of its higher cut face is that of the lower one, turned: u(high) = R u(low).

    Parameters
    ----------
    axis : str
        ``"x"``, ``"y"`` or ``"z"``.
    fold : int
        Number n of sectors of the whole, 2 to 36.
    center : (3,) tuple [m]
        A point on the axis.

    Raises
    ------
    TurgorError
        If the axis or the number is another one.

    Examples
    --------
    >>> sixth = Wedge(axis="x", fold=6)
    >>> sixth.images(np.array([[1.0, 2.0, 0.0]])).round(4)
    array([[1.    , 1.    , 1.7321]])
    >>> Wedge(axis="x", fold=1)
    Traceback (most recent call last):
    turgor.TurgorError: wedge: fold is 1; allowed is 2 to 36 sectors.
    """

    axis: str
    fold: int
    center: tuple[float, float, float] = (0.0, 0.0, 0.0)

    def __post_init__(self) -> None:
        if self.axis not in ("x", "y", "z"):
            raise TurgorError(f"wedge: axis is {self.axis!r}; allowed are x, y and z.")
        if not LEAST_FOLD <= self.fold <= MOST_FOLD:
            raise TurgorError(f"wedge: fold is {self.fold}; allowed is {LEAST_FOLD} to {MOST_FOLD} sectors.")

    @property
    def number(self) -> int:
        """Number of the axis: 0, 1 or 2."""
        return "xyz".index(self.axis)

    @property
    def across(self) -> tuple[int, int]:
        """Numbers of the two directions across the axis, in right-handed order."""
        return (self.number + 1) % 3, (self.number + 2) % 3

    @property
    def angle(self) -> float:
        """Angle of one sector [rad]."""
        return 2 * np.pi / self.fold

    def turn(self, count: int = 1) -> Array:
        """Rotation (3, 3) by a number of sectors."""
        b, c = self.across
        out = np.eye(3)
        out[b, b] = out[c, c] = np.cos(count * self.angle)
        out[c, b] = np.sin(count * self.angle)
        out[b, c] = -out[c, b]
        return out

    def images(self, points: Array, count: int = 1) -> Array:
        """Places (n, 3) to which a turn by a number of sectors brings points (n, 3)."""
        return np.asarray((points - self.center) @ self.turn(count).T + self.center)

    def radii(self, points: Array) -> Array:
        """Distances (n,) of points (n, 3) from the axis."""
        return np.asarray(np.linalg.norm((points - self.center)[:, list(self.across)], axis=1))

    def mean(self, vector: Array) -> Array:
        """Mean (…, 3) of a vector (…, 3) and of its turned copies: the component along the axis."""
        out = np.zeros_like(vector, dtype=np.float64)
        out[..., self.number] = vector[..., self.number]
        return out

    def partners(self, points: Array, low: Ints, high: Ints) -> Ints:
        """Find the node of the lower face of which each node of the higher face is the image.

        Parameters
        ----------
        points : (n, 3) array [m]
        low, high : (k,) int arrays
            Nodes of both faces; those on the axis are in both.

        Returns
        -------
        (k,) int array
            For each of ``high``.

        Raises
        ------
        TurgorError
            If the nodes of one face are not those of the other one, turned.
        """
        from scipy.spatial import cKDTree  # slow to load, and few parts are wedges

        size = float(np.ptp(points, axis=0).max())
        away, place = cKDTree(self.images(points[low])).query(points[high])
        if (
            len(low) != len(high)
            or away.max(initial=0.0) > TOLERANCE.round_off * size
            or len(np.unique(place)) < len(low)
        ):
            raise TurgorError(
                f"the nodes of '{HIGH}' are not those of '{LOW}', turned by 1/{self.fold} about {self.axis}: "
                f"{len(high)} and {len(low)} nodes, up to {away.max(initial=0.0) * 1e3:.3g} mm apart."
            )
        return np.asarray(low[place])
