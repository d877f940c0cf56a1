"""Whole: the maps of the modeled part, such as a half or a sector, onto all parts of the whole actuator."""

from collections.abc import Iterable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from turgor.core.geometry.wedge import Wedge

Array = NDArray[np.float64]


class Image(NamedTuple):
    """A map of the modeled part onto a part of the whole: x → center + turn (x − center); ``flips`` if it mirrors."""

    turn: Array
    center: Array
    flips: bool

    def of(self, points: Array) -> Array:
        """Images (…, 3) of points (…, 3) [m]."""
        return np.asarray((points - self.center) @ self.turn.T + self.center)

    @property
    def matrix(self) -> list[float]:
        """Its matrix (4 × 4, row by row), as browsers take it."""
        out = np.eye(4)
        out[:3, :3] = self.turn
        out[:3, 3] = self.center - self.turn @ self.center
        return [round(float(value), 12) for value in out.ravel()]


#: The map of the modeled part onto itself.
ITSELF = Image(np.eye(3), np.zeros(3), False)


class MirrorPlane(NamedTuple):
    """A plane on which a half or quarter model is cut: ``points[:, axis] == position`` [m]."""

    axis: int
    position: float

    def image(self) -> Image:
        """The map onto the other side."""
        flip, at = np.eye(3), np.zeros(3)
        flip[self.axis, self.axis], at[self.axis] = -1.0, self.position
        return Image(flip, at, True)


def images_of(mirrors: Iterable[MirrorPlane], wedge: Wedge | None) -> tuple[Image, ...]:
    """Return the maps of a modeled part onto all parts of the whole, itself first.

    Examples
    --------
    >>> len(images_of([MirrorPlane(1, 0.0), MirrorPlane(2, 0.0)], None)), len(images_of([], Wedge(axis="x", fold=6)))
    (4, 6)
    """
    images = [ITSELF]
    for plane in map(MirrorPlane.image, mirrors):  # each moves along one axis of its own
        images += [Image(plane.turn @ each.turn, each.center + plane.center, not each.flips) for each in images]
    if wedge is not None:
        center = np.array(wedge.center)
        images += [Image(wedge.turn(k), center, False) for k in range(1, wedge.fold)]
    return tuple(images)
