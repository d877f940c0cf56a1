"""Load control: the constraint without an extra unknown, because the parameter is the load factor itself."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.algebra.additions import Addition
from turgor.core.engine.cells.internal_variables import History
from turgor.core.engine.system import Evaluation, System
from turgor.core.solvers.constraints.clock import Clock
from turgor.core.solvers.constraints.constraint import Constraint, Place
from turgor.core.solvers.constraints.elimination import Conditions

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class GivenLoads:
    """No scalar is unknown: the parameter is the load factor.

    Parameters
    ----------
    system : System
    """

    system: System

    def load_factor(self, parameter: float, scalars: Array) -> float:
        """The parameter itself."""
        return parameter

    def pressures(self, scalars: Array) -> Array | None:
        """None is unknown."""
        return None

    def columns(self, at: Evaluation) -> Array:
        """None, as an array (0, size)."""
        return np.empty((0, len(at.unknowns)))

    def unstable(self, modes: int | None, stiffness: Array) -> int | None:
        """All of those at given loads."""
        return modes


@dataclass(frozen=True, slots=True)
class NoConditions:
    """No condition besides equilibrium."""

    def conditions(self, unknowns: Array, parameter: float, scalars: Array) -> Conditions:
        """Arrays without rows."""
        return Conditions(np.empty(0), np.empty((0, len(unknowns))), np.empty((0, 0)))

    def onward(self, last: Place, now: Place) -> "NoConditions":
        """The same conditions at all states."""
        return self


def load_control(
    system: System,
    clock: Clock | None = None,
    history: History | None = None,
    addition: Addition | None = None,
) -> Constraint:
    """Return the constraint of load control, with a clock where it takes time.

    ``history`` is what the rubber brings into the step, ``addition`` the forces besides those of the model.
    """
    return Constraint.of(GivenLoads(system), NoConditions(), clock, history, addition)
