"""Measure: a number that can be read off a state, with its name, unit and definition."""

from collections.abc import Callable, Collection, Iterator, Sequence
from dataclasses import dataclass
from types import ModuleType

import numpy as np
from numpy.typing import NDArray

from turgor.core.geometry.names import cavity_names
from turgor.core.results.fields.state_fields import StateFields
from turgor.core.solvers.solution import State
from turgor.foundation.errors import TurgorError
from turgor.foundation.response import COLUMN_UNITS, Column


@dataclass(frozen=True, slots=True, kw_only=True)
class Measure:
    """A number that can be read off a state.

    Parameters
    ----------
    name : str
        Name of the column it fills.
    unit : str
        Unit the column is shown and written in, one of `COLUMN_UNITS`; empty for a pure number.
    function : callable
        ``function(at) -> float [SI]``, where ``at`` is a `StateFields`: the state, its mesh, its fields.
    definition : str
        What it is, in one line, for reports.
    unwrap : bool
        Whether it is an angle known up to full turns, to be continued along the path.
    faces : tuple of str
        Faces without which it has no value; ``"cavity"`` stands for any cavity.
    along : callable or None
        ``along(path) -> (n,) array [SI]`` for a sum over a path, such as work: its value at every state of a sequence
        of `StateFields`. One state alone has no such number then, and ``function`` is not called.
    local : bool
        Whether it is a stress or a stretch at points, whose mesh error falls more slowly than that of displacements and
        volumes as cells get smaller.
    moving : bool
        Whether it needs a motion, so that paths of equilibria have no such number.

    Examples
    --------
    >>> def rise(at):
    ...     return at.displacement[:, 2].max()
    >>> Measure(name="rise", unit="mm", function=rise, definition="largest displacement along z").text(0.0021)
    '2.1 mm'
    """

    name: str
    unit: str
    function: Callable[[StateFields], float]
    definition: str
    unwrap: bool = False
    faces: tuple[str, ...] = ()
    along: Callable[[Sequence[StateFields]], NDArray[np.float64]] | None = None
    local: bool = False
    moving: bool = False

    def __post_init__(self) -> None:
        Column(self.name, self.unit, np.empty(0))  # its checks are the checks of a column

    def __call__(self, state: State | StateFields) -> float:
        """Return the measure of one state in SI units; an angle lies within half a turn."""
        if self.along is not None:
            raise TurgorError(f"measure '{self.name}' is a sum along a path; read it with tg.measure(solution, ...).")
        at = state if isinstance(state, StateFields) else StateFields(state)
        return float(self.read([at])[0])

    def read(self, path: Sequence[StateFields]) -> NDArray[np.float64]:
        """Return the measure of every state of a path in SI units, (n,)."""
        try:
            if self.along is not None:
                return self.along(path)
            return np.array([float(self.function(at)) for at in path])
        except TurgorError as error:
            raise TurgorError(f"measure '{self.name}': {error}") from None

    def fits(self, faces: Collection[str]) -> bool:
        """Whether a part with these faces has a value of the measure."""
        return all(face in faces or (face == "cavity" and bool(cavity_names(faces))) for face in self.faces)

    def text(self, value: float) -> str:
        """Write a value for a person, such as ``"85.3 deg"``."""
        return f"{value / COLUMN_UNITS[self.unit]:.4g} {self.unit}".rstrip()


def measures_of(module: ModuleType) -> Iterator[tuple[str, Measure]]:
    """List the measures that a file holds, by their names.

    Parameters
    ----------
    module : module

    Yields
    ------
    (str, Measure)
    """
    for value in vars(module).values():
        if isinstance(value, Measure):
            yield value.name, value
