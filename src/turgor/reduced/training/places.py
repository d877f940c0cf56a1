"""Places of obstacles, as they follow from the inputs of a reduced model."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.system import System
from turgor.core.model.model import Model
from turgor.core.model.obstacles import Obstacle
from turgor.foundation.errors import TurgorError
from turgor.reduced.states.inputs import Inputs

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class Place:
    """Scaled translation of an obstacle from where the model has it: ``origin + by_inputs @ inputs``.

    Parameters
    ----------
    origin : (3,) array
    by_inputs : (3, 1 + n) array
        The share of the loads that are no inputs first; an obstacle with a path moves with it.
    """

    origin: Array
    by_inputs: Array

    def at(self, inputs: Array) -> Array:
        """Translation (3,) at inputs (1 + n,)."""
        return np.asarray(self.origin + self.by_inputs @ inputs)


def places_of(system: System, model_at: Callable[[Mapping[str, float]], Model], inputs: Inputs) -> dict[str, Place]:
    """Find how the obstacles of a model translate with its inputs, by their names."""
    low, middle = inputs.low, 0.5 * (inputs.low + inputs.high)

    def points(values: Array) -> Array:
        model = model_at(dict(zip(inputs.keys, values.tolist(), strict=True)))
        return np.array([_point(each) for each in model.contact.obstacles]).reshape(-1, 3)

    base, moved = points(middle), np.zeros((len(middle), *points(middle).shape))
    for k in np.flatnonzero(inputs.places):
        values = middle.copy()
        values[k] = low[k]
        moved[k] = (base - points(values)) / (middle[k] - low[k])
    obstacles = system.model.contact.obstacles
    here = np.array([_point(each) for each in obstacles]).reshape(-1, 3)
    origin = (base - here - np.einsum("k,koi->oi", middle, moved)) / system.length
    return {
        each.name: Place(origin[o], np.column_stack([_way(each), moved[:, o].T]) / system.length)
        for o, each in enumerate(obstacles)
    }


def _point(obstacle: Obstacle) -> tuple[float, float, float]:
    """The point that says where a shape is; nothing where it has none."""
    point = getattr(obstacle.shape, "point", getattr(obstacle.shape, "center", None))
    return (0.0, 0.0, 0.0) if point is None else point


def _way(obstacle: Obstacle) -> Array:
    """How far the path of an obstacle moves it [m]; it must be straight and even, as the loads rise."""
    if obstacle.rotation:
        raise TurgorError(f"obstacle '{obstacle.name}' has a rotation; in reduced models obstacles do not turn.")
    way = obstacle.displacement(1.0)
    for factor, place in obstacle.path:
        if np.abs(np.array(place) - factor * way).max() > 1e-9 * max(np.abs(way).max(), 1e-300):
            raise TurgorError(
                f"obstacle '{obstacle.name}' has a path that is not straight from its place at load factor 0 to the "
                "end; reduced models need that, or an input such as "
                f"'obstacles.{obstacle.name}.point.3' instead of the path."
            )
    return way
