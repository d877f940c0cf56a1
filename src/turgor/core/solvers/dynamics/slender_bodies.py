"""Slender bodies in a liquid: what moves along with them in a time step."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.liquids.morison import MorisonForces, Strips, added_mass, strips_of
from turgor.core.engine.system import Evaluation, System
from turgor.core.solvers.dynamics.generalized_alpha import TimeStep

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class SlenderBodies:
    """Bodies with added mass and drag; there may be none.

    Parameters
    ----------
    system : System
    strips : list of Strips
    """

    system: System
    strips: list[Strips]

    @classmethod
    def of(cls, system: System) -> "SlenderBodies":
        """Those of the loads of a model."""
        return cls(system, strips_of(system))

    def mass(self, at: Evaluation) -> Array:
        """Lower triangle (nnz,) of the added mass in a state."""
        return added_mass(self.system, self.strips, self.system.configuration(at).position, at.load_factor)

    def kinetic(self, at: Evaluation, velocity: Array) -> float:
        """Scaled kinetic energy of what moves along."""
        if not self.strips:
            return 0.0
        return 0.5 * float(velocity @ self.system.layout.base.product(self.mass(at), velocity))

    def drag(self, at: Evaluation, velocity: Array) -> Array:
        """Forces (size,) of the drag in a state."""
        nothing, position = np.zeros_like(velocity), self.system.configuration(at).position
        forces = MorisonForces(self.system, self.strips, position, at.load_factor, (0.0, velocity), (0.0, nothing))
        return forces.forces(nothing)

    def of_step(self, rule: TimeStep, load_factor: float) -> Sequence[MorisonForces]:
        """The forces of a time step on bodies that lie as they are predicted to at its end."""
        if not self.strips:
            return ()
        system, nothing = self.system, np.zeros(self.system.size)
        position = system.points + system.split(rule.prediction())[0]
        velocity, acceleration = (rule.rate, rule.velocity(nothing)), (rule.stiffness, rule.acceleration(nothing))
        return (MorisonForces(system, self.strips, position, load_factor, velocity, acceleration),)
