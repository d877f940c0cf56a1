"""Moment: a moment on a reference point."""

from collections.abc import Container
from dataclasses import dataclass
from typing import TYPE_CHECKING

from turgor.core.meshing.mesh import Mesh
from turgor.core.model.history import RAMP, History, checked
from turgor.core.model.loads.images import check_sectors
from turgor.core.model.loads.load import Deck, DeckRows, Load, Turning
from turgor.foundation.errors import TurgorError
from turgor.foundation.given import Quantities, vector


@dataclass(frozen=True, slots=True)
class Moment(Load):
    """Moment on a reference point.

    Parameters
    ----------
    point : str
        Name of the `ReferencePoint`.
    vector : (3,) floats [N m]
        The whole moment, on the whole actuator.
    history : sequence of (float, float), or str, optional
        As that of a `Pressure`.
    follower : bool
        False: its axis stays fixed in space, whatever way the point turns. True: it turns with the point, and is
        stated as it is at rest. Neither kind has a potential where the point turns about changing axes.

    Raises
    ------
    TurgorError
        If the history is none, or the moment is not finite.

    Examples
    --------
    >>> Moment("plate", (0.02, 0, 0)).vector
    (0.02, 0.0, 0.0)
    """

    point: str
    vector: tuple[float, float, float]
    history: History = RAMP
    follower: bool = False

    if TYPE_CHECKING:

        def __init__(self, point: str, vector: Quantities, history: History = RAMP, follower: bool = False) -> None: ...

    def __post_init__(self) -> None:
        object.__setattr__(self, "vector", vector(self.vector, f"moment on '{self.point}'", "moment"))
        object.__setattr__(self, "history", checked(self.history, f"moment on '{self.point}'", starting=True))

    @property
    def words(self) -> str:
        """The vector and the point.

        Examples
        --------
        >>> Moment("plate", (0.02, 0, 0)).words
        'Moment (0.02, 0, 0) N m on plate, its axis fixed in space'
        """
        way = "turning with it" if self.follower else "its axis fixed in space"
        return f"Moment ({', '.join(f'{part:g}' for part in self.vector)}) N m on {self.point}, {way}"

    @property
    def outside(self) -> bool:
        """A moment has no dead forces, hence no share in the work on outside loads."""
        return False

    def mirrored(self, axis: int) -> bool:
        """Whether it acts about the normal of the plane."""
        return not any(self.vector[across] for across in range(3) if across != axis)

    def turned(self, axis: int) -> bool:
        """Whether it acts about the axis."""
        return self.mirrored(axis)

    def check(self, mesh: Mesh, points: Container[str]) -> None:
        """Refuse an unknown point, and a moment that is not the same on all images of a modeled part."""
        check_sectors(mesh, f"moment on '{self.point}': {{:g}} N m", self.vector)
        for plane, (axis, _) in zip(mesh.symmetry_faces, mesh.mirror_planes, strict=True):
            if not self.mirrored(axis):
                raise TurgorError(
                    f"moment on '{self.point}': {self.vector} N m has no mirror image, for only a moment about "
                    f"{'xyz'[axis]} is symmetric to the mirror plane '{plane}'; model the whole actuator "
                    "(symmetric = false)."
                )
        Load.check(self, mesh, points)

    @property
    def turning(self) -> Turning:
        """The moment and its point."""
        return Turning(self.point, self.vector, True, self.follower)

    def deck_rows(self, deck: Deck) -> tuple[DeckRows, ...]:
        """Return the rows of a moment on a reference point."""
        if self.follower:
            raise TurgorError(f"the moment on '{self.point}' follows it; that has no form in .inp files; leave it out.")
        return (DeckRows("*CLOAD", self.history, deck.moment(self.point, self.vector)),)
