"""Inertia correction: shift the tangent until it is stable, where Newton's method alternates between contact states.

When a point separates, the tangent may become indefinite at once. Newton's method then alternates between two states of
contact, and neither is an equilibrium. With constant friction limits all forces have a potential. The inertia of the
factorization (the signs of the pivots) shows whether it is convex, and a shift of the diagonal makes it so. Every
update then lowers the potential (Wächter and Biegler 2006, doi 10.1007/s10107-004-0559-y). Near a stable state no shift
is needed, and convergence is that of Newton's method.
"""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.algebra.linear import SingularTangentError
from turgor.core.engine.algebra.tangent import Tangent
from turgor.core.engine.contact.friction import with_constant_limits
from turgor.core.engine.contact.terms import Contacts
from turgor.core.engine.system import Evaluation
from turgor.core.solvers.constraints.constraint import Constraint
from turgor.core.solvers.newton.convergence import relative_residual
from turgor.core.solvers.newton.iteration import shortened
from turgor.core.solvers.newton.line_search import evaluate
from turgor.core.solvers.newton.newton_values import NewtonResult, NewtonSettings, Report
from turgor.core.solvers.newton.settings import INERTIA_CORRECTION
from turgor.core.solvers.step_reasons import Cause, Reason

Array = NDArray[np.float64]

#: Load control has no scalars.
NO_SCALARS: Array = np.empty(0)


def inertia_corrected(
    constraint: Constraint,
    tangent: Tangent,
    unknowns: Array,
    load_factor: float,
    settings: NewtonSettings,
    report: Report,
) -> NewtonResult:
    """Find a stable equilibrium at a load factor, at a lower potential than that of the start.

    The limits of friction are constant meanwhile; the caller checks whether the result holds when they follow the
    pressure. The method fails for forces without a potential, such as pressure on open surfaces.
    """
    system = constraint.scalar_unknowns.system
    if not system.terms.symmetric:
        return _failed(None, 0, np.inf)
    start = unknowns.copy()
    start[system.prescribed] = system.prescribed_values(load_factor)
    constant = constraint.with_friction(with_constant_limits(constraint.friction))
    at = evaluate(constant, tangent, (start, NO_SCALARS), load_factor)
    if at is None or not any(each.inside.any() for each in at.contacts.gaps):
        return _failed(at, 0, np.inf)
    result = _descend(constant, tangent, at, settings, report)
    at = result.evaluation
    assert at is not None
    contacts = at.contacts.with_friction(constraint.friction)  # the limits of the state follow the pressure again
    return replace(result, evaluation=replace(at, contacts=contacts, history=constraint.history or at.history))


def _descend(
    constraint: Constraint, tangent: Tangent, at: Evaluation, settings: NewtonSettings, report: Report
) -> NewtonResult:
    system = constraint.scalar_unknowns.system
    shift, residual, start, free = 0.0, relative_residual(system, at), at.unknowns, system.moving
    for iteration in range(1, INERTIA_CORRECTION.updates + 1):
        steepened = _factored(tangent, at, shift)
        if steepened is None:
            return _failed(at, iteration, residual)
        shift = steepened
        update = tangent.solve(np.where(system.prescribed, 0.0, -at.residual))
        contacts = None if iteration <= INERTIA_CORRECTION.keep_partners_after else at.contacts
        new, length = _shortened(constraint, tangent, at, update, contacts)
        if new is None or float(np.abs(new.unknowns - start)[free].max()) > INERTIA_CORRECTION.reach:
            return _failed(at, iteration, residual)
        residual = relative_residual(system, new)
        correction = length * float(np.abs(update).max()) / max(float(np.abs(new.unknowns).max()), 1e-300)
        report(iteration, residual, correction, length)
        if residual <= settings.tolerance and shift == 0:
            return NewtonResult(
                evaluation=new,
                iterations=iteration,
                residual=residual,
                converged=True,
                unstable_modes=tangent.unstable_modes(),
                reason=Reason(Cause.INERTIA_CORRECTED),
            )
        if length == 1:
            shift = (
                0.0
                if residual < INERTIA_CORRECTION.unshifted_below or shift <= INERTIA_CORRECTION.first_shift
                else shift / INERTIA_CORRECTION.shift_factor
            )
        at = new
    return _failed(at, INERTIA_CORRECTION.updates, residual)


def _failed(at: Evaluation | None, iterations: int, residual: float) -> NewtonResult:
    reason = Reason(Cause.INERTIA_CORRECTION_FAILED)
    return NewtonResult(evaluation=at, iterations=iterations, residual=residual, converged=False, reason=reason)


def _factored(tangent: Tangent, at: Evaluation, shift: float) -> float | None:
    """Factor the tangent with at least this shift, increased until no mode is unstable; None if no shift suffices."""
    while shift <= INERTIA_CORRECTION.largest_shift:
        try:
            tangent.factor(at, shift=shift)
            if tangent.unstable_modes() == 0:
                return shift
        except SingularTangentError:
            pass
        shift = max(INERTIA_CORRECTION.shift_factor * shift, INERTIA_CORRECTION.first_shift)
    return None


def _shortened(
    constraint: Constraint, tangent: Tangent, at: Evaluation, update: Array, contacts: Contacts | None
) -> tuple[Evaluation | None, float]:
    """Shorten an update until no penetration is too deep and the potential still falls at its end."""
    system = constraint.scalar_unknowns.system
    free = system.moving & ~system.prescribed
    along = update[free]
    before = float(at.residual[free] @ along)

    def trial(length: float) -> tuple[Evaluation | None, float]:
        new = evaluate(constraint, tangent, (at.unknowns + length * update, NO_SCALARS), at.load_factor, contacts)
        if new is None:
            return None, 0.5
        share, after = system.contact.shortening(at.contacts, new.contacts), float(new.residual[free] @ along)
        if share < 1 or after * before >= 0 or abs(after) <= INERTIA_CORRECTION.overshot * abs(before):
            return new, share
        return new, max(INERTIA_CORRECTION.least_share, abs(before) / (abs(after) + abs(before)))

    return shortened(trial, INERTIA_CORRECTION.shortest)
