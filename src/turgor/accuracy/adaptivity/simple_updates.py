"""Simple updates: Newton's method for a state near the solution, with old factors as long as they converge."""

from dataclasses import dataclass, replace
from math import inf

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.algebra.linear import REFINED
from turgor.core.engine.system import Evaluation, Stresses
from turgor.core.solvers.newton.border import Border
from turgor.core.solvers.newton.convergence import relative_residual
from turgor.core.solvers.newton.iteration import CONVERGED, Stopped
from turgor.core.solvers.newton.newton_values import NewtonSettings
from turgor.foundation.round_off import ROUND_OFF

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class SimpleUpdateSettings:
    """When simple updates end; all are without unit.

    Parameters
    ----------
    tolerance : float
        Relative residual of a state that takes the place of the first one, as `Static` has it.
    updates : int
        Updates at most.
    small : float
        The last update is this small a share of the whole correction, which is the mesh error that is estimated.
    chatter : float
        The same where old factors fail, as where threads go slack and taut from one update to the next. It is good
        enough for an estimate.
    contraction : float
        The tangent is factored again where an update is not this much smaller than the one before.
    far : float
        A correction larger than this share of the displacement leads to another equilibrium.
    """

    tolerance: float = NewtonSettings().tolerance
    updates: int = 12
    small: float = 0.03
    chatter: float = 0.2
    contraction: float = 0.6
    far: float = 0.3


SETTINGS = SimpleUpdateSettings()


@dataclass(frozen=True, slots=True, eq=False)
class Iterate:
    """An iterate of simple updates: the sum of the corrections, and the data of the next update.

    Parameters
    ----------
    at : Evaluation
    whole : array
        Correction of the interpolated state.
    geometric : Stresses or None
        For the geometric stiffness of new factors.
    fresh : bool
        Whether the next update needs new factors.
    hard : bool
        Whether old factors have failed.
    size : float
        Of the last update.
    failed : bool
        Whether the last update was not taken.
    """

    at: Evaluation
    whole: Array
    geometric: Stresses | None
    fresh: bool = True
    hard: bool = False
    size: float = inf
    failed: bool = False


@dataclass(frozen=True, slots=True, eq=False)
class SimpleUpdates:
    """Newton's method for a state at its load factor: no line search, old factors as long as they converge."""

    border: Border
    exact: bool
    size_of_state: float
    settings: SimpleUpdateSettings = SETTINGS

    def update(self, now: Iterate) -> tuple[Array, bool]:
        """The update, and whether its factors are new."""
        system, at, tangent = self.border.constraint.scalar_unknowns.system, now.at, self.border.tangent
        jump = system.prescribed_values(at.load_factor) - at.unknowns[system.prescribed]
        jump[np.abs(jump) < ROUND_OFF.zero] = 0.0  # else each would cost a tangent
        fresh = now.fresh or bool(jump.any())
        none = self.border.constraint.target.conditions(at.unknowns, at.load_factor, np.empty(0))
        geometric = now.geometric if now.fresh and tangent.mixed_points else None
        return self.border.newton_update(at, (geometric, jump, fresh), none, REFINED)[0], fresh

    def advanced(self, now: Iterate, solved: tuple[Array, bool]) -> Iterate:
        """The state after the update; the same one where old factors fail, to be tried again with new ones."""
        (update, fresh), system, tangent = solved, self.border.constraint.scalar_unknowns.system, self.border.tangent
        new = system.evaluate(now.at.unknowns + update, now.at.load_factor, history=now.at.history)
        moved = update[system.moving]
        size, total = float(np.linalg.norm(moved)), float(np.linalg.norm(now.whole + moved))
        if not fresh and (new is None or size > now.size):
            return replace(now, fresh=True, hard=True, failed=True)  # as where a thread goes slack
        if new is None or total > self.settings.far * self.size_of_state:
            raise Stopped("far")
        geometric = system.stresses(now.at, update, now.geometric) if tangent.mixed_points else None
        again = now.hard or size > self.settings.contraction * now.size
        return Iterate(new, now.whole + moved, geometric, again, now.hard, size)

    def ended(self, now: Iterate, iteration: int) -> str | None:
        """Converged once the last update is a small share of the whole correction."""
        if now.failed:
            return None
        small = self.settings.chatter if now.hard and not self.exact else self.settings.small
        good = now.size <= small * float(np.linalg.norm(now.whole))
        if good and self.exact:
            good = relative_residual(self.border.constraint.scalar_unknowns.system, now.at) <= self.settings.tolerance
        return CONVERGED if good else None
