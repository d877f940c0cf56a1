"""Constraints with an unknown load factor: a weighted volume or an arc length is given."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.chamber_volumes import Chambers
from turgor.core.engine.system import Evaluation, System
from turgor.core.solvers.constraints.arc import Arc
from turgor.core.solvers.constraints.constraint import Place
from turgor.core.solvers.constraints.elimination import Conditions

Array = NDArray[np.float64]


#: Load factors to both sides of a state, at which the difference of forces of states is taken: a curvature of a tenth
#: per load factor squared is off by 1e-9, and so is round-off.
STATE_NUDGE = 1e-4


def load_change(system: System, unknowns: Array, before: float, after: float) -> Array:
    """Change (size,) of the forces that loads and states of bodies exert between two load factors, nothing moving."""
    change = system.external(unknowns, after) - system.external(unknowns, before)
    if not system.has_states:
        return change
    return np.asarray(change + system.state_forces(unknowns, before) - system.state_forces(unknowns, after))


@dataclass(frozen=True, slots=True, eq=False)
class LoadFactor:
    """The load factor.

    Parameters
    ----------
    system : System
        Of a model whose loads all grow in proportion to the load factor, and whose supports stay.
    """

    system: System

    def load_factor(self, parameter: float, scalars: Array) -> float:
        """The scalar itself."""
        return float(scalars[0])

    def pressures(self, scalars: Array) -> Array | None:
        """None is unknown."""
        return None

    def columns(self, at: Evaluation) -> Array:
        """Minus the forces of all loads, which are straight in the load factor but for states of bodies."""
        if not self.system.has_states:
            return -load_change(self.system, at.unknowns, 0.0, 1.0)[None, :]
        ends = (at.load_factor - STATE_NUDGE, at.load_factor + STATE_NUDGE)
        return -load_change(self.system, at.unknowns, *ends)[None, :] / (2 * STATE_NUDGE)

    def unstable(self, modes: int | None, stiffness: Array) -> int | None:
        """Those at given loads, because the user requested loads."""
        return modes


@dataclass(frozen=True, slots=True, eq=False)
class WorkTarget:
    """The volume of all cavities, weighted with their pressures at load factor 1, grows with the parameter from 0 to 1.

    Parameters
    ----------
    chambers : Chambers
    weights : (k,) array
        Pressures over the largest of them.
    first, last : float
        Weighted volume at parameters 0 and 1.
    """

    chambers: Chambers
    weights: Array
    first: float
    last: float

    def conditions(self, unknowns: Array, parameter: float, scalars: Array) -> Conditions:
        """Error of the weighted volume relative to its growth."""
        growth = self.last - self.first
        volume = float(self.weights @ self.chambers.volumes(unknowns))
        row = self.weights @ self.chambers.gradients(unknowns) / growth
        return Conditions(np.array([(volume - self.first) / growth - parameter]), row[None, :], np.zeros((1, 1)))

    def onward(self, last: Place, now: Place) -> "WorkTarget":
        """The same conditions at all states."""
        return self


@dataclass(frozen=True, slots=True, eq=False)
class ArcTarget:
    """The step has a given length along the tangent of the path at its last state (pseudo arc length).

    Parameters
    ----------
    system : System
    size : float
        Displacement that counts as much as a load factor of 1.
    parameter, unknowns, scalars
        The last state; the parameter is the length up to it.
    arc : Arc
        Tangent of the path there, without mean stresses.
    """

    system: System
    size: float
    parameter: float
    unknowns: Array
    scalars: Array
    arc: Arc

    def conditions(self, unknowns: Array, parameter: float, scalars: Array) -> Conditions:
        """Error of the length along the direction."""
        rise = float((scalars - self.scalars)[0])
        return self.arc.conditions(unknowns - self.unknowns, rise, parameter - self.parameter)

    def onward(self, last: Place, now: Place) -> "ArcTarget":
        """Go on in the direction of the path, or of the last step where the tangent is singular."""
        if now.change is not None and now.slope is not None:
            change, rise = now.change, float(now.slope[0])
        else:
            change, rise = now.unknowns - last.unknowns, float((now.scalars - last.scalars)[0])
        arc = Arc.along(change, rise, self.system.moving / self.size**2)
        return replace(self, parameter=now.parameter, unknowns=now.unknowns, scalars=now.scalars, arc=arc)


def displacement_of(system: System, unknowns: Array) -> Array:
    """The unknowns (size,) without mean stresses."""
    out = unknowns.copy()
    out[~system.moving] = 0.0
    return out
