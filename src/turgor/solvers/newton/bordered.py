"""Bordered Newton's method: equilibrium together with a few conditions, by the factors of the tangent alone.

Of K Δu + F Δs = −r and C Δu + D Δs = −c, the first is solved for several right sides, Δu = a + B Δs, the second then
for the few Δs: (D + C B) Δs = −c − C a. At a limit point K is singular though the whole is not. Short of that
point B is large and Δu the difference of large numbers, which costs digits of an update but none of the answer, because
the residual decides. Should a factorization fail at the point itself, it is repeated without the linearized stress of
the mixed integration points, at a tangent that lies a little beside it.
"""

from dataclasses import dataclass, field
from time import perf_counter

import numpy as np
from numpy.typing import NDArray

from turgor.engine.contact.part import Look
from turgor.engine.contact.terms import Contacts
from turgor.engine.linear import SingularTangentError
from turgor.engine.system import Evaluation, Stresses
from turgor.engine.tangent import Tangent
from turgor.solvers.constraints.constraint import NUDGE, Conditions, Control
from turgor.solvers.newton.newton import (
    KEEP_FACTORS_BELOW,
    KEEP_FACTORS_CONTRACTION,
    SHORTEST_STEP,
    SHORTEST_TOUCHING_STEP,
    NewtonSettings,
    Report,
    length_allowed,
    partners_settle,
    relative_residual,
)

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class BorderedStart:
    """Where it starts: unknowns, scalars, and the stresses of the first geometric stiffness."""

    unknowns: Array
    scalars: Array
    stresses: Stresses | None


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class BorderedResult:
    """How it ended: the last evaluation and scalars, the number of updates, the last residual, why it failed."""

    evaluation: Evaluation | None
    scalars: Array
    iterations: int
    residual: float
    converged: bool
    reason: str = ""
    hardest: int = 0


@dataclass(frozen=True, slots=True, eq=False)
class Rates:
    """How fast unknowns and scalars change with the parameter, and the unstable modes there.

    Parameters
    ----------
    unknowns : (size,) array
    scalars : (k,) array
    modes : int or None
    """

    unknowns: Array
    scalars: Array
    modes: int | None


@dataclass(slots=True, eq=False)
class _Border:
    """The factored tangent with its border."""

    tangent: Tangent
    responses: Array = field(default_factory=lambda: np.empty((0, 0)))

    def factor(self, control: Control, at: Evaluation, geometric: Stresses | None, jump: Array) -> Array:
        """Factor at an evaluation; return the forces that moving the held unknowns by ``jump`` would cause."""
        try:
            coupling = self.tangent.factor(at, geometric, jump)
        except SingularTangentError:
            if geometric is None:
                raise
            coupling = self.tangent.factor(at, None, jump)
        held = control.sought.system.held
        self.responses = np.array([self._solve(-column, held) for column in control.sought.columns(at)])
        return coupling

    def _solve(self, right: Array, held: NDArray[np.bool_]) -> Array:
        return self.tangent.solve(np.where(held, 0.0, right))

    def stiffness(self, conditions: Conditions) -> Array:
        """What is left of the conditions (k, k) once the unknowns are eliminated: D + C B."""
        return np.asarray(conditions.corner + conditions.rows @ self.responses.T)

    def update(self, right: Array, conditions: Conditions, errors: Array) -> tuple[Array, Array]:
        """Updates of unknowns and scalars for a right side of equilibrium and errors of the conditions."""
        free = self.tangent.solve(right)
        left = -errors - conditions.rows @ free
        scalars = np.asarray(np.linalg.solve(self.stiffness(conditions), left), dtype=np.float64)
        return free + scalars @ self.responses, scalars


def bordered_newton(
    control: Control,
    tangent: Tangent,
    start: BorderedStart,
    parameter: float,
    settings: NewtonSettings,
    report: Report,
) -> BorderedResult:
    """Find equilibrium and fulfill the conditions at a parameter; the start need not satisfy the supports."""
    system, border, scalars = control.sought.system, _Border(tangent), start.scalars
    at = _evaluate(control, tangent, start.unknowns, parameter, scalars)
    if at is None:
        return _failure(None, scalars, 0, np.inf, "the start turns a cell inside out")
    conditions = control.target.conditions(at.unknowns, parameter, scalars)
    residual = _residual(control, at, conditions)
    geometric = start.stresses if tangent.mixed_points else None
    fresh, settled, residuals = True, False, [residual]
    jump = system.prescribed(control.sought.load_factor(parameter, scalars)) - start.unknowns[system.held]
    for iteration in range(1, settings.max_iterations + 1):
        coupling = np.zeros(system.size)
        try:
            if fresh:
                coupling = border.factor(control, at, geometric, jump)
            right = -at.residual - coupling
            right[system.held] = jump
            update, change = border.update(right, conditions, conditions.errors)
        except (SingularTangentError, np.linalg.LinAlgError) as error:
            return _failure(at, scalars, iteration, residual, str(error))
        settled = settled or partners_settle(iteration, residuals)
        kept = at.contacts if settled else None
        new, length = _line_search(control, tangent, (at, update, scalars, change), parameter, kept)
        if new is None:
            return _failure(at, scalars, iteration, residual, "every update turns a cell inside out")
        jump = (1 - length) * jump  # the supports are satisfied by an update of full length
        scalars = scalars + length * change
        conditions = control.target.conditions(new.unknowns, parameter, scalars)
        previous, residual = residual, _residual(control, new, conditions)
        correction = length * float(np.abs(update).max()) / max(float(np.abs(new.unknowns).max()), 1e-300)
        residuals.append(residual)
        report(iteration, residual, correction, length)
        if residual <= settings.tolerance and not jump.any():
            return BorderedResult(
                evaluation=new, scalars=scalars, iterations=iteration, residual=residual, converged=True
            )
        contracting = residual < KEEP_FACTORS_CONTRACTION * previous and residual < KEEP_FACTORS_BELOW
        fresh = tangent.plain or bool(jump.any()) or not (contracting and length == 1)
        if tangent.mixed_points and fresh:
            geometric = system.stresses(at, length * update)
        at = new
    return _failure(at, scalars, iteration, residual, f"no convergence in {settings.max_iterations} iterations")


def rates(
    control: Control, tangent: Tangent, at: Evaluation, parameter: float, scalars: Array, ahead: bool = False
) -> Rates | None:
    """How unknowns and scalars change with the parameter up to a state, or ahead; None at a singular tangent."""
    system, border = control.sought.system, _Border(tangent)
    nudge = -NUDGE if ahead else NUDGE
    before = parameter - nudge
    factor, factor_before = (control.sought.load_factor(p, scalars) for p in (parameter, before))
    moved = np.zeros(system.size)
    moved[system.held] = (system.prescribed(factor) - system.prescribed(factor_before)) / nudge
    timed = control.clock.duration is not None
    if timed:  # rubber that relaxes does so on the way, too
        control.clock.begin(system, before)
    # not by the tangent, which leaves out what the pressure on a rim does when supports move it
    earlier = system.evaluate(at.unknowns - nudge * moved, factor_before, at.sought)
    if timed:
        control.clock.begin(system, parameter)
    if earlier is None:
        return None
    try:
        border.factor(control, at, None, np.zeros(int(system.held.sum())))
        right = np.where(system.held, moved, (earlier.residual - at.residual) / nudge)
        conditions = control.target.conditions(at.unknowns, parameter, scalars)
        drift = (conditions.errors - control.target.conditions(at.unknowns, before, scalars).errors) / nudge
        unknowns, change = border.update(right, conditions, drift)
    except (SingularTangentError, np.linalg.LinAlgError):
        return None
    return Rates(unknowns, change, control.sought.unstable(tangent.unstable_modes(), border.stiffness(conditions)))


def _residual(control: Control, at: Evaluation, conditions: Conditions) -> float:
    worst = float(np.abs(conditions.errors).max())
    return max(relative_residual(control.sought.system, at), worst) if np.isfinite(worst) else np.inf


def _evaluate(
    control: Control, tangent: Tangent, unknowns: Array, parameter: float, scalars: Array, kept: Contacts | None = None
) -> Evaluation | None:
    start = perf_counter()
    how = Look.FOLLOW if kept is None else Look.KEEP
    out = control.sought.evaluate(unknowns, parameter, scalars, kept, how)
    tangent.clock.residual += perf_counter() - start
    return out


def _line_search(
    control: Control,
    tangent: Tangent,
    step: tuple[Evaluation, Array, Array, Array],
    parameter: float,
    kept: Contacts | None,
) -> tuple[Evaluation | None, float]:
    """Shorten the update until no cell is turned inside out and no wall pressed too deep into another."""
    at, update, scalars, change = step
    system, length, found, shortest = control.sought.system, 1.0, None, SHORTEST_STEP
    while length >= shortest:
        new = _evaluate(control, tangent, at.unknowns + length * update, parameter, scalars + length * change, kept)
        share = 0.5 if new is None else length_allowed(system, at, new, update)
        if share == 1:
            return new, length
        if new is not None:
            found, shortest = (new, length), SHORTEST_TOUCHING_STEP
        length *= share
    return found or (None, 0.0)


def _failure(at: Evaluation | None, scalars: Array, iterations: int, residual: float, reason: str) -> BorderedResult:
    return BorderedResult(
        evaluation=at, scalars=scalars, iterations=iterations, residual=residual, converged=False, reason=reason
    )
