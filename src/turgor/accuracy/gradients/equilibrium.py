"""Equilibrium: a state of a path as a solution of its equations, with the factors of their tangent at hand."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from math import inf

import numpy as np
from numpy.typing import NDArray

from turgor.accuracy.gradients.checks import limit_point
from turgor.accuracy.gradients.settings import GRADIENTS
from turgor.accuracy.gradients.systems import Systems
from turgor.core.engine.algebra.linear import SingularTangentError
from turgor.core.engine.chamber_volumes import Chambers
from turgor.core.engine.runtime import EngineOptions
from turgor.core.engine.system import Evaluation, System
from turgor.core.solvers.constraints.cavities import CavityPressures
from turgor.core.solvers.constraints.constraint import Constraint
from turgor.core.solvers.constraints.elimination import Conditions
from turgor.core.solvers.constraints.loads import load_control
from turgor.core.solvers.listeners import silent
from turgor.core.solvers.newton.border import Border
from turgor.core.solvers.newton.contact_newton import newton_with_contact
from turgor.core.solvers.newton.convergence import whole_residual
from turgor.core.solvers.newton.newton_values import NewtonResult, NewtonSettings, Start
from turgor.core.solvers.procedures.procedure import Procedure
from turgor.core.solvers.restart import unknowns_of
from turgor.core.solvers.solution import State

Array = NDArray[np.float64]
Pair = tuple[Array, Array]

#: Relative residual of the state before it is differentiated: the derivative is off by about as much as the state.
SETTINGS = NewtonSettings(tolerance=1e-9, max_iterations=12, mixed_points=False)


@dataclass(frozen=True, eq=False)
class Equilibrium:
    """A state as a solution of its equations.

    Parameters
    ----------
    state : State
    procedure : Procedure
        That found it.
    system : System
    border : Border
        Factored at the state.
    constraint : Constraint
        What holds there: given loads, or given volumes or amounts of gas.
    at : Evaluation
    scalars : (k,) array
        The unknown pressures.
    systems : Systems
        Equations that were set up before.
    """

    state: State
    procedure: Procedure
    system: System
    border: Border
    constraint: Constraint
    at: Evaluation
    scalars: Array
    systems: Systems

    @cached_property
    def conditions(self) -> Conditions:
        """The conditions on the scalars, and their derivatives by unknowns and scalars."""
        return self.constraint.target.conditions(self.at.unknowns, self.state.load_factor, self.scalars)

    @cached_property
    def columns(self) -> Array:
        """Derivatives (k, size) of the residual by the scalars, zero at fixed unknowns."""
        return np.where(self.system.prescribed, 0.0, self.constraint.scalar_unknowns.columns(self.at))

    def answer(self, right: Array, errors: Array) -> tuple[Array, Array]:
        """Changes of unknowns and scalars that right sides of equilibrium and conditions cause, refined.

        Factors may be in single precision, and a long soft body amplifies what is left by the square of its length over
        its thickness. So the answer is refined against the matrix until nothing more is gained.
        """

        def once(residual: Array, wrong: Array) -> Pair:
            return self.border.update(residual, self.conditions, -wrong)

        def residual_of(unknowns: Array, scalars: Array) -> Pair:
            forces = right - self.border.tangent.product(unknowns) - scalars @ self.columns
            return forces, errors - self.conditions.rows @ unknowns - self.conditions.corner @ scalars

        return _refined(once, residual_of, (right, errors))

    def transposed_answer(self, right: Array) -> tuple[Array, Array]:
        """Solve the transposed equations, with zero for the conditions: Kᵀ a + Cᵀ b = right, Fᵀ a + Dᵀ b = 0.

        The tangent must be symmetric.
        """
        rows, corner = np.where(self.system.prescribed, 0.0, self.conditions.rows), self.conditions.corner.T
        tangent = self.border.tangent
        solved = np.array([tangent.solve(row) for row in rows]).reshape(rows.shape)
        small = corner - self.columns @ solved.T

        def once(residual: Array, wrong: Array) -> Pair:
            free = tangent.solve(residual)
            scalars = np.asarray(np.linalg.solve(small, wrong - self.columns @ free), dtype=np.float64)
            return free - scalars @ solved, scalars

        def residual_of(unknowns: Array, scalars: Array) -> Pair:
            wrong = self.columns @ unknowns + corner @ scalars
            return right - tangent.product(unknowns) - scalars @ rows, -wrong

        return _refined(once, residual_of, (right, np.zeros(len(self.scalars))))


def _refined(once: Callable[[Array, Array], Pair], residual_of: Callable[[Array, Array], Pair], right: Pair) -> Pair:
    """Solve a bordered system by its factors, and refine the answer until nothing more is gained."""
    unknowns, scalars = once(*right)
    before = np.inf
    for _ in range(GRADIENTS.corrections):
        update, change = once(*residual_of(unknowns, scalars))
        size = float(np.linalg.norm(update)) / max(float(np.linalg.norm(unknowns)), 1e-300)
        if size > GRADIENTS.contraction * before:
            break
        unknowns, scalars = unknowns + update, scalars + change
        if size * size < GRADIENTS.refined * min(before, 1.0):  # the next update would be smaller by as much again
            break
        before = size
    return unknowns, scalars


def equilibrium_of(
    state: State, procedure: Procedure, options: EngineOptions, systems: Systems | None = None
) -> Equilibrium:
    """Find a state again, more accurately than a solve does, and factor the tangent there.

    Parameters
    ----------
    state : State
    procedure : Procedure
    options : EngineOptions
    systems : Systems, optional
        Where several states of a path are differentiated.

    Returns
    -------
    Equilibrium

    Raises
    ------
    TurgorError
        If Newton's method does not find the state, or the tangent is singular there.
    """
    systems = systems or Systems()
    system = systems.of(state.model, procedure.filled(state.model))
    constraint = constraint_of(system, state, procedure)
    try:
        result, border = _solved_again(state, constraint, options, systems)
    except (SingularTangentError, np.linalg.LinAlgError):
        raise limit_point(state) from None
    at = result.evaluation
    assert at is not None  # _solved_again has it
    conditions = constraint.target.conditions(at.unknowns, state.load_factor, result.scalars)
    if state.displacement.any() and whole_residual(system, at, conditions) > GRADIENTS.accurate:
        raise limit_point(state)
    return Equilibrium(state, procedure, system, border, constraint, at, result.scalars, systems)


def _solved_again(
    state: State, constraint: Constraint, options: EngineOptions, systems: Systems
) -> tuple[NewtonResult, Border]:
    """Newton's method from a state, with factors of the tangent where it begins, and the tangent where it ends.

    What a solve leaves takes one update as a rule, after which the factors are as good as new: answers are refined.
    """
    system = constraint.scalar_unknowns.system
    scalars = np.array([state.pressures[name] for name in system.controlled]) / system.stress_scale
    unknowns = unknowns_of(system, state)
    if not len(scalars):  # supports are where they should be, up to round-off
        unknowns[system.prescribed] = system.prescribed_values(state.load_factor)
    begin = constraint.evaluate(unknowns, state.load_factor, scalars)
    if begin is None:
        raise limit_point(state)
    system.lay_out(begin)  # the tangent is analyzed once, with what touches
    tangent = systems.tangent_of(state.model, system, options)
    border = Border(constraint, tangent)
    if not len(scalars):
        border.factor(begin, None, np.zeros(int(system.prescribed.sum())))
    start = Start(unknowns, None, scalars, begin, fresh=bool(len(scalars)))
    loaded = bool(state.displacement.any())  # at rest there is nothing but round-off to compare a residual with
    settings = SETTINGS if loaded else replace(SETTINGS, max_iterations=1)
    result = newton_with_contact(constraint, tangent, start, state.load_factor, settings, silent)
    at = result.evaluation
    if at is None or not np.isfinite(result.residual):
        raise limit_point(state)
    if result.iterations > GRADIENTS.few_updates:
        border.factor(at, None, np.zeros(int(system.prescribed.sum())))
    border.renew(at)
    return result, border


def constraint_of(system: System, state: State, procedure: Procedure) -> Constraint:
    """Return what holds at a state: loads at its load factor, or the volumes or amounts of gas of its cavities.

    Along `ArcLength` and `Auto` the loads are given, too: the question is how a measure changes at the same load.

    Parameters
    ----------
    system : System
        Of the model of the state, or of one that differs a little.
    state : State
    procedure : Procedure

    Returns
    -------
    Constraint
    """
    history = system.history(step=inf)
    if not system.controlled:
        return load_control(system, history=history)
    chambers = Chambers(system, system.controlled)
    rest = chambers.volumes(np.zeros(system.size))
    target = procedure.target(chambers, rest, np.zeros(len(rest)))
    return Constraint.of(CavityPressures(system), target, history=history)
