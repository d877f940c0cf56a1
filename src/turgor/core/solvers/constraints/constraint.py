"""Constraints: scalar unknowns besides the displacements, and as many conditions that determine them.

The scalars are the pressures of cavities or the load factor, the conditions are volumes, amounts of gas or an arc
length. Both may depend on a parameter that orders the states of the path. Load control has neither.
"""

from dataclasses import dataclass, field, replace
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.algebra.additions import Addition
from turgor.core.engine.cells.internal_variables import History, Memory
from turgor.core.engine.contact.friction import Friction
from turgor.core.engine.contact.part import SearchMode
from turgor.core.engine.contact.terms import Contacts
from turgor.core.engine.system import Evaluation, System
from turgor.core.solvers.constraints.clock import Clock
from turgor.core.solvers.constraints.elimination import Conditions

Array = NDArray[np.float64]

#: Step by which changes along the parameter are measured; what depends on it is straight or nearly so.
NUDGE = 1e-6


class ScalarUnknowns(Protocol):
    """Scalar unknowns besides the displacements and mean stresses."""

    @property
    def system(self) -> System:
        """The equations of equilibrium."""

    def load_factor(self, parameter: float, scalars: Array) -> float:
        """Share of the other loads."""

    def pressures(self, scalars: Array) -> Array | None:
        """Scaled pressures of the controlled faces; None where there are none."""

    def columns(self, at: Evaluation) -> Array:
        """Derivative (k, size) of the residual by the scalars."""

    def unstable(self, modes: int | None, stiffness: Array) -> int | None:
        """Unstable modes under this control, from those at given loads and the border's matrix (k, k)."""


class Place(Protocol):
    """A state of the path."""

    @property
    def parameter(self) -> float:
        """Its parameter."""

    @property
    def unknowns(self) -> Array:
        """Its unknowns (size,)."""

    @property
    def scalars(self) -> Array:
        """Its scalars (k,)."""

    @property
    def change(self) -> Array | None:
        """Change of the unknowns with the parameter; None where the tangent was singular."""

    @property
    def slope(self) -> Array | None:
        """Change of the scalars."""


class Target(Protocol):
    """Conditions that determine the scalars."""

    def conditions(self, unknowns: Array, parameter: float, scalars: Array) -> Conditions:
        """The conditions at a parameter."""

    def onward(self, last: Place, now: Place) -> "Target":
        """The conditions beyond a state, from the state before it."""


@dataclass(frozen=True, slots=True, eq=False)
class Constraint:
    """Scalar unknowns, their conditions, the time that the path takes, and what acts in the present step.

    Parameters
    ----------
    scalar_unknowns : ScalarUnknowns
    target : Target
    clock : Clock
    memory : Memory or None
        Internal variables of the last converged state; None at rest.
    history : History or None
        What the last converged state brings into the present step.
    addition : Addition or None
        Forces besides those of the model, such as inertia.
    """

    scalar_unknowns: ScalarUnknowns
    target: Target
    clock: Clock = field(default_factory=Clock)
    memory: Memory | None = None
    history: History | None = None
    addition: Addition | None = None

    @staticmethod
    def of(
        scalar_unknowns: ScalarUnknowns,
        target: Target,
        clock: Clock | None = None,
        history: History | None = None,
        addition: Addition | None = None,
    ) -> "Constraint":
        """A constraint whose first step has a history."""
        memory = None if history is None else history.memory
        return Constraint(scalar_unknowns, target, clock or Clock(), memory, history, addition)

    def begun(self, parameter: float) -> "Constraint":
        """The constraint in a step to a parameter, in which the rubber relaxes."""
        history = self.scalar_unknowns.system.history(self.memory, self.clock.step_to(parameter))
        return replace(self, history=history)

    @property
    def friction(self) -> Friction:
        """Friction history of the present step."""
        return () if self.history is None else self.history.friction

    def with_friction(self, friction: Friction) -> "Constraint":
        """The constraint in the same step with another friction history, such as one with other limits."""
        history = self.history or self.scalar_unknowns.system.history()
        return replace(self, history=replace(history, friction=friction))

    def evaluate(
        self,
        unknowns: Array,
        parameter: float,
        scalars: Array,
        known: Contacts | None = None,
        how: SearchMode = SearchMode.FOLLOW,
    ) -> Evaluation | None:
        """The equations of equilibrium; None where a cell is turned inside out."""
        scalar_unknowns, factor = self.scalar_unknowns, self.scalar_unknowns.load_factor(parameter, scalars)
        return scalar_unknowns.system.evaluate(
            unknowns, factor, scalar_unknowns.pressures(scalars), known, how, self.history, self.addition
        )

    def onward(self, last: Place, now: Place) -> "Constraint":
        """The constraint for the step beyond a state, from the state before it."""
        return replace(self, target=self.target.onward(last, now), clock=self.clock.onward(now.parameter))
