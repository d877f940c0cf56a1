"""buckling_modes: load factors at which an actuator buckles, by the tangent and its rate along the path.

With the tangent K at a state and its rate K' with the load factor along the path, the tangent is singular near
``load_factor + μ`` where ``K φ = −μ K' φ``. From rest this is linear buckling; from a state close to the critical load
it is exact. K' is a difference of two tangents, so that it holds for every law, load and sheet.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse.linalg import ArpackNoConvergence, LinearOperator, eigs

from turgor.core.engine.algebra.linear import SingularTangentError
from turgor.core.engine.algebra.tangent import Tangent
from turgor.core.engine.cells.internal_variables import History
from turgor.core.engine.evaluation import Evaluation
from turgor.core.engine.runtime import EngineOptions, use_threads
from turgor.core.engine.system import System
from turgor.core.engine.warmup.compiling import compile_kernels
from turgor.core.engine.warmup.needs import Needs
from turgor.core.model.continued_model import starting_loads
from turgor.core.model.drive import drive_text
from turgor.core.model.model import Model
from turgor.core.solvers.buckling.settings import BUCKLING
from turgor.core.solvers.continuation.scalar_control.arc_length import check_proportional, check_still
from turgor.core.solvers.continuation.tangent_response import load_response
from turgor.core.solvers.dynamics.modes import check_elastic
from turgor.core.solvers.restart import unknowns_of
from turgor.core.solvers.solution import State
from turgor.foundation.display import brief
from turgor.foundation.errors import TurgorError
from turgor.foundation.given import one

Array = NDArray[np.float64]

#: Unknowns (size,) and load factor of a state, and what its rubber remembers.
Place = tuple[Array, float, History | None]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class BucklingModes:
    """Load factors at which an actuator buckles, from the lowest, and the shapes in which it does.

    Parameters
    ----------
    model : Model
        The question.
    load_factor : float [-]
        Load factor of the state that the modes are computed at; 0 at rest.
    displacement : (n, 3) array [m]
        Displacement of that state.
    load_factors : (k,) array [-]
        Load factors at which the tangent becomes singular, rising, above ``load_factor``.
    shapes : (k, n, 3) array [-]
        Displacement of every node in each mode; the largest is 1 long.
    """

    model: Model
    load_factor: float
    displacement: Array
    load_factors: Array
    shapes: Array

    __repr__ = brief

    @property
    def by_mode(self) -> tuple[tuple[str, Array, str], ...]:
        """Name, values (k,) and unit of what each mode has."""
        return (("load_factor", self.load_factors, ""),)

    @property
    def message(self) -> str:
        """The load factors in one sentence, with the pressures of the lowest."""
        if not len(self.load_factors):
            return (
                f"No load factor above {self.load_factor:.4g} makes the tangent singular: the load stiffens the body."
            )
        first = float(self.load_factors[0])
        pressures = drive_text(self.model, first)
        factors = ", ".join(f"{factor:.4g}" for factor in self.load_factors)
        return (
            f"Buckles at load factor{'s' if len(self.load_factors) > 1 else ''} {factors}"
            f"{f' (the first: {pressures})' if pressures else ''}, from the tangent at load factor "
            f"{self.load_factor:.4g}."
        )


def buckling_modes(
    model: Model, state: State | None = None, count: int = 4, *, options: EngineOptions | None = None
) -> BucklingModes:
    """Compute the lowest load factors at which a model buckles.

    The change of the tangent with the load is continued in a straight line from rest or from a state of a path. Where
    the body deforms little before it buckles, rest will do. Elsewhere start from a state closer to the load factor:
    the difference of two such answers says how far they can be trusted. A half model has the modes that are symmetric
    about its mirror planes, and no others.

    Parameters
    ----------
    model : Model
        What buckles. All its loads grow in proportion to the load factor, its supports stay in place.
    state : State, optional
        The stable equilibrium from which it is continued, from `solve`; rest by default.
    count : int
        How many modes, 1 to 20.
    options : EngineOptions, optional
        Linear solver, threads.

    Returns
    -------
    BucklingModes
        Fewer than ``count`` where fewer load factors are above that of the state.

    Raises
    ------
    TurgorError
        If the count is out of range, a load does not grow in proportion or has no potential, a support moves, the
        tangent is singular at the state, or a load is there from the start and no state is given.
    """
    one(model, Model, "model", "a Model is needed")
    if not 1 <= count <= BUCKLING.most_modes:
        raise TurgorError(f"count is {count}; allowed is 1 to {BUCKLING.most_modes}.")
    check_proportional(model, "buckling_modes")
    if state is None and starting_loads(model):
        raise TurgorError(
            "a load is there from the start, so that rest is no equilibrium; give the state at load factor 0, or a "
            "later one, of a solution (--at of turgor buckling)."
        )
    options = options or EngineOptions()
    with use_threads(options.threads):
        compile_kernels(options.notify, Needs.of(model))
        system = System(model)
        check_still(system, "buckling_modes")
        _check(system)
        unknowns = np.zeros(system.size) if state is None else unknowns_of(system, state)
        load_factor = 0.0 if state is None else state.load_factor
        memory = None if state is None or state.memory is None else state.memory.without_friction
        history = system.history(memory, np.inf)  # slowly
        tangent = Tangent(system, options.linear_solver, options.threads)
        factors, vectors = _solve(system, tangent, (unknowns, load_factor, history), count)
    return BucklingModes(
        model=model,
        load_factor=load_factor,
        displacement=system.physical(unknowns)[0],
        load_factors=load_factor + factors,
        shapes=np.array([_shape(system, each) for each in vectors]).reshape(-1, *model.mesh.points.shape),
    )


def _check(system: System) -> None:
    if not system.full_force:
        raise TurgorError("nothing loads the model, so that nothing buckles; state a pressure or a force in its loads.")


def _solve(system: System, tangent: Tangent, at: Place, count: int) -> tuple[Array, Array]:
    """Positive μ (k,), rising, and their vectors (k, size), of ``K φ = −μ K' φ``."""
    unknowns, load_factor, _ = at
    here = _evaluated(system, at)
    check_elastic(system, _evaluated(system, (unknowns, 1.0, at[2])))  # at rest no load acts that could be refused
    tangent.use_double()
    try:
        tangent.factor(here)
    except SingularTangentError as error:
        raise TurgorError("the tangent is singular at this state; start from rest or a state before it.") from error
    if tangent.unstable_modes():
        raise TurgorError(
            f"the state at load factor {load_factor:.4g} is unstable; start from rest, or from a state before it."
        )
    rate = tangent_rate(system, at, load_response(system, tangent, unknowns))
    free = ~system.prescribed

    def softened(vector: Array) -> Array:
        return tangent.solve(np.where(free, -system.pattern.product(rate, np.where(free, vector, 0.0)), 0.0))

    operator = LinearOperator((system.size, system.size), matvec=softened, dtype=np.float64)
    begin = softened(np.where(system.moving & free, np.random.default_rng(1).normal(size=system.size), 0.0))
    if not begin.any():
        return np.zeros(0), np.zeros((0, system.size))
    try:
        values, vectors = eigs(operator, k=count, which="LR", v0=begin, ncv=max(4 * count, 20), tol=BUCKLING.tolerance)
    except ArpackNoConvergence as error:
        values, vectors = error.eigenvalues, error.eigenvectors
    softening = (values.real > BUCKLING.smallest) & (abs(values.imag) < BUCKLING.real_share * abs(values))
    chosen = np.flatnonzero(softening)
    chosen = chosen[np.argsort(-values.real[chosen])]
    return 1 / values.real[chosen], vectors.real.T[chosen]


def tangent_rate(system: System, at: Place, response: Array) -> Array:
    """Rate (nnz,) of the tangent's lower triangle with the load factor along the path, by a central difference."""
    (unknowns, load_factor, history), largest = at, float(np.abs(response[system.moving]).max(initial=0.0))
    step = BUCKLING.nudge / max(largest, BUCKLING.nudge)
    sides = []
    for sign in (1, -1):
        sides.append(tangent_at(system, (unknowns + sign * step * response, load_factor + sign * step, history)))
    return np.asarray((sides[0] - sides[1]) / (2 * step))


def tangent_at(system: System, at: Place) -> Array:
    """Values (nnz,) of the exact tangent's lower triangle, supports not yet applied."""
    return system.tangent_data(_evaluated(system, at), None, True)


def _evaluated(system: System, at: Place) -> Evaluation:
    unknowns, load_factor, history = at
    there = system.evaluate(unknowns, load_factor, history=history)
    if there is None:
        raise TurgorError("the state turns a cell inside out; it is no equilibrium of this model.")
    return there


def _shape(system: System, vector: Array) -> Array:
    """Displacement (n, 3) of the nodes in a mode; its largest vector is 1 long and points along positive axes."""
    motion = np.where(system.prescribed | ~system.moving, 0.0, vector)
    shape = system.displacement(motion)
    size = np.linalg.norm(shape, axis=1)
    largest = float(size.max()) * (1 if shape[size.argmax()].sum() >= 0 else -1)
    return np.asarray(shape / largest)
