"""Newton's method for one load factor: update, line search, convergence.

Two things make it cheaper than the textbook. The geometric stiffness uses the stress linearized from the last iterate
(mixed integration points, Magisano, Leonetti and Garcea 2017, doi 10.1016/j.cma.2016.10.023), which converges from
farther away. And factors are kept while they still contract the residual well, because a residual costs a
twentieth of a factorization.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from time import perf_counter

import numpy as np
from numpy.typing import NDArray

from turgor.engine.contact.part import Look
from turgor.engine.contact.terms import Contacts
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

#: Scaled force on a node with which forces are compared at least, as where a body is moved that nothing loads.
UNLOADED = 3e-8

#: The partners of contact are looked for anew in so many updates, then kept: at a wedge they may change forever.
KEEP_PARTNERS_AFTER = 8

#: They are kept earlier where the residual is this small and falls no more.
SMALL_RESIDUAL = 0.05

#: Where a body has moved by more than this share of its largest displacement since the tangent was last factored, its
#: factors do not count the unstable modes of where it is.
STALE = 0.05

#: Shortest update that the line search tries; and where walls are pressed into each other.
SHORTEST_STEP = 1.0 / 64
SHORTEST_TOUCHING_STEP = 1.0 / 32

#: It gives up where so many updates in a row are cut to the shortest because they press walls too deep.
CUT_SHORT = 3

#: With friction, an update is too long where the force along it turns around, to more than this share of before.
OVERSHOT = 0.9


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
    """

    tolerance: float = 1e-6
    max_iterations: int = 15
    mixed_points: bool = True
    count_anew: bool = False


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class NewtonResult:
    """How it ended: the last evaluation, the number of updates, the last relative residual, why it failed.

    ``hardest`` is the number of updates of the longest pass, where friction and stiffness were renewed.
    """

    evaluation: Evaluation | None
    iterations: int
    residual: float
    converged: bool
    unstable_modes: int | None = None
    reason: str = ""
    hardest: int = 0


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
    fresh : bool
        Whether the first update needs factors of its own, or those of the last solve will do.
    """

    unknowns: Array
    stresses: Stresses
    evaluation: Evaluation | None = None
    fresh: bool = True


Report = Callable[[int, float, float, float], None]  # iteration, residual, correction, step length


def relative_residual(system: System, at: Evaluation) -> float:
    """Largest of the unbalanced force relative to external forces and reactions, and the relative volume error."""
    displacement = 3 * system.node_count
    held = system.held[:displacement]
    force = at.residual[:displacement]
    scale = max(
        float(np.linalg.norm(at.external[:displacement][~held])),
        float(np.linalg.norm(force[held])),
        at.contact_force,
        SMALL_FORCE * system.full_force,
        UNLOADED * np.sqrt(system.node_count),  # an unloaded body: nothing to compare with but round-off
    )
    bodies = slice(displacement + system.element.mean_count, None)
    loose = at.residual[bodies][~system.held[bodies]]
    unbalanced = float(np.hypot(np.linalg.norm(force[~held]), np.linalg.norm(loose))) / scale
    if not system.element.mean_count:
        return unbalanced
    means = slice(displacement, displacement + system.element.mean_count)
    volume = float(np.linalg.norm(at.residual[means])) / float(np.linalg.norm(system.mean_stress_volumes))
    return max(unbalanced, volume)


def newton(
    system: System, tangent: Tangent, start: Start, load_factor: float, settings: NewtonSettings, report: Report
) -> NewtonResult:
    """Find equilibrium at a load factor from a start; the start need not satisfy the supports."""
    at = start.evaluation or evaluate(system, tangent, start.unknowns, load_factor)
    if at is None:
        return _failure(None, 0, np.inf, "the start turns a cell inside out")
    residual = relative_residual(system, at)
    mixed = tangent.mixed_points and settings.mixed_points
    geometric = start.stresses if mixed else None
    jump = system.prescribed(load_factor) - start.unknowns[system.held]
    fresh = start.fresh or bool(jump.any())
    settled, residuals, lengths, moved = False, [residual], [1.0], 0.0
    for iteration in range(1, settings.max_iterations + 1):
        coupling = np.zeros(system.size)
        if fresh:
            try:
                coupling, moved = tangent.factor(at, geometric, jump), 0.0
            except SingularTangentError as error:
                return _failure(at, iteration, residual, str(error))
        right = -at.residual - coupling
        right[system.held] = jump
        update = tangent.solve(right)
        settled = settled or partners_settle(iteration, residuals)
        kept = at.contacts if settled else None
        new, length = _line_search(system, tangent, at, update, kept)
        if new is None:
            return _failure(at, iteration, residual, "every update turns a cell inside out", tangent)
        jump = (1 - length) * jump  # the supports are satisfied by an update of full length
        previous, residual = residual, relative_residual(system, new)
        correction = length * float(np.abs(update).max()) / max(float(np.abs(new.unknowns).max()), 1e-300)
        residuals.append(residual)
        lengths.append(length)
        moved += correction
        report(iteration, residual, correction, length)
        if residual <= settings.tolerance and not jump.any():
            return _success(tangent, new, iteration, residual, settings.count_anew and moved > STALE)
        if system.contact.parts and max(lengths[-CUT_SHORT:]) <= SHORTEST_TOUCHING_STEP:
            return _failure(at, iteration, residual, "every update presses walls too deep", tangent)
        contracting = residual < KEEP_FACTORS_CONTRACTION * previous and residual < KEEP_FACTORS_BELOW
        fresh = tangent.plain or bool(jump.any()) or not (contracting and length == 1)
        if mixed and fresh:
            geometric = _linearized(system, tangent, at, length * update)
        at = new
    return _failure(at, iteration, residual, f"no convergence in {settings.max_iterations} iterations", tangent)


def _success(tangent: Tangent, at: Evaluation, iterations: int, residual: float, stale: bool) -> NewtonResult:
    """Count the unstable modes from the last factors, and where these find any or are stale, at the state itself."""
    modes = tangent.unstable_modes()
    if modes or stale:
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


def evaluate(
    system: System, tangent: Tangent, unknowns: Array, load_factor: float, kept: Contacts | None = None
) -> Evaluation | None:
    """Evaluate the residual on the clock."""
    start = perf_counter()
    how = Look.FOLLOW if kept is None else Look.KEEP
    out = system.evaluate(unknowns, load_factor, known=kept, how=how)
    tangent.clock.residual += perf_counter() - start
    return out


def _linearized(system: System, tangent: Tangent, at: Evaluation, update: Array) -> Stresses:
    start = perf_counter()
    out = system.stresses(at, update)
    tangent.clock.residual += perf_counter() - start
    return out


def _line_search(
    system: System, tangent: Tangent, at: Evaluation, update: Array, kept: Contacts | None
) -> tuple[Evaluation | None, float]:
    """Shorten the update until no cell is turned inside out, and where something touches, until it is no overshoot."""
    length, found = 1.0, None
    shortest = SHORTEST_STEP
    while length >= shortest:
        new = evaluate(system, tangent, at.unknowns + length * update, at.load_factor, kept)
        share = 0.5 if new is None else length_allowed(system, at, new, update)
        if share == 1:
            return new, length
        if new is not None:
            found, shortest = (new, length), SHORTEST_TOUCHING_STEP
        length *= share
    return found or (None, 0.0)


def length_allowed(system: System, at: Evaluation, new: Evaluation, update: Array) -> float:
    """Share of an update to be taken: less than 1 where walls are pressed too deep, or friction turns around."""
    share = system.contact.shortening(at.contacts, new.contacts)
    if share < 1 or not system.contact.rubs:
        return share
    free = ~system.held[: 3 * system.node_count]
    along = update[: len(free)][free]
    before, after = float(at.residual[: len(free)][free] @ along), float(new.residual[: len(free)][free] @ along)
    return 0.5 if after * before < 0 and abs(after) > OVERSHOT * abs(before) else 1.0


def partners_settle(iteration: int, residuals: Sequence[float]) -> bool:
    """Whether partners of contact are kept: late, or where the residual is small and did not halve in two updates."""
    stagnates = len(residuals) > 3 and residuals[-1] < SMALL_RESIDUAL and residuals[-1] > 0.5 * residuals[-3]
    return stagnates or iteration > KEEP_PARTNERS_AFTER
