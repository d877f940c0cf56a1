"""Constraints: scalar unknowns beside the displacements, and as many conditions that determine them.

The scalars are the pressures of cavities or the load factor, the conditions are volumes, amounts of gas or an arc
length. Both may depend on a parameter that orders the states of the path. Load control has neither.
"""

from dataclasses import dataclass, field
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from turgor.engine.contact.part import Look
from turgor.engine.contact.terms import Contacts
from turgor.engine.system import Evaluation, System
from turgor.solvers.constraints.clock import Clock

Array = NDArray[np.float64]

#: Step by which changes along the parameter are measured; what depends on it is straight or nearly so.
NUDGE = 1e-6


@dataclass(frozen=True, slots=True, eq=False)
class Conditions:
    """Conditions beside equilibrium: their errors (k,), and derivatives by unknowns (k, size) and scalars (k, k)."""

    errors: Array
    rows: Array
    corner: Array


class Sought(Protocol):
    """Scalar unknowns beside the displacements and mean stresses."""

    @property
    def system(self) -> System:
        """The equations of equilibrium."""

    def load_factor(self, parameter: float, scalars: Array) -> float:
        """How much of the other loads acts."""

    def evaluate(
        self,
        unknowns: Array,
        parameter: float,
        scalars: Array,
        known: Contacts | None = None,
        how: Look = Look.FOLLOW,
    ) -> Evaluation | None:
        """The equations of equilibrium; None where a cell is turned inside out."""

    def columns(self, at: Evaluation) -> Array:
        """Derivative (k, size) of the residual by the scalars."""

    def unstable(self, modes: int | None, stiffness: Array) -> int | None:
        """Unstable modes of what is driven in this way, from those at given loads and the border's matrix (k, k)."""


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
        """The conditions beyond a state that was found after another one."""


@dataclass(frozen=True, slots=True, eq=False)
class Constraint:
    """Scalar unknowns, their conditions, and the time that the path takes."""

    sought: Sought
    target: Target
    clock: Clock = field(default_factory=Clock)

    def onward(self, last: Place, now: Place) -> "Constraint":
        """The constraint for the step beyond a state that was found after another one."""
        return Constraint(self.sought, self.target.onward(last, now), self.clock.onward(now.parameter))
