"""Newton's method with contact: passes in which partners, friction and penalty are updated until nothing changes."""

from dataclasses import replace

from turgor.core.engine.algebra.tangent import Tangent
from turgor.core.engine.contact.part import SearchMode
from turgor.core.engine.system import Evaluation
from turgor.core.solvers.constraints.constraint import Constraint
from turgor.core.solvers.newton.convergence import relative_residual
from turgor.core.solvers.newton.inertia_correction import inertia_corrected
from turgor.core.solvers.newton.newton import newton
from turgor.core.solvers.newton.newton_values import NewtonResult, NewtonSettings, Report, Start
from turgor.core.solvers.newton.settings import CONTACT_NEWTON
from turgor.core.solvers.step_reasons import Cause, Reason


def newton_with_contact(
    constraint: Constraint, tangent: Tangent, start: Start, parameter: float, settings: NewtonSettings, report: Report
) -> NewtonResult:
    """Find equilibrium at a parameter, with contact; iterations of all passes count.

    After each pass the partners of contact are searched for again, and friction and penalty are updated, until nothing
    changes. The parameters are those of `newton`.
    """

    def find(constraint: Constraint, start: Start) -> NewtonResult:
        result = newton(constraint, tangent, start, parameter, settings, report)
        if result.converged or tangent.plain or len(start.scalars):  # with a border there is no potential to lower
            return result
        corrected = inertia_corrected(constraint, tangent, start.unknowns, parameter, settings, report)
        iterations = result.iterations + corrected.iterations
        return replace(corrected if corrected.converged else result, iterations=iterations)

    contact, result = constraint.scalar_unknowns.system.contact, find(constraint, start)
    if not contact.parts:
        return result
    iterations, hardest = result.iterations, result.iterations
    for number in range(CONTACT_NEWTON.passes):
        at = _searched_again(constraint, result, parameter)
        if at is None:
            break
        (friction, renewed), stiffened = contact.settled(at.contacts), contact.stiffen(at.contacts)
        constraint = constraint.with_friction(friction)
        residual = relative_residual(constraint.scalar_unknowns.system, at)
        if not stiffened and residual <= CONTACT_NEWTON.after_search * settings.tolerance:
            return replace(result, evaluation=at, iterations=iterations, hardest=hardest)
        if not (stiffened or renewed) and number >= CONTACT_NEWTON.patience and residual <= CONTACT_NEWTON.wedged:
            return replace(result, iterations=iterations, hardest=hardest)
        again = find(constraint, Start(at.unknowns, constraint.scalar_unknowns.system.stresses(at), result.scalars))
        result = replace(again, reason=result.reason) if again.converged and again.reason is None else again
        iterations += result.iterations
        hardest = max(hardest, result.iterations)
    if result.converged:
        result = replace(result, converged=False, reason=Reason(Cause.CONTACT_UNSETTLED, CONTACT_NEWTON.passes))
    if result.reason is not None and result.reason.cause is Cause.TOO_MANY_ITERATIONS:
        result = replace(result, reason=replace(result.reason, value=iterations))  # those of all passes
    return replace(result, iterations=iterations)


def _searched_again(constraint: Constraint, result: NewtonResult, parameter: float) -> Evaluation | None:
    """Evaluate a converged state with a new global search for contact; None where Newton's method failed."""
    last = result.evaluation
    if not result.converged or last is None:
        return None
    return constraint.evaluate(last.unknowns, parameter, result.scalars, last.contacts, SearchMode.GLOBAL)
