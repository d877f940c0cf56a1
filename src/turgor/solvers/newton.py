"""Newton's method for one load factor: update, line search, convergence.

Two things make it cheaper than the textbook. The geometric stiffness uses the stress linearized from the last iterate
(mixed integration points, Magisano, Leonetti and Garcea 2017, doi 10.1016/j.cma.2016.10.023), which converges from
farther away. And factors are kept while they still contract the residual well, because a residual costs a
twentieth of a factorization.
"""

from collections.abc import Callable
from dataclasses import dataclass
from time import perf_counter

import numpy as np
from numpy.typing import NDArray

from turgor.engine.linear import SingularTangentError
from turgor.engine.system import Evaluation, Stresses, System
from turgor.engine.tangent import Tangent

Array = NDArray[np.float64]

#: Old factors are kept once the residual is this small and while each update reduces it below a tenth. Earlier they do
#: harm: while a stiff membrane is still being straightened out, a falling residual does not tell that they are good.
KEEP_FACTORS_BELOW = 1e-3
KEEP_FACTORS_CONTRACTION = 0.1

#: Forces are compared with this share of the full load at least: where all pressures have fallen back to zero, nothing
#: but round-off would be left to compare with.
SMALL_FORCE = 1e-5

#: Shortest update that the line search tries.
SHORTEST_STEP = 1.0 / 64


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
        Whether the geometric stiffness uses the linearized stress.
    keep_factors : bool
        Whether factors are used again while they contract well.
    """

    tolerance: float = 1e-6
    max_iterations: int = 15
    mixed_points: bool = True
    keep_factors: bool = True


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class NewtonResult:
    """How it ended: the last evaluation, the number of updates, the last relative residual, why it failed."""

    evaluation: Evaluation | None
    iterations: int
    residual: float
    converged: bool
    unstable_modes: int | None = None
    reason: str = ""


@dataclass(frozen=True, slots=True, eq=False)
class Start:
    """Where Newton's method starts.

    Parameters
    ----------
    unknowns : (size,) array
    stresses : Stresses
        For the geometric stiffness of the first update.
    evaluation : Evaluation or None
        The equations there, where they were evaluated already.
    """

    unknowns: Array
    stresses: Stresses
    evaluation: Evaluation | None = None


Report = Callable[[int, float, float, float], None]  # iteration, residual, correction, step length


def relative_residual(system: System, at: Evaluation) -> float:
    """Largest of the unbalanced force relative to external forces and reactions, and the relative volume error."""
    displacement = 3 * system.node_count
    held = system.held[:displacement]
    force = at.residual[:displacement]
    scale = max(
        float(np.linalg.norm(at.external[:displacement][~held])),
        float(np.linalg.norm(force[held])),
        SMALL_FORCE * system.full_force,
        1e-14 * np.sqrt(system.node_count),  # an unloaded body: nothing to compare with but round-off
    )
    unbalanced = float(np.linalg.norm(force[~held])) / scale
    if not system.element.mean_count:
        return unbalanced
    volume = float(np.linalg.norm(at.residual[displacement:])) / float(np.linalg.norm(system.mean_stress_volumes))
    return max(unbalanced, volume)


def newton(
    system: System, tangent: Tangent, start: Start, load_factor: float, settings: NewtonSettings, report: Report
) -> NewtonResult:
    """Find equilibrium at a load factor from a start; the start need not satisfy the supports."""
    at = start.evaluation or evaluate(system, tangent, start.unknowns, load_factor)
    if at is None:
        return _failure(None, 0, np.inf, "the start turns a cell inside out")
    residual = relative_residual(system, at)
    geometric = start.stresses if settings.mixed_points else None
    jump = system.prescribed(load_factor) - start.unknowns[system.held]
    fresh = True
    for iteration in range(1, settings.max_iterations + 1):
        coupling = np.zeros(system.size)
        if fresh:
            try:
                coupling = tangent.factor(at, geometric, jump)
            except SingularTangentError as error:
                return _failure(at, iteration, residual, str(error))
        right = -at.residual - coupling
        right[system.held] = jump
        jump = np.zeros_like(jump)  # the supports are satisfied after the first update
        update = tangent.solve(right)
        new, length = _line_search(system, tangent, at, update)
        if new is None:
            return _failure(at, iteration, residual, "every update turns a cell inside out", tangent)
        previous, residual = residual, relative_residual(system, new)
        correction = length * float(np.abs(update).max()) / max(float(np.abs(new.unknowns).max()), 1e-300)
        report(iteration, residual, correction, length)
        if residual <= settings.tolerance:
            return _success(tangent, new, iteration, residual)
        contracting = residual < KEEP_FACTORS_CONTRACTION * previous and residual < KEEP_FACTORS_BELOW
        fresh = not (settings.keep_factors and contracting and length == 1)
        if settings.mixed_points and fresh:
            geometric = _linearized(system, tangent, at, length * update)
        at = new
    return _failure(at, iteration, residual, f"no convergence in {settings.max_iterations} iterations", tangent)


def _success(tangent: Tangent, at: Evaluation, iterations: int, residual: float) -> NewtonResult:
    """Count the unstable modes from the last factors, and where these find any, at the state itself."""
    modes = tangent.unstable_modes()
    if modes:
        try:
            tangent.factor(at)
            modes = tangent.unstable_modes()
        except SingularTangentError:
            pass  # a singular tangent at the state: the count of the last iterate stands
    return NewtonResult(evaluation=at, iterations=iterations, residual=residual, converged=True, unstable_modes=modes)


def _failure(
    at: Evaluation | None, iterations: int, residual: float, reason: str, tangent: Tangent | None = None
) -> NewtonResult:
    modes = None if tangent is None else tangent.unstable_modes()
    return NewtonResult(
        evaluation=at, iterations=iterations, residual=residual, converged=False, unstable_modes=modes, reason=reason
    )


def evaluate(system: System, tangent: Tangent, unknowns: Array, load_factor: float) -> Evaluation | None:
    """Evaluate the residual on the clock."""
    start = perf_counter()
    out = system.evaluate(unknowns, load_factor)
    tangent.clock.residual += perf_counter() - start
    return out


def _linearized(system: System, tangent: Tangent, at: Evaluation, update: Array) -> Stresses:
    start = perf_counter()
    out = system.stresses(at, update)
    tangent.clock.residual += perf_counter() - start
    return out


def _line_search(system: System, tangent: Tangent, at: Evaluation, update: Array) -> tuple[Evaluation | None, float]:
    """Shorten the update until no cell is turned inside out."""
    length = 1.0
    while length >= SHORTEST_STEP:
        new = evaluate(system, tangent, at.unknowns + length * update, at.load_factor)
        if new is not None:
            return new, length
        length *= 0.5
    return None, 0.0
