"""Slide: a face, or a place, that is moved along one direction, which need not be x, y or z, and is free across it."""

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, cast

import numpy as np

from turgor.core.meshing.mesh import Mesh
from turgor.core.model.history import RAMP, History, checked, share_at, with_history
from turgor.core.model.places import NodesAt, described
from turgor.core.model.supports.roller import Roller
from turgor.core.model.supports.support import Array, Ints, Support
from turgor.foundation.errors import TurgorError
from turgor.foundation.given import Quantities, number
from turgor.units import format_quantity, mm


@dataclass(frozen=True, slots=True)
class Slide(Support):
    """Move a face by a distance along one direction, in proportion to the load factor. Across it the face is free.

    `Displacement` moves along x, y and z, `Roller` holds along any direction.

    Parameters
    ----------
    face : str or NodesAt
        Name of the face. Or an edge, a node or the nodes in a box.
    along : (3,) floats
        The direction, of any length but zero.
    distance : float [m]
        How far it is moved.
    history : sequence of (float, float), or str, optional
        As that of a `Pressure`: the share of the distance; the load factor by default.

    Raises
    ------
    TurgorError
        If the direction is zero, or the distance is no number.

    Examples
    --------
    >>> Slide("ramp", (1, 0, 1), 2e-3).text()
    'ramp is moved by 2 mm along (1, 0, 1).'
    """

    face: str | NodesAt
    along: tuple[float, float, float]
    distance: float
    history: History = RAMP

    moves = True
    at_places = True

    if TYPE_CHECKING:

        def __init__(
            self, face: str | NodesAt, along: Quantities, distance: float, history: History = RAMP
        ) -> None: ...

    def __post_init__(self) -> None:
        along = self._roller().along
        assert along is not None
        object.__setattr__(self, "along", along)
        object.__setattr__(
            self, "distance", number(self.distance, f"distance of the slide of '{self.place}'", "length")
        )
        object.__setattr__(self, "history", checked(self.history, f"slide of '{self.place}'"))

    def _roller(self) -> Roller:
        return Roller(self.face, self.along)

    @property
    def way(self) -> History | None:
        """The history."""
        return self.history

    def text(self) -> str:
        """Return the sentence of a report."""
        along = ", ".join(f"{part:g}" for part in self.along)
        return f"{described(self.face)} is moved by {self.distance / mm:g} mm along ({along})."

    def check(self, mesh: Mesh) -> None:
        """Refuse parts of a body of revolution and sectors."""
        self._roller().check(mesh)

    def normals(self, mesh: Mesh) -> tuple[Ints, Array]:
        """Return its nodes with one direction."""
        return self._roller().normals(mesh)

    def displacement(self, points: Array, load_factor: float) -> Array:
        """Return the move along the direction; the components across it do not count."""
        along = np.array(self.along) / np.linalg.norm(self.along)
        return np.tile(share_at(self.history, load_factor) * self.distance * along, (len(points), 1))

    def continued(self, factor: float, new: object) -> "Slide":
        """Return the slide of the next stage: it stays where it is."""
        there = replace(self, distance=share_at(self.history, factor) * self.distance, history=RAMP)
        return cast("Slide", with_history(there, ((0.0, 1.0), (1.0, 1.0))))

    def job_text(self) -> dict[str, object]:
        """Return the table of a slide that grows with the load factor."""
        if self.history != RAMP:
            raise TurgorError(f"the slide of '{self.place}' has a history, which has no form in a job file.")
        whole = self.displacement(np.zeros((1, 3)), 1.0)[0]
        stated: dict[str, object] = {
            "directions": list(self.along),
            "displacement": [format_quantity(float(part), "mm") for part in whole],
        }
        return stated if isinstance(self.face, str) else self.face.table() | stated
