"""Newton's method for one point of a path: update, line search, convergence; with or without extra unknowns.

Load control and every other constraint share this file: under load control the border has no row (k = 0). Two things
make it cheaper than the textbook. The geometric stiffness uses the stress linearized from the last iterate (mixed
integration points, Magisano, Leonetti and Garcea 2017, doi 10.1016/j.cma.2016.10.023), which converges from farther
away; a sheet that wrinkles is linearized about that stress altogether. And factors are used again while they still
reduce the residual well (modified Newton), because a residual costs a twentieth of a factorization; not where sheets
wrinkle, whose stiffness changes with every update.
"""

from dataclasses import dataclass
from time import perf_counter

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.algebra.linear import SingularTangentError
from turgor.core.engine.algebra.tangent import Tangent
from turgor.core.engine.system import Evaluation, Stresses
from turgor.core.solvers.constraints.constraint import Constraint
from turgor.core.solvers.constraints.elimination import Conditions
from turgor.core.solvers.newton.border import Border
from turgor.core.solvers.newton.convergence import nothing_acts, partners_settle, stagnates, too_slow, whole_residual
from turgor.core.solvers.newton.forcing import forcing
from turgor.core.solvers.newton.iteration import CONVERGED, Stopped, iterate
from turgor.core.solvers.newton.line_search import evaluate, line_search
from turgor.core.solvers.newton.newton_values import NewtonResult, NewtonSettings, Report, Start
from turgor.core.solvers.newton.settings import FACTORS, LINE_SEARCH
from turgor.core.solvers.step_reasons import Cause, Reason

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class _Iterate:
    """An iterate, and how it was found.

    Parameters
    ----------
    at, scalars, conditions
        The equations at it.
    jump : array
        What the supports still have to move.
    geometric : Stresses or None
        For the geometric stiffness of the last update, or of the first one.
    fresh : bool
        Whether the first update needs factors of its own.
    residuals, lengths : tuple of float
        Relative residuals and step lengths so far.
    settled : bool
        Whether partners of contact stay.
    moved : float
        How far the body has moved since new factors, over its largest displacement.
    last : (Evaluation, array) or None
        The iterate before and the update from it; None at the start.
    """

    at: Evaluation
    scalars: Array
    conditions: Conditions
    jump: Array
    geometric: Stresses | None
    fresh: bool
    residuals: tuple[float, ...]
    lengths: tuple[float, ...] = (1.0,)
    settled: bool = False
    moved: float = 0.0
    last: tuple[Evaluation, Array] | None = None


@dataclass(frozen=True, slots=True, eq=False)
class _Update:
    """Updates of unknowns and scalars, the stresses of their tangent, and whether it was factored for them."""

    unknowns: Array
    scalars: Array
    geometric: Stresses | None
    fresh: bool


@dataclass(frozen=True, slots=True, eq=False)
class _Newton:
    """The case of finite elements."""

    constraint: Constraint
    border: Border
    parameter: float
    settings: NewtonSettings
    report: Report

    @property
    def mixed(self) -> bool:
        return self.border.tangent.mixed_points and self.settings.mixed_points

    def update(self, now: _Iterate) -> _Update:
        """Solve for the updates of unknowns and scalars."""
        fresh, geometric = _factors(self, now)
        reduction = forcing(fresh, self.border.tangent.iterative, now.residuals, self.settings.tolerance)
        try:
            updates = self.border.newton_update(now.at, (geometric, now.jump, fresh), now.conditions, reduction)
        except (SingularTangentError, np.linalg.LinAlgError) as error:
            raise Stopped(Reason(Cause.SINGULAR_TANGENT, detail=str(error))) from None
        return _Update(*updates, geometric, fresh)

    def advanced(self, now: _Iterate, update: _Update) -> _Iterate:
        """Go along an update as far as the line search allows."""
        constraint, iteration = self.constraint, len(now.residuals)
        settled = now.settled or partners_settle(iteration, now.residuals)
        whole = now.at, update.unknowns, now.scalars, update.scalars
        contacts = now.at.contacts if settled else None
        new, length = line_search(constraint, self.border.tangent, whole, self.parameter, contacts)
        if new is None:
            raise Stopped(Reason(Cause.INVERTED_CELL))
        scalars = now.scalars + length * update.scalars
        conditions = constraint.target.conditions(new.unknowns, self.parameter, scalars)
        residual = whole_residual(constraint.scalar_unknowns.system, new, conditions)
        correction = length * float(np.abs(update.unknowns).max()) / max(float(np.abs(new.unknowns).max()), 1e-300)
        self.report(iteration, residual, correction, length)
        return _Iterate(
            at=new,
            scalars=scalars,
            conditions=conditions,
            jump=(1 - length) * now.jump,  # the supports are satisfied by an update of full length
            geometric=update.geometric,
            fresh=False,
            residuals=(*now.residuals, residual),
            lengths=(*now.lengths, length),
            settled=settled,
            moved=(0.0 if update.fresh else now.moved) + correction,
            last=(now.at, update.unknowns),
        )

    def ended(self, now: _Iterate, iteration: int) -> object | None:
        """Converged, or in vain: walls too deep in each other, no progress, or round-off."""
        system, settings = self.constraint.scalar_unknowns.system, self.settings
        if now.residuals[-1] <= settings.tolerance and not now.jump.any():
            return CONVERGED
        if system.contact.parts and max(now.lengths[-FACTORS.cut_short :]) <= LINE_SEARCH.shortest_touching:
            return Reason(Cause.DEEP_PENETRATION)
        shortened = iteration == FACTORS.shortened_updates and max(now.lengths[2:]) < 1
        if (shortened or iteration >= FACTORS.vain_updates) and _in_vain(now):
            much = "halve the residual" if iteration < FACTORS.late_updates else "bring the residual far down"
            vain = f": walls touch, and {iteration} updates did not {much}"
            return Reason(Cause.TOO_MANY_ITERATIONS, iteration, vain)
        if not stagnates(system, now.at, now.residuals):
            return None
        enough = now.residuals[-1] <= settings.enough or nothing_acts(system, now.at)
        enough = enough and not now.jump.any()
        return CONVERGED if enough else Reason(Cause.ROUND_OFF, min(now.residuals))


def newton(
    constraint: Constraint, tangent: Tangent, start: Start, parameter: float, settings: NewtonSettings, report: Report
) -> NewtonResult:
    """Find equilibrium and fulfill the constraint at a parameter; the start need not satisfy the supports.

    Parameters
    ----------
    constraint : Constraint
        The scalar unknowns and their conditions; `load_control` has none, and the parameter is the load factor then.
    tangent : Tangent
    start : Start
    parameter : float
    settings : NewtonSettings
    report : callable
        Called after every update.

    Returns
    -------
    NewtonResult
    """
    run = _Newton(constraint, Border(constraint, tangent), parameter, settings, report)
    start_at = _begin(run, start)
    if start_at is None:
        reason = Reason(Cause.INVERTED_START)
        return NewtonResult(
            evaluation=None, scalars=start.scalars, iterations=0, residual=np.inf, converged=False, reason=reason
        )
    end = iterate(run, start_at, settings.max_iterations)
    if end.converged:
        return _success(run, end.at, end.iterations)
    slow = Reason(Cause.TOO_MANY_ITERATIONS, end.iterations, too_slow(end.at.residuals))
    return _failure(end.at, end.iterations, end.why if isinstance(end.why, Reason) else slow, tangent)


def _begin(run: _Newton, start: Start) -> _Iterate | None:
    """Evaluate the start; None where it turns a cell inside out."""
    constraint, parameter = run.constraint, run.parameter
    place = start.unknowns, start.scalars
    at = start.evaluation or evaluate(constraint, run.border.tangent, place, parameter)
    if at is None:
        return None
    system = constraint.scalar_unknowns.system
    conditions = constraint.target.conditions(at.unknowns, parameter, start.scalars)
    factor = constraint.scalar_unknowns.load_factor(parameter, start.scalars)
    jump = system.prescribed_values(factor) - start.unknowns[system.prescribed]
    return _Iterate(
        at=at,
        scalars=start.scalars,
        conditions=conditions,
        jump=jump,
        geometric=start.stresses if run.mixed else None,
        fresh=start.fresh or bool(jump.any()),
        residuals=(whole_residual(system, at, conditions),),
    )


def _in_vain(now: _Iterate) -> bool:
    """Whether walls touch and no update has brought the residual far below the first one."""
    share = FACTORS.vain_share if len(now.residuals) <= FACTORS.late_updates else FACTORS.late_share
    return now.at.contacts.touch and min(now.residuals[1:]) > share * now.residuals[0]


def _factors(run: _Newton, now: _Iterate) -> tuple[bool, Stresses | None]:
    """Whether the next update needs new factors, and the stresses for them.

    The last factors serve while they contract the residual well. Factors from before the last update do not know which
    points it has brought into contact, or out of it.
    """
    if now.last is None:
        return now.fresh, now.geometric
    system, tangent, (last, update) = run.constraint.scalar_unknowns.system, run.border.tangent, now.last
    previous, residual, length = now.residuals[-2], now.residuals[-1], now.lengths[-1]
    wrinkles = system.model.sheets_wrinkle  # every update changes which points are slack
    contracting = not wrinkles and residual < FACTORS.contraction * previous and residual < FACTORS.below
    known = now.at.contacts.touch_as(last.contacts)
    always = tangent.plain or tangent.iterative
    fresh = always or bool(now.jump.any()) or not (contracting and known and length == 1)
    if not (run.mixed and fresh):
        return fresh, now.geometric
    start = perf_counter()
    geometric = system.stresses(last, length * update, now.geometric)
    tangent.clock.residual += perf_counter() - start
    return True, geometric


def _success(run: _Newton, now: _Iterate, iterations: int) -> NewtonResult:
    """Count the unstable modes from the last factors, and where these find any or are stale, at the state itself.

    With scalars the modes are counted together with the rates of the path.
    """
    tangent, modes = run.border.tangent, None
    if not len(now.scalars):
        modes = tangent.unstable_modes()
        if modes or (run.settings.recount and now.moved > FACTORS.stale_factors):
            try:
                tangent.factor(now.at)
                modes = tangent.unstable_modes()
            except SingularTangentError:
                pass  # a singular tangent at the state: the count of the last iterate stands
    return NewtonResult(
        evaluation=now.at,
        scalars=now.scalars,
        iterations=iterations,
        residual=now.residuals[-1],
        converged=True,
        unstable_modes=modes,
    )


def _failure(now: _Iterate, iterations: int, reason: Reason, tangent: Tangent) -> NewtonResult:
    deep, singular = reason.cause is Cause.DEEP_PENETRATION, reason.cause is Cause.SINGULAR_TANGENT
    return NewtonResult(
        evaluation=now.last[0] if deep and now.last is not None else now.at,
        scalars=now.scalars,
        iterations=iterations,
        residual=now.residuals[-1],
        converged=False,
        unstable_modes=None if singular else tangent.unstable_modes(),
        reason=reason,
    )
