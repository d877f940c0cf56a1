"""Border: solve for unknowns and a few scalars together, by the factors of the tangent alone.

The bordered system is K Δu + F Δs = −r and C Δu + D Δs = −c. The first equation is solved for several right sides, Δu =
a + B Δs; the second then gives the few Δs: (D + C B) Δs = −c − C a (block elimination). At a limit point K is singular
although the bordered matrix is not. Near that point B is large and Δu is the difference of large numbers. The update
loses digits, the solution does not, because the residual decides. If a factorization fails at the point itself, it is
repeated without the linearized stress of the mixed integration points, which changes the tangent a little. Without
scalars (k = 0) this is the plain linear solve, and a singular tangent is a failure.
"""

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.algebra.linear import REFINED, SingularTangentError
from turgor.core.engine.algebra.tangent import Tangent
from turgor.core.engine.system import Evaluation, Stresses
from turgor.core.solvers.constraints.constraint import NUDGE, Constraint
from turgor.core.solvers.constraints.elimination import Conditions, eliminated

Array = NDArray[np.float64]


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
class Border:
    """The factored tangent with its border of k rows and columns."""

    constraint: Constraint
    tangent: Tangent
    responses: Array = field(default_factory=lambda: np.empty((0, 0)))

    def factor(self, at: Evaluation, geometric: Stresses | None, jump: Array) -> Array:
        """Factor at an evaluation; return the forces that moving the prescribed unknowns by ``jump`` would cause."""
        try:
            coupling = self.tangent.factor(at, geometric, jump)
        except SingularTangentError:
            if geometric is None or not len(self.constraint.scalar_unknowns.columns(at)):
                raise
            coupling = self.tangent.factor(at, None, jump)
        self._respond(at)
        return coupling

    def renew(self, at: Evaluation) -> None:
        """Form the tangent again and keep its factors, as `Tangent.renew` does."""
        self.tangent.renew(at)
        self._respond(at)

    def _respond(self, at: Evaluation) -> None:
        """Solve for what the scalars cause."""
        scalar_unknowns = self.constraint.scalar_unknowns
        columns = scalar_unknowns.columns(at)
        self.responses = np.empty_like(columns)
        for number, column in enumerate(columns):
            self.responses[number] = self.tangent.solve(np.where(scalar_unknowns.system.prescribed, 0.0, -column))

    def stiffness(self, conditions: Conditions) -> Array:
        """Schur complement (k, k) of the tangent in the bordered matrix: D + C B."""
        return np.asarray(conditions.corner + conditions.rows @ self.responses.T)

    def newton_update(
        self,
        at: Evaluation,
        linearized: tuple[Stresses | None, Array, bool],
        conditions: Conditions,
        reduction: float,
    ) -> tuple[Array, Array]:
        """Updates of Newton's method at an evaluation.

        Parameters
        ----------
        at : Evaluation
        linearized : (Stresses or None, array, bool)
            Stresses of the geometric stiffness, what the prescribed unknowns still have to move, and whether the
            tangent is factored at the evaluation, or the last factors are used again.
        conditions : Conditions
        reduction : float
            Relative residual that the linear solution may leave.

        Returns
        -------
        ((size,) array, (k,) array)
        """
        (geometric, jump, fresh), prescribed = linearized, self.constraint.scalar_unknowns.system.prescribed
        right = -at.residual
        if fresh:
            right = right - self.factor(at, geometric, jump)
        right[prescribed] = jump
        return self.update(right, conditions, conditions.errors, reduction)

    def update(
        self, right: Array, conditions: Conditions, errors: Array, reduction: float = REFINED
    ) -> tuple[Array, Array]:
        """Updates of unknowns and scalars for a right side of equilibrium and errors of the conditions.

        The linear solution may leave a relative residual of ``reduction``.
        """
        free = self.tangent.solve(right, reduction)
        if not len(errors):
            return free, errors
        return eliminated(free, self.responses, conditions, errors)


def rates(
    constraint: Constraint, tangent: Tangent, at: Evaluation, parameter: float, scalars: Array, ahead: bool = False
) -> Rates | None:
    """How unknowns and scalars change with the parameter up to a state, or ahead; None at a singular tangent."""
    scalar_unknowns, border = constraint.scalar_unknowns, Border(constraint, tangent)
    nudge = -NUDGE if ahead else NUDGE
    moved, force = push(constraint, at, parameter, scalars, nudge)
    if force is None:
        return None
    try:
        border.factor(at, None, np.zeros(int(scalar_unknowns.system.prescribed.sum())))
        right = np.where(scalar_unknowns.system.prescribed, moved, force)
        conditions = constraint.target.conditions(at.unknowns, parameter, scalars)
        shifted = constraint.target.conditions(at.unknowns, parameter - nudge, scalars)
        unknowns, change = border.update(right, conditions, (conditions.errors - shifted.errors) / nudge)
    except (SingularTangentError, np.linalg.LinAlgError):
        return None
    return Rates(unknowns, change, scalar_unknowns.unstable(tangent.unstable_modes(), border.stiffness(conditions)))


def push(
    constraint: Constraint, at: Evaluation, parameter: float, scalars: Array, nudge: float
) -> tuple[Array, Array | None]:
    """Rates (size,) of prescribed unknowns with the parameter, and of the force that drives the others; None at a fold.

    All that a parameter drives takes part: loads, supports, obstacles, what rubber and friction remember. The
    difference of two residuals is taken, a ``nudge`` before the state with the supports moved back, not the tangent,
    which leaves out what the pressure on a rim does when supports move it.
    """
    system, before = constraint.scalar_unknowns.system, parameter - nudge
    factor, factor_before = (constraint.scalar_unknowns.load_factor(p, scalars) for p in (parameter, before))
    moved = np.zeros(system.size)
    moved[system.prescribed] = (system.prescribed_values(factor) - system.prescribed_values(factor_before)) / nudge
    history = at.history
    if constraint.clock.duration is not None:  # rubber that relaxes does so on the way, too
        history = system.history(constraint.memory, constraint.clock.step_to(before))
    there = at.unknowns - nudge * moved
    earlier = system.evaluate(there, factor_before, at.unknown_pressures, history=history, addition=at.addition)
    return moved, None if earlier is None else (earlier.residual - at.residual) / nudge
