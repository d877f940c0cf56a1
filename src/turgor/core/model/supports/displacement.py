"""Displacement: a face, or a reference point, that is moved."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from turgor.core.meshing.mesh import Mesh
from turgor.core.model.history import RAMP, History, checked, points_of, share_at
from turgor.core.model.loads.load import Deck, DeckRows
from turgor.core.model.places import NodesAt, checked_face, described
from turgor.core.model.supports.support import Array, Support, check_directions
from turgor.foundation.errors import TurgorError
from turgor.foundation.given import Quantities, vector
from turgor.units import format_quantity, mm

#: Displacement of points [m] at a load factor.
Move: TypeAlias = Callable[[Array, float], Array]


@dataclass(frozen=True, slots=True)
class Displacement(Support):
    """Move a face along a prescribed displacement, scaled by the load factor.

    Parameters
    ----------
    face : str or NodesAt
        Name of the face, ``"*"`` for the whole surface of the body, or the name of a `ReferencePoint`. Or an edge, a
        node or the nodes in a box.
    value : callable, or (3,) floats [m]
        ``value(points, load_factor) -> (n, 3) displacement [m]`` of the (n, 3) reference points [m]. Three lengths
        stand for a `Shift` by them.
    directions : str
        Which components are prescribed.
    """

    face: str | NodesAt
    value: Move
    directions: str = "xyz"

    moves = True
    at_places = True

    if TYPE_CHECKING:

        def __init__(self, face: str | NodesAt, value: Move | Quantities, directions: str = "xyz") -> None: ...

    def __post_init__(self) -> None:
        checked_face(self.face, "face of a displacement", "tip")
        value: object = self.value
        if not callable(value):
            object.__setattr__(self, "value", Shift(vector(value, f"displacement of '{self.place}'", "length")))
        check_directions(self.directions, f"displacement of '{self.place}'")

    @property
    def named_faces(self) -> tuple[str, ...]:
        """The face; none where the whole surface is moved."""
        return (self.face,) if isinstance(self.face, str) and self.face != "*" else ()

    @property
    def prescribed(self) -> tuple[str, str]:
        """The face and the directions."""
        return self.place, self.directions

    @property
    def way(self) -> History | None:
        """History of a `Shift`."""
        return self.value.history if isinstance(self.value, Shift) else None

    @property
    def shift(self) -> tuple[float, float, float]:
        """Vector of a `Shift` [m].

        Raises
        ------
        TurgorError
            If a function says where the face moves.
        """
        if not isinstance(self.value, Shift):
            raise TurgorError(f"the displacement of '{self.place}' is a function, which has no form in a file.")
        return self.value.vector

    def check(self, mesh: Mesh) -> None:
        """Refuse a `Shift` of a face out of a mirror plane that it meets, where nothing moves across."""
        if not isinstance(self.value, Shift) or (isinstance(self.face, str) and self.face not in mesh.faces):
            return
        nodes = self.nodes(mesh)
        for plane, (axis, _) in zip(mesh.symmetry_faces, mesh.mirror_planes, strict=True):
            across = "xyz"[axis] in self.directions and self.value.vector[axis]
            if across and np.isin(mesh.face_nodes(plane), nodes).any():
                raise TurgorError(
                    f"the displacement of '{self.place}' along {'xyz'[axis]} is {across / mm:g} mm, but it meets "
                    f"the mirror plane '{plane}', where nothing moves across; model the whole actuator (symmetric = "
                    "false)."
                )

    def displacement(self, points: Array, load_factor: float) -> Array:
        """Return the value."""
        return np.asarray(self.value(points, load_factor), dtype=np.float64)

    def boundary_rows(self, deck: Deck) -> tuple[str, ...]:
        """No row: the steps say where it moves."""
        return ()

    def deck_rows(self, deck: Deck) -> tuple[DeckRows, ...]:
        """Return the rows of a face, place or reference point that goes the same way as a whole."""
        factors = _turns(self.value)
        if factors is None or self.face == "*":
            raise TurgorError(f"the displacement of '{self.place}' is a function, which has no form in .inp files.")
        way = [(s, self.displacement(np.zeros((1, 3)), s)[0]) for s in factors]
        rows = []
        for axis in sorted("xyz".index(letter) for letter in self.directions):
            peak = max((float(value[axis]) for _, value in way), key=abs)
            history = tuple((s, float(value[axis]) / (peak or 1.0)) for s, value in way)
            rows.append(DeckRows("*BOUNDARY", history, deck.displaced(self.face, axis, peak)))
        return tuple(rows)

    def job_text(self) -> dict[str, object]:
        """Return the table of a `Shift`."""
        moved: dict[str, object] = {
            "displacement": [format_quantity(part, "mm") for part in self.shift],
            "directions": self.directions,
        }
        if self.way is not None and self.way != RAMP:
            moved["history"] = self.way if isinstance(self.way, str) else [list(point) for point in self.way]
        return moved if isinstance(self.face, str) else self.face.table() | moved

    def text(self) -> str:
        """Return the sentence of a report."""
        what = "The whole surface" if self.face == "*" else described(self.face)
        return f"{what} moved in {', '.join(self.directions)}."

    def continued(self, factor: float, new: "Displacement | None") -> "Displacement":
        """Return the displacement of the next stage: it stays where it is, or follows a new one from there."""
        return replace(self, value=ContinuedMove(self, factor, new))


@dataclass(frozen=True, slots=True)
class Shift:
    """The value of a `Displacement` by which the whole face goes the same way.

    Parameters
    ----------
    vector : (3,) floats [m]
        How far it is from where it was at first, at a share of one.
    history : sequence of (float, float), or str, optional
        As that of a `Pressure`: the share of the displacement; the load factor by default.

    Examples
    --------
    >>> Shift((0, 0, 2e-3))(np.zeros((1, 3)), 0.5)
    array([[0.   , 0.   , 0.001]])
    """

    vector: tuple[float, float, float]
    history: History = RAMP

    if TYPE_CHECKING:

        def __init__(self, vector: Quantities, history: History = RAMP) -> None: ...

    def __post_init__(self) -> None:
        object.__setattr__(self, "vector", vector(self.vector, "displacement", "length"))
        object.__setattr__(self, "history", checked(self.history, "displacement"))

    def __call__(self, points: Array, load_factor: float) -> Array:
        """Displacement (n, 3) [m] of points at a load factor."""
        share = share_at(self.history, load_factor)
        return np.tile(share * np.array(self.vector, dtype=np.float64), (len(points), 1))


@dataclass(frozen=True, slots=True, eq=False)
class ContinuedMove:
    """A move that stays where an old one ended, or follows a new one from there.

    A class and not a function, so that a file can hold it.

    Parameters
    ----------
    old : Support
    factor : float
        Load factor at which the old move ended.
    new : Displacement or None
    """

    old: Support
    factor: float
    new: Displacement | None

    def __call__(self, points: Array, load_factor: float) -> Array:
        """Displacement [m] of points at a load factor."""
        old = np.asarray(self.old.displacement(points, self.factor))
        if self.new is None:
            return old
        there, begun = self.new.value(points, load_factor), self.new.value(points, 0.0)
        return np.asarray(there) + (1 - load_factor) * (old - begun)


def _turns(value: Move) -> tuple[float, ...] | None:
    """Load factors between which a `Shift`, or what goes on from one, moves evenly; None of other functions."""
    if isinstance(value, Shift):
        return tuple(s for s, _ in points_of(value.history))
    if isinstance(value, ContinuedMove):
        return (0.0, 1.0) if value.new is None else _turns(value.new.value)
    return None
