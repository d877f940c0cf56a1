"""Forces: the contact force on an obstacle as what is to follow a target."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.foundation.errors import TurgorError, unknown
from turgor.reduced.parts.obstacles import Obstructing, Shaped
from turgor.reduced.states.answer import ReducedState
from turgor.reduced.states.reduced import Reduced
from turgor.systems.control.outputs import OutputOf, length_of
from turgor.systems.control.settings import CONTROL

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class ContactForce:
    """Contact force [N] of the whole actuator on an obstacle: the size of the vector.

    Parameters
    ----------
    obstacle : str, optional
        Its name; the only obstacle by default.

    Examples
    --------
    >>> ContactForce("plate")
    ContactForce(obstacle='plate')
    """

    obstacle: str | None = None

    def of(self, reduced: Reduced) -> "ForceOf":
        """Prepare it for a reduced model."""
        parts = {part.name: part for part in reduced.equations.obstacles}
        if not parts:
            raise TurgorError("the reduced model has no obstacle; the model needs contact with one.")
        if self.obstacle is None and len(parts) > 1:
            raise TurgorError(f"the reduced model has the obstacles {', '.join(parts)}; name one of them.")
        name = next(iter(parts)) if self.obstacle is None else self.obstacle
        if name not in parts:
            raise unknown("obstacle", name, parts)
        if not parts[name].largest > 0:
            raise TurgorError(f"nothing touched '{name}' in training; train to larger loads.")
        return ForceOf(parts[name], (f"force_{name}",), parts[name].largest, length_of(reduced))


@dataclass(frozen=True, slots=True, eq=False)
class ForceOf:
    """The force on an obstacle of one reduced model.

    Parameters
    ----------
    part : Obstructing
    names : tuple of str
    size : float [N]
        Largest force in training.
    length : float [m]
        Of the actuator.
    unit : str
    """

    part: Obstructing
    names: tuple[str, ...]
    size: float
    length: float
    unit: str = "N"

    def at(self, state: ReducedState) -> tuple[Array, Array]:
        """Value (1,) [N] and derivatives (1, n) by the inputs; both vanish where nothing touches."""
        inputs = np.concatenate([[1.0], state.inputs])
        rates = np.column_stack([np.zeros(len(state.q)), state.rates[: len(state.q)]])
        at = self.part.at(state.q, inputs)
        force = at.force()
        size = float(np.linalg.norm(force))
        if not size:
            return np.zeros(1), np.zeros((1, len(state.inputs)))
        return np.array([size]), (force / size @ at.force_rates(rates)[:, 1:])[None]

    def continued(self, state: ReducedState) -> tuple[Array, Array]:
        """As `at`; where nothing touches, minus the smallest gap as a force, so that a search finds the obstacle."""
        value, slopes = self.at(state)
        body = self.part.body
        if value[0] > 0 or not isinstance(body, Shaped):
            return value, slopes
        y = np.concatenate([state.q, self.part.origin + self.part.place @ np.concatenate([[1.0], state.inputs])])
        gap, normal, _ = body.shape.signed_distance(body.rest + (body.modes.reshape(-1, len(y)) @ y).reshape(-1, 3))
        near = int(gap.argmin())
        by_y = normal[near] @ body.modes[near]
        by_inputs = by_y[:-3] @ state.rates[: len(state.q)] + by_y[-3:] @ self.part.place[:, 1:]
        stiffness = CONTROL.approach * self.size * state.reduced.scales[0] / self.length
        return np.array([-stiffness * gap[near]]), -stiffness * by_inputs[None]


def continued(output: OutputOf, state: ReducedState) -> tuple[Array, Array]:
    """Values (m,) of an output and derivatives (m, n), continued smoothly to where a force is flat, for a search."""
    return output.continued(state) if isinstance(output, ForceOf) else output.at(state)
