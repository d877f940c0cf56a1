"""Restart: the state and the history of contact that a stage takes over from the former one."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.engine.cells.memory import History
from turgor.engine.contact.friction import FrictionHistory
from turgor.engine.system import System
from turgor.solvers.pressures import pressures_of
from turgor.solvers.solution import State

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class RestartContact:
    """One contact: its name and sides, its friction history, and its penalty scale."""

    name: str
    sides: NDArray[np.int64]
    anchors: FrictionHistory | None
    boost: Array


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Restart:
    """The last state of a stage, and the history that is not part of it.

    Parameters
    ----------
    state : State
    contacts : tuple of RestartContact
        What its contacts know.
    """

    state: State
    contacts: tuple[RestartContact, ...]

    @staticmethod
    def of(system: System, state: State) -> "Restart":
        """What the next stage takes over from a system in a state."""
        return Restart(
            state=state,
            contacts=tuple(
                RestartContact(part.name, part.surface.sides, part.friction_history, part.penalty_scale)
                for part in system.contact.parts
            ),
        )

    def restore(self, system: System) -> None:
        """Give what contacts know to the next stage, of the same mesh; its loads may bring other walls together."""
        for part in system.contact.parts:
            for known in self.contacts:
                if known.name == part.name and np.array_equal(known.sides, part.surface.sides):
                    part.friction_history, part.penalty_scale = known.anchors, known.boost

    def history(self, system: System) -> History:
        """What the rubber brings into a sudden step, which leaves the stress of the state as it was."""
        return system.history(self.state.memory, 0.0)

    def pressures(self, system: System) -> Array:
        """Scaled pressures (k,) of the controlled faces."""
        acting = pressures_of(self.state)
        return np.array([acting.get(name, 0.0) for name in system.controlled]) / system.stress_scale


def unknowns_of(system: System, state: State | None) -> Array:
    """Scaled unknowns (size,) of a state, sprung obstacles included; zeros at rest."""
    if state is None:
        return np.zeros(system.size)
    places = {name: touch.place for name, touch in state.touches.items()}
    obstacles = {obstacle.name: obstacle for obstacle in system.model.contact.obstacles}
    springs = [
        (places[name] - obstacles[name].displacement(0.0)) / system.length for name in system.contact.bodies.names
    ]
    return np.concatenate([system.unknowns(state.displacement, state.mean_stress), *springs])
