"""Convergence: relative residuals, so that neither units nor the size of the actuator matter."""

from collections.abc import Sequence

import numpy as np

from turgor.engine.system import Evaluation, System
from turgor.solvers.constraints.constraint import Conditions
from turgor.solvers.newton.thresholds import KEEP_PARTNERS_AFTER, SMALL_FORCE, STAGNATING_BELOW, UNLOADED


def relative_residual(system: System, at: Evaluation) -> float:
    """Largest of the unbalanced force relative to external forces and reactions, and the errors of constraints.

    These are the relative volume error, and how far reference points and their arrows are off, in lengths of an edge.
    """
    displacement = 3 * system.node_count
    moving = system.moving[:displacement]
    held = system.held[:displacement][moving]
    force = at.residual[:displacement][moving]
    scale = max(
        float(np.linalg.norm(at.external[:displacement][moving][~held])),
        float(np.linalg.norm(force[held])),
        at.contact_force,
        SMALL_FORCE * system.full_force,
        UNLOADED * np.sqrt(system.node_count),  # an unloaded body: nothing to compare with but round-off
    )
    bodies = slice(displacement + system.element.mean_count, None)
    loose = at.residual[bodies][~system.held[bodies]]
    unbalanced = float(np.hypot(np.linalg.norm(force[~held]), np.linalg.norm(loose))) / scale
    tied = system.multipliers[~system.held[system.multipliers]]
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
    """Whether partners of contact are kept: in late updates, or if a small residual did not halve in two updates."""
    stagnates = len(residuals) > 3 and residuals[-1] < STAGNATING_BELOW and residuals[-1] > 0.5 * residuals[-3]
    return stagnates or iteration > KEEP_PARTNERS_AFTER
