"""Closed cavities: their pressures in a motion, where liquid flows into them through channels."""

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.algebra.additions import Addition
from turgor.core.engine.cells.internal_variables import History
from turgor.core.engine.chamber_volumes import Chambers
from turgor.core.engine.system import System
from turgor.core.solvers.constraints.cavities import CavityPressures
from turgor.core.solvers.constraints.constraint import Constraint
from turgor.core.solvers.constraints.loads import load_control
from turgor.core.solvers.procedures.time_options import TimeOptions
from turgor.core.solvers.restart import Restart

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class ClosedCavities:
    """Cavities with unknown pressures; there may be none.

    Parameters
    ----------
    system : System
    target : Target or None
        Conditions for the pressures in the next step.
    pressures : (k,) array
        Scaled pressures in the last state.
    """

    system: System
    target: Any
    pressures: Array

    @classmethod
    def of(cls, system: System, procedure: TimeOptions, unknowns: Array, restart: Restart | None) -> "ClosedCavities":
        """Those of a system at the start of a motion."""
        if not system.controlled:
            return cls(system, None, np.empty(0))
        chambers = Chambers(system, system.controlled)
        pressures = np.zeros(len(chambers)) if restart is None else restart.pressures(system)
        return cls(system, procedure.target(chambers, chambers.volumes(unknowns), pressures), pressures)

    @property
    def acting(self) -> Array | None:
        """The pressures as an evaluation takes them."""
        return self.pressures if len(self.pressures) else None

    def constraint(self, history: History, addition: Addition) -> Constraint:
        """The constraint of a step."""
        if self.target is None:
            return load_control(self.system, history=history, addition=addition)
        return Constraint.of(CavityPressures(self.system), self.target, history=history, addition=addition)

    def onward(self, parameter: float, unknowns: Array, pressures: Array) -> "ClosedCavities":
        """The cavities beyond a step."""
        if self.target is None:
            return self
        return replace(self, target=self.target.beyond(parameter, unknowns), pressures=pressures)
