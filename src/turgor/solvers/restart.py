"""Restart: the state and the contacts that a stage takes over from the former one."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from turgor.engine.cells.memory import History, friction_of
from turgor.engine.contact.friction import FrictionHistory
from turgor.engine.contact.terms import Part
from turgor.engine.system import System
from turgor.solvers.pressures import pressures_of
from turgor.solvers.solution import State

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class RestartContact:
    """One part of the contact: its name and sides, its friction history, and its penalty scale."""

    name: str
    sides: NDArray[np.int64]
    friction: FrictionHistory | None
    boost: Array


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Restart:
    """The last state of a stage, and what is known about its contacts.

    Parameters
    ----------
    state : State
    contacts : tuple of RestartContact
        One for each part.
    """

    state: State
    contacts: tuple[RestartContact, ...]

    @staticmethod
    def of(system: System, state: State) -> "Restart":
        """What the next stage takes over from a system in a state."""
        parts = system.contact.parts
        friction = friction_of(state.memory) or (None,) * len(parts)
        pairs = zip(parts, friction, strict=True)
        contacts = [RestartContact(part.name, part.surface.sides, its, part.penalty_scale) for part, its in pairs]
        return Restart(state=state, contacts=tuple(contacts))

    def restore(self, system: System) -> None:
        """Give the penalty scales to the next stage, of the same mesh; its loads may bring other walls together."""
        for part in system.contact.parts:
            known = self._known(part)
            if known is not None:
                part.penalty_scale = known.boost

    def _known(self, part: Part) -> RestartContact | None:
        """What is known about a part of the next stage; None where the former one had no such part."""
        for known in reversed(self.contacts):
            if known.name == part.name and np.array_equal(known.sides, part.surface.sides):
                return known
        return None

    def history(self, system: System) -> History:
        """What the state brings into a sudden step of the next stage, which leaves its stress as it was."""
        memory = self.state.memory
        if memory is None:
            return system.history(None, 0.0)
        known = [self._known(part) for part in system.contact.parts]
        friction = tuple(None if each is None else each.friction for each in known)
        return system.history(replace(memory, friction=friction if any(friction) else ()), 0.0)

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
