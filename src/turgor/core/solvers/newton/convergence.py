"""Convergence: relative residuals, so that neither units nor the size of the actuator matter."""

from collections.abc import Sequence

import numpy as np

from turgor.core.engine.system import Evaluation, System
from turgor.core.solvers.constraints.elimination import Conditions
from turgor.core.solvers.newton.settings import CONVERGENCE


def relative_residual(system: System, at: Evaluation) -> float:
    """Largest of the unbalanced force relative to external forces and reactions, and the errors of constraints.

    These are the relative volume error, and how far reference points and their arrows are off, in lengths of an edge.
    """
    displacement = 3 * system.node_count
    moving = system.moving[:displacement]
    prescribed = system.prescribed[:displacement][moving]
    force = at.residual[:displacement][moving]
    scale = _force_scale(system, at)
    bodies = slice(displacement + system.element.mean_count, None)
    loose = at.residual[bodies][~system.prescribed[bodies]]
    unbalanced = float(np.hypot(np.linalg.norm(force[~prescribed]), np.linalg.norm(loose))) / scale
    tied = system.multipliers[~system.prescribed[system.multipliers]]
    unbalanced = max(unbalanced, float(np.abs(at.residual[tied]).max(initial=0.0)))
    if not system.element.mean_count:
        return unbalanced
    means = slice(displacement, displacement + system.element.mean_count)
    volume = float(np.linalg.norm(at.residual[means])) / float(np.linalg.norm(system.mean_stress_volumes))
    return max(unbalanced, volume)


def whole_residual(system: System, at: Evaluation, conditions: Conditions) -> float:
    """Largest of the relative residual and the errors of the conditions; infinite where one is no number."""
    worst = float(np.abs(conditions.errors).max(initial=0.0))
    return max(relative_residual(system, at), worst) if np.isfinite(worst) else np.inf


def partners_settle(iteration: int, residuals: Sequence[float]) -> bool:
    """Whether partners of contact stay: in late updates, or if a small residual did not halve in two updates."""
    stagnates = (
        len(residuals) > 3 and residuals[-1] < CONVERGENCE.stagnating_below and residuals[-1] > 0.5 * residuals[-3]
    )
    return stagnates or iteration > CONVERGENCE.keep_partners_after


def _force_scale(system: System, at: Evaluation) -> float:
    """Size of the forces that act, with which unbalanced ones are compared."""
    displacement = 3 * system.node_count
    moving = system.moving[:displacement]
    prescribed = system.prescribed[:displacement][moving]
    return max(
        float(np.linalg.norm(at.external[:displacement][moving][~prescribed])),
        float(np.linalg.norm(at.residual[:displacement][moving][prescribed])),
        at.contact_force,
        CONVERGENCE.small_force * system.full_force,
        _least(system),  # an unloaded body: nothing to compare with but round-off
    )


def _least(system: System) -> float:
    return CONVERGENCE.unloaded * float(np.sqrt(system.node_count))


def nothing_acts(system: System, at: Evaluation) -> bool:
    """Whether no force acts, as on a core that melts before any load: then round-off is equilibrium."""
    return _force_scale(system, at) == _least(system)


def stagnates(system: System, at: Evaluation, residuals: Sequence[float]) -> bool:
    """Whether the residual falls no more because it is the round-off of the equations.

    Positions are rounded, and the stiffness makes forces of that; the most that this can leave is estimated.
    """
    last = residuals[-CONVERGENCE.stagnating_updates :]
    if len(residuals) <= CONVERGENCE.stagnating_updates:
        return False
    if max(last) > CONVERGENCE.round_off_below and not nothing_acts(system, at):
        return False
    if min(last) < 0.5 * min(residuals[: -CONVERGENCE.stagnating_updates]):
        return False
    return max(last) <= round_off(system, at)


def round_off(system: System, at: Evaluation) -> float:
    """Relative residual that rounded positions may leave: the largest of the stiffness times their last digits."""
    positions = np.zeros(system.size)
    count = 3 * system.node_count
    positions[:count] = np.abs(system.points).ravel()[:count] + np.abs(at.unknowns[:count])
    size = np.spacing(1.0) * system.pattern.product(np.abs(system.tangent_data(at)), positions)
    return float(np.linalg.norm(size[:count])) / _force_scale(system, at)


def too_slow(residuals: Sequence[float]) -> str:
    """Say how the residual went, after a colon.

    Examples
    --------
    >>> too_slow([1e-2, 0.3]), too_slow([0.3, 1e-2])
    (': the residual grew from 0.01 to 0.3', ': the residual fell too slowly, from 0.3 to 0.01')
    """
    first, last = residuals[0], residuals[-1]
    if last >= first:
        return f": the residual grew from {first:.2g} to {last:.2g}"
    return f": the residual fell too slowly, from {first:.2g} to {last:.2g}"
