"""Restart: the state and the contacts that a stage takes over from the former one."""

import hashlib
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.cells.internal_variables import History, friction_of
from turgor.core.engine.contact.friction import FrictionHistory
from turgor.core.engine.contact.terms import Part
from turgor.core.engine.system import System
from turgor.core.solvers.checkpoints.checkpoint_data import PathSoFar
from turgor.core.solvers.pressures import pressures_of
from turgor.core.solvers.solution import State

Array = NDArray[np.float64]


#: Name of a part of the contact, hash of its sides, and how many parts with the same ones stand before it: walls that
#: meet each other and those that meet the mirror plane have the same. Files of a run hold them, so they are text.
Key = tuple[str, str, int]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Restart:
    """The last state of a stage, and what is known about its contacts.

    Parameters
    ----------
    state : State
    friction : mapping of Key to FrictionHistory
        Of each part of the contact with friction.
    penalty_scales : mapping of Key to array
        Of each part of the contact.
    path : PathSoFar or None
        The path up to the state, where its procedure goes on with it on other cells; None where a stage begins.
    """

    state: State
    friction: Mapping[Key, FrictionHistory]
    penalty_scales: Mapping[Key, Array]
    path: PathSoFar | None = None

    @staticmethod
    def of(system: System, state: State) -> "Restart":
        """Make the restart of the next stage from a system in a state."""
        parts = system.contact.parts
        keys = _keys(parts)
        friction = friction_of(state.memory) or (None,) * len(parts)
        return Restart(
            state=state,
            friction={key: its for key, its in zip(keys, friction, strict=True) if its is not None},
            penalty_scales={key: part.penalty_scale for key, part in zip(keys, parts, strict=True)},
        )

    def restore(self, system: System) -> None:
        """Give the penalty scales to the next stage, of the same mesh; its loads may bring other walls together."""
        for key, part in zip(_keys(system.contact.parts), system.contact.parts, strict=True):
            part.penalty_scale = self.penalty_scales.get(key, part.penalty_scale)

    def history(self, system: System) -> History:
        """Memory that the state brings into a sudden step of the next stage, which leaves its stress as it was."""
        memory = self.state.memory
        if memory is None:
            return system.history(None, 0.0)
        friction = tuple(self.friction.get(key) for key in _keys(system.contact.parts))
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
    return np.concatenate([system.unknowns(state.displacement, state.mean_stress, state.points), *springs])


def _keys(parts: Sequence[Part]) -> list[Key]:
    """Keys by which the next stage finds the parts of a contact again."""
    before: Counter[tuple[str, str]] = Counter()
    keys = []
    for part in parts:
        same = (part.name, hashlib.sha256(part.surface.sides.tobytes()).hexdigest())
        keys.append((*same, before[same]))
        before[same] += 1
    return keys
