"""Newton's method for one point of a path: update, line search, convergence; with or without extra unknowns.

Load control and every other constraint share this file: under load control the border has no row (k = 0). Two things
make it cheaper than the textbook. The geometric stiffness uses the stress linearized from the last iterate (mixed
integration points, Magisano, Leonetti and Garcea 2017, doi 10.1016/j.cma.2016.10.023), which converges from farther
away; a sheet that wrinkles is linearized about that stress altogether. And factors are used again while they still
reduce the residual well (modified Newton), because a residual costs a twentieth of a factorization; not where sheets
wrinkle, whose stiffness changes with every update.
"""

from collections.abc import Callable
from dataclasses import dataclass, field
from time import perf_counter

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.algebra.linear import SingularTangentError
from turgor.core.engine.algebra.tangent import Tangent
from turgor.core.engine.system import Evaluation, Stresses
from turgor.core.solvers.constraints.constraint import Conditions, Constraint
from turgor.core.solvers.newton.border import Border
from turgor.core.solvers.newton.convergence import partners_settle, stagnates, too_slow, whole_residual
from turgor.core.solvers.newton.forcing import forcing
from turgor.core.solvers.newton.line_search import evaluate, line_search
from turgor.core.solvers.newton.thresholds import (
    CUT_SHORT,
    KEEP_FACTORS_BELOW,
    KEEP_FACTORS_CONTRACTION,
    SHORTEST_TOUCHING_STEP,
    STALE_FACTORS,
    VAIN_SHARE,
    VAIN_UPDATES,
)
from turgor.core.solvers.step_reasons import Cause, Reason

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class NewtonSettings:
    """How Newton's method iterates.

    Parameters
    ----------
    tolerance : float [-]
        Largest relative residual.
    max_iterations : int
        Updates before it gives up.
    mixed_points : bool
        Whether stresses may be linearized where the tangent is set to that.
    count_anew : bool
        Whether unstable modes are counted by new factors where the last ones are stale.
    enough : float [-]
        Relative residual that is accepted where round-off keeps it above the tolerance.
    """

    tolerance: float = 1e-6
    max_iterations: int = 15
    mixed_points: bool = True
    count_anew: bool = False
    enough: float = 0.0


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class NewtonResult:
    """How Newton's method ended.

    Parameters
    ----------
    evaluation : Evaluation or None
        The equations at the last iterate.
    iterations : int
        Updates in all.
    residual : float [-]
        The last relative residual.
    converged : bool
    scalars : (k,) array
        The scalars at the last iterate.
    unstable_modes : int or None
        None where a border needs them counted with the rates.
    reason : Reason or None
        Why it failed, or how the state was found.
    hardest : int
        Updates of the longest pass where friction and contact stiffness were renewed.
    """

    evaluation: Evaluation | None
    iterations: int
    residual: float
    converged: bool
    scalars: Array = field(default_factory=lambda: np.empty(0))
    unstable_modes: int | None = None
    reason: Reason | None = None
    hardest: int = 0


@dataclass(frozen=True, slots=True, eq=False)
class Start:
    """Where Newton's method starts.

    Parameters
    ----------
    unknowns : (size,) array
    stresses : Stresses or None
        For the geometric stiffness of the first update; None takes those of the start.
    scalars : (k,) array
        None under load control.
    evaluation : Evaluation or None
        The equations there, where they were evaluated already.
    fresh : bool
        Whether the first update needs factors of its own, or those of the last solve will do.
    """

    unknowns: Array
    stresses: Stresses | None
    scalars: Array = field(default_factory=lambda: np.empty(0))
    evaluation: Evaluation | None = None
    fresh: bool = True


Report = Callable[[int, float, float, float], None]  # iteration, residual, correction, step length


@dataclass(slots=True, eq=False)
class _Iterate:
    """How far the iteration has come; ``jump`` is what supports still have to move, ``moved`` since new factors."""

    at: Evaluation
    scalars: Array
    conditions: Conditions
    jump: Array
    geometric: Stresses | None
    fresh: bool
    residuals: list[float]
    lengths: list[float] = field(default_factory=lambda: [1.0])
    settled: bool = False
    moved: float = 0.0


@dataclass(frozen=True, slots=True, eq=False)
class _Newton:
    """What stays the same in one solve."""

    constraint: Constraint
    border: Border
    parameter: float
    settings: NewtonSettings

    @property
    def mixed(self) -> bool:
        return self.border.tangent.mixed_points and self.settings.mixed_points


def newton(
    constraint: Constraint, tangent: Tangent, start: Start, parameter: float, settings: NewtonSettings, report: Report
) -> NewtonResult:
    """Find equilibrium and fulfill the constraint at a parameter; the start need not satisfy the supports.

    Parameters
    ----------
    constraint : Constraint
        What is sought beside the unknowns; `load_control` seeks nothing, and the parameter is the load factor then.
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
    run = _Newton(constraint, Border(constraint, tangent), parameter, settings)
    now = _begin(run, start)
    if now is None:
        reason = Reason(Cause.INVERTED_START)
        return NewtonResult(
            evaluation=None, scalars=start.scalars, iterations=0, residual=np.inf, converged=False, reason=reason
        )
    for iteration in range(1, settings.max_iterations + 1):
        try:
            update, change = _update(run, now)
        except (SingularTangentError, np.linalg.LinAlgError) as error:
            return _failure(now, iteration, Reason(Cause.SINGULAR_TANGENT, detail=str(error)), None)
        last = now.at
        if not _take(run, now, (update, change), (iteration, report)):
            return _failure(now, iteration, Reason(Cause.INVERTED_CELL), tangent)
        if now.residuals[-1] <= settings.tolerance and not now.jump.any():
            return _success(run, now, iteration)
        if constraint.sought.system.contact.parts and max(now.lengths[-CUT_SHORT:]) <= SHORTEST_TOUCHING_STEP:
            now.at = last
            return _failure(now, iteration, Reason(Cause.DEEP_PENETRATION), tangent)
        if iteration >= VAIN_UPDATES and _in_vain(now):
            vain = f": walls touch, and {iteration} updates did not halve the residual"
            return _failure(now, iteration, Reason(Cause.TOO_MANY_ITERATIONS, iteration, vain), tangent)
        if stagnates(constraint.sought.system, now.at, now.residuals):
            if now.residuals[-1] <= settings.enough and not now.jump.any():
                return _success(run, now, iteration)
            return _failure(now, iteration, Reason(Cause.ROUND_OFF, min(now.residuals)), tangent)
        _choose_factors(run, now, last, update)
    reason = Reason(Cause.TOO_MANY_ITERATIONS, iteration, too_slow(now.residuals))
    return _failure(now, iteration, reason, tangent)


def _begin(run: _Newton, start: Start) -> _Iterate | None:
    """Evaluate the start; None where it turns a cell inside out."""
    constraint, parameter = run.constraint, run.parameter
    place = start.unknowns, start.scalars
    at = start.evaluation or evaluate(constraint, run.border.tangent, place, parameter)
    if at is None:
        return None
    system = constraint.sought.system
    conditions = constraint.target.conditions(at.unknowns, parameter, start.scalars)
    jump = system.prescribed(constraint.sought.load_factor(parameter, start.scalars)) - start.unknowns[system.held]
    return _Iterate(
        at=at,
        scalars=start.scalars,
        conditions=conditions,
        jump=jump,
        geometric=start.stresses if run.mixed else None,
        fresh=start.fresh or bool(jump.any()),
        residuals=[whole_residual(system, at, conditions)],
    )


def _update(run: _Newton, now: _Iterate) -> tuple[Array, Array]:
    """Solve for the updates of unknowns and scalars."""
    system = run.constraint.sought.system
    coupling = np.zeros(system.size)
    if now.fresh:
        coupling, now.moved = run.border.factor(now.at, now.geometric, now.jump), 0.0
    right = -now.at.residual - coupling
    right[system.held] = now.jump
    left = forcing(now.fresh, run.border.tangent.iterative, now.residuals, run.settings.tolerance)
    return run.border.update(right, now.conditions, now.conditions.errors, left)


def _take(run: _Newton, now: _Iterate, step: tuple[Array, Array], reported: tuple[int, Report]) -> bool:
    """Go along an update as far as the line search allows; False where even the shortest turns a cell inside out."""
    (update, change), (iteration, report) = step, reported
    constraint, system = run.constraint, run.constraint.sought.system
    now.settled = now.settled or partners_settle(iteration, now.residuals)
    kept = now.at.contacts if now.settled else None
    whole = now.at, update, now.scalars, change
    new, length = line_search(constraint, run.border.tangent, whole, run.parameter, kept)
    if new is None:
        return False
    now.jump = (1 - length) * now.jump  # the supports are satisfied by an update of full length
    now.scalars = now.scalars + length * change
    now.conditions = constraint.target.conditions(new.unknowns, run.parameter, now.scalars)
    residual = whole_residual(system, new, now.conditions)
    correction = length * float(np.abs(update).max()) / max(float(np.abs(new.unknowns).max()), 1e-300)
    now.at, now.moved = new, now.moved + correction
    now.residuals.append(residual)
    now.lengths.append(length)
    report(iteration, residual, correction, length)
    return True


def _in_vain(now: _Iterate) -> bool:
    """Whether walls touch and no update has brought the residual far below the first one."""
    return now.at.contacts.touch and min(now.residuals[1:]) > VAIN_SHARE * now.residuals[0]


def _choose_factors(run: _Newton, now: _Iterate, last: Evaluation, update: Array) -> None:
    """Keep the factors while they contract the residual well, else linearize the stress for new ones.

    Factors from before the last update do not know which points it has brought into contact, or out of it.
    """
    previous, residual, length = now.residuals[-2], now.residuals[-1], now.lengths[-1]
    wrinkles = run.constraint.sought.system.model.sheets_wrinkle  # every update changes which points are slack
    contracting = not wrinkles and residual < KEEP_FACTORS_CONTRACTION * previous and residual < KEEP_FACTORS_BELOW
    known = now.at.contacts.touch_as(last.contacts)
    always = run.border.tangent.plain or run.border.tangent.iterative
    now.fresh = always or bool(now.jump.any()) or not (contracting and known and length == 1)
    if run.mixed and now.fresh:
        start = perf_counter()
        now.geometric = run.constraint.sought.system.stresses(last, length * update, now.geometric)
        run.border.tangent.clock.residual += perf_counter() - start


def _success(run: _Newton, now: _Iterate, iterations: int) -> NewtonResult:
    """Count the unstable modes from the last factors, and where these find any or are stale, at the state itself.

    With scalars the modes are counted together with the rates of the path.
    """
    tangent, modes = run.border.tangent, None
    if not len(now.scalars):
        modes = tangent.unstable_modes()
        if modes or (run.settings.count_anew and now.moved > STALE_FACTORS):
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


def _failure(now: _Iterate, iterations: int, reason: Reason, tangent: Tangent | None) -> NewtonResult:
    return NewtonResult(
        evaluation=now.at,
        scalars=now.scalars,
        iterations=iterations,
        residual=now.residuals[-1],
        converged=False,
        unstable_modes=None if tangent is None else tangent.unstable_modes(),
        reason=reason,
    )
