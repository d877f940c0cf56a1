"""Newton's method for rods at one load factor, with the forces of contact."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from turgor.core.solvers.newton.iteration import CONVERGED, Ended, Stopped, iterate, shortened
from turgor.core.solvers.newton.settings import LINE_SEARCH
from turgor.fast_models.rod.band import Factors
from turgor.fast_models.rod.settings import AT_LOAD, RodNewtonSettings
from turgor.fast_models.rod.state import RodState
from turgor.fast_models.rod.system import Evaluation, RodSystem
from turgor.foundation.errors import TurgorError

Array = NDArray[np.float64]


class NotConverged(Stopped):
    """Newton's method ended without an equilibrium; `share` is how much of the step to try next."""

    def __init__(self, why: str, share: float = 0.5) -> None:
        super().__init__(why)
        self.share = share


@dataclass(frozen=True, slots=True, eq=False)
class Converged:
    """An equilibrium, its last evaluation, and the iterations that it took."""

    state: RodState
    evaluation: Evaluation
    iterations: int


@dataclass(frozen=True, slots=True, eq=False)
class Iterate:
    """A state with its evaluation, and the sizes of the first and the last update."""

    state: RodState
    evaluation: Evaluation
    first: float | None = None
    size: float = np.inf


@dataclass(frozen=True, slots=True, eq=False)
class AtLoad:
    """The case of Newton's method for rods at a load factor.

    Forces of contact are unknowns. A point presses from when it is inside a plane until its force would pull
    (primal-dual active set). A penalty removes what is left of its penetration in the next iteration (augmented
    Lagrangian). In the end the penetration is zero, and so the result does not depend on the penalty.
    """

    system: RodSystem
    settings: RodNewtonSettings

    def update(self, at: Iterate) -> Array:
        """Twists (n, 6) of the nodes."""
        (twists,) = factored(self.system, at.evaluation).solve(-at.evaluation.residual)
        if not np.isfinite(twists).all():
            raise NotConverged("not finite")
        size = update_size(self.system, twists)
        if at.first is not None and size > self.settings.large_update:
            raise NotConverged("diverges", float(np.clip(self.settings.good_update / at.first, 0.1, 0.5)))
        return twists

    def advanced(self, at: Iterate, update: Array) -> Iterate:
        """The state moved by an update."""
        size = update_size(self.system, update)
        state, evaluation = moved(self.system, at.state, at.evaluation, update)
        return Iterate(state, evaluation, size if at.first is None else at.first, size)

    def ended(self, at: Iterate, iteration: int) -> str | None:
        """Converged once the update is small and contact is resolved."""
        good = at.size < self.settings.small_update and touches_well(self.system, at.state, at.evaluation)
        return CONVERGED if good else None


def equilibrium(system: RodSystem, state: RodState, settings: RodNewtonSettings = AT_LOAD) -> Converged:
    """Find the equilibrium at the load factor of a state.

    Raises
    ------
    NotConverged
        If there is none within the limits.
    """
    end = iterate(AtLoad(system, settings), Iterate(state, _evaluated(system, state)), settings.iterations)
    return converged(end)


def converged(end: Ended[Iterate]) -> Converged:
    """The equilibrium at which an iteration ended.

    Raises
    ------
    NotConverged
        If it did not find one.
    """
    if not end.converged:
        raise end.stopped or NotConverged("iterations")
    return Converged(end.at.state, end.at.evaluation, end.iterations)


def factored(system: RodSystem, at: Evaluation) -> Factors:
    """Factor the tangent.

    Raises
    ------
    NotConverged
        If it is singular.
    """
    try:
        return system.band.factor(at.blocks, at.own)
    except FloatingPointError:
        raise NotConverged("singular") from None


def touches_well(system: RodSystem, state: RodState, at: Evaluation) -> bool:
    """Return whether the points that press lie on their planes, and no others are inside."""
    if not system.model.planes:
        return True
    missed = np.where(at.touches, np.abs(system.penetration(state)), 0.0)
    return bool(missed.max(initial=0) <= AT_LOAD.depth * system.size)


def update_size(system: RodSystem, twists: Array) -> float:
    """Return how far nodes move at most, over the length and in rad."""
    return float(max(np.abs(twists[:, :3]).max() / system.size, np.abs(twists[:, 3:]).max()))


def moved(system: RodSystem, state: RodState, at: Evaluation, twists: Array) -> tuple[RodState, Evaluation]:
    """Move a state by twists of the nodes (n, 6), less where an element would turn too far.

    Raises
    ------
    NotConverged
        If it does even after halving.
    """
    ends = (system.layout.to_end @ twists[system.layout.ends][..., None])[..., 0]
    force = at.elements.new_force(ends[:, 0], ends[:, 1])

    def trial(share: float) -> tuple[tuple[RodState, Evaluation] | None, float]:
        trial_state = state.moved(share * twists, share * force)
        if system.model.planes:
            trial_state = replace(trial_state, contact=new_contact(system, at, share * twists))
        try:
            return (trial_state, system.evaluate(trial_state)), 1.0
        except TurgorError:
            return None, 0.5

    end, _ = shortened(trial, shortest=LINE_SEARCH.shortest)
    if end is None:
        raise NotConverged("turned too far")
    return end


def new_contact(system: RodSystem, at: Evaluation, twists: Array) -> Array:
    """Return the forces of contact after the nodes moved by twists (n, 6), (k, p)."""
    change = np.einsum("kpi,pi->kp", at.contact_rows, twists[system.touching[0]])
    return np.where(at.touches, at.contact - system.penalty * change, 0.0)


def _evaluated(system: RodSystem, state: RodState) -> Evaluation:
    try:
        return system.evaluate(state)
    except TurgorError as error:
        if "table" in str(error):
            raise
        raise NotConverged("turned too far") from None
