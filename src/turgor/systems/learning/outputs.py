"""Outputs for learning, besides those of control: volumes of the cavities, and coordinates of the modes."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.foundation.errors import TurgorError
from turgor.reduced.states.answer import ReducedState
from turgor.reduced.states.reduced import Reduced
from turgor.systems.control.outputs import Linear

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Volumes:
    """Volume of every pressed cavity of the whole actuator [m³].

    Examples
    --------
    >>> Volumes()
    Volumes()
    """

    def of(self, reduced: Reduced) -> "VolumesOf":
        """Prepare it for a reduced model."""
        if not reduced.faces:
            raise TurgorError("the reduced model has no pressed cavity, so it has no volumes.")
        return VolumesOf(reduced)


@dataclass(frozen=True, slots=True, eq=False)
class VolumesOf:
    """The volumes of one reduced model: exact cubic polynomials of its coordinates.

    Parameters
    ----------
    reduced : Reduced
    unit : str
    """

    reduced: Reduced
    unit: str = "mL"

    @property
    def names(self) -> tuple[str, ...]:
        """``volume_`` and the name of each cavity."""
        return tuple(f"volume_{face}" for face in self.reduced.faces)

    @property
    def size(self) -> float:
        """Largest volume at rest [m³]."""
        reduced = self.reduced
        at_rest = reduced.equations.cubics.at(np.zeros(reduced.equations.sizes[0])).values[: len(reduced.faces)]
        return float(np.abs(at_rest).max() * reduced.scales[0] ** 3 * reduced.model.mesh.symmetry_factor)

    def at(self, state: ReducedState) -> tuple[Array, Array]:
        """Values (m,) [m³] and derivatives (m, n) by the inputs."""
        return np.array(list(state.volumes.values())), np.array(list(state.volume_rates.values()))


@dataclass(frozen=True, slots=True)
class Coordinates:
    """Coordinates of the displacement modes: the whole shape in a dozen numbers.

    ``reduced.modes @ q`` times the length ``reduced.scales[0]`` is the displacement of every node.

    Examples
    --------
    >>> Coordinates()
    Coordinates()
    """

    def of(self, reduced: Reduced) -> Linear:
        """Prepare it for a reduced model."""
        count = reduced.equations.sizes[0]
        return Linear(tuple(f"mode_{k + 1}" for k in range(count)), np.eye(count), reduced.size, unit="")
