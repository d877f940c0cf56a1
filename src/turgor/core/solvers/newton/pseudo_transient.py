"""Pseudo-transient continuation: reach an equilibrium that Newton's method does not find, against viscous forces.

The residual drives a motion against viscous forces that resist changes of the displacement's gradient. The steps are
implicit and get longer while the motion fades (Kelley and Keyes 1998, doi 10.1137/S0036142996304796). At rest there are
no viscous forces: the state is an equilibrium of the model. It is stable, but where a motion along a line of symmetry
ends at an unstable one; the caller decides about that.
"""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.algebra.additions import Linear
from turgor.core.engine.algebra.tangent import Tangent
from turgor.core.engine.contact.part import SearchMode
from turgor.core.engine.damping import gradient_stiffness
from turgor.core.engine.system import Evaluation, System
from turgor.core.solvers.constraints.constraint import Constraint
from turgor.core.solvers.newton.contact_newton import newton_with_contact
from turgor.core.solvers.newton.newton import newton
from turgor.core.solvers.newton.newton_values import NewtonResult, NewtonSettings, Report, Start
from turgor.core.solvers.newton.settings import PSEUDO_TRANSIENT
from turgor.core.solvers.step_reasons import Cause, Reason

Array = NDArray[np.float64]


@dataclass(slots=True, eq=False)
class _Motion:
    """How far the motion has come."""

    at: Evaluation
    viscosity: float
    iterations: int = 0


def pseudo_transient(
    constraint: Constraint,
    tangent: Tangent,
    unknowns: Array,
    load_factor: float,
    settings: NewtonSettings,
    report: Report,
) -> NewtonResult:
    """Find the equilibrium at a load factor to which a body moves from its present state.

    Parameters
    ----------
    constraint : Constraint
        That of load control.
    tangent : Tangent
    unknowns : (size,) array
        From where it starts, such as the last equilibrium.
    load_factor : float
    settings : NewtonSettings
        Of the equilibrium; viscous steps are solved roughly.
    report : callable
        Called after every iteration.
    """
    system = constraint.scalar_unknowns.system
    at = constraint.evaluate(unknowns, load_factor, np.empty(0))
    if at is None:
        return _restless(0)
    resistance = gradient_stiffness(system)
    motion = _Motion(at, _first_viscosity(system, tangent, at, resistance))
    smallest = PSEUDO_TRANSIENT.faded * motion.viscosity
    rough = replace(settings, tolerance=max(PSEUDO_TRANSIENT.rough_residual, settings.tolerance), mixed_points=False)
    p, alone = PSEUDO_TRANSIENT, not len(system.cells)
    most = p.iterations_of_films if alone else p.iterations
    fall, rise = (p.after_step_of_films, p.after_failure_of_films) if alone else (p.after_step, p.after_failure)
    while motion.iterations < most:
        dragged = replace(constraint, addition=_drag(system, resistance, motion))
        start = Start(motion.at.unknowns, system.stresses(motion.at))
        result = newton(dragged, tangent, start, load_factor, rough, report)
        motion.iterations += result.iterations
        if not result.converged or result.evaluation is None:
            motion.viscosity *= rise
            continue
        motion.at = _searched_again(constraint, result.evaluation)
        motion.viscosity *= fall
        if motion.viscosity > smallest:
            continue
        last = _without(constraint, tangent, motion, settings, report)
        at_round_off = last.reason is not None and last.reason.cause is Cause.ROUND_OFF
        faded = motion.viscosity <= PSEUDO_TRANSIENT.faded * smallest  # at rest where it is unstable
        if at_round_off or (last.converged and (faded or not last.unstable_modes)):
            return replace(last, iterations=motion.iterations)
    return _restless(motion.iterations)


def _without(
    constraint: Constraint, tangent: Tangent, motion: _Motion, settings: NewtonSettings, report: Report
) -> NewtonResult:
    """Try to find the equilibrium itself."""
    start = Start(motion.at.unknowns, constraint.scalar_unknowns.system.stresses(motion.at))
    result = newton_with_contact(constraint, tangent, start, motion.at.load_factor, settings, report)
    motion.iterations += result.iterations
    return result


def _searched_again(constraint: Constraint, at: Evaluation) -> Evaluation:
    """The same place with a new global search for contact: a body may move past many sides in a few viscous steps."""
    again = None
    if constraint.scalar_unknowns.system.contact.parts:
        again = constraint.evaluate(at.unknowns, at.load_factor, np.empty(0), at.contacts, SearchMode.GLOBAL)
    return at if again is None else again


def _restless(iterations: int) -> NewtonResult:
    reason = Reason(Cause.PSEUDO_TRANSIENT_FAILED)
    return NewtonResult(evaluation=None, iterations=iterations, residual=np.inf, converged=False, reason=reason)


def _first_viscosity(system: System, tangent: Tangent, at: Evaluation, resistance: Array) -> float:
    """The viscosity with which no node moves by more than the allowed distance in the first step."""
    largest = (
        PSEUDO_TRANSIENT.almost_rigid * float(np.abs(system.tangent_data(at)).max()) / float(np.abs(resistance).max())
    )
    drag = Linear(system.layout.base, largest * resistance, np.zeros(system.size))
    tangent.factor(replace(at, addition=drag))
    moved = tangent.solve(np.where(system.prescribed, 0.0, -at.residual))[: 3 * system.node_count]
    return largest * float(np.abs(moved[system.moving[: len(moved)]]).max()) / PSEUDO_TRANSIENT.first_move


def _drag(system: System, resistance: Array, motion: _Motion) -> Linear:
    drag = motion.viscosity * resistance
    return Linear(system.layout.base, drag, -system.layout.base.product(drag, motion.at.unknowns))
