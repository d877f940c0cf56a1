"""natural_frequencies: small vibrations of an actuator at rest or about a loaded state."""

from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import NDArray
from scipy.sparse.linalg import ArpackNoConvergence, LinearOperator, eigsh

from turgor.core.engine.algebra.linear import LinearSolver, SingularTangentError, linear_solver
from turgor.core.engine.algebra.pattern import Pattern
from turgor.core.engine.evaluation import Evaluation
from turgor.core.engine.liquids.morison import added_mass, strips_of
from turgor.core.engine.mass import mass_data, refuse_turning, total_mass
from turgor.core.engine.points.point_mass import attached_mass
from turgor.core.engine.runtime import EngineOptions, use_threads
from turgor.core.engine.system import System
from turgor.core.engine.warmup.compiling import compile_kernels
from turgor.core.engine.warmup.needs import Needs
from turgor.core.model.model import Model
from turgor.core.solvers.dynamics.settings import MODES
from turgor.core.solvers.restart import unknowns_of
from turgor.core.solvers.solution import State
from turgor.foundation.display import brief
from turgor.foundation.errors import TurgorError
from turgor.foundation.given import one

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Modes:
    """Natural frequencies and mode shapes, from the lowest.

    Parameters
    ----------
    model : Model
        The question.
    load_factor : float [-]
        Load factor of the state that vibrates; 0 at rest.
    displacement : (n, 3) array [m]
        The state about which it vibrates.
    eigenvalues : (k,) array [1/s²]
        Squares of the circular frequencies; negative where the state is unstable.
    shapes : (k, n, 3) array [-]
        Displacement of every node in each mode; the largest is 1 long.
    modal_mass : (k,) array [kg]
        Mass that moves with each shape, of the whole actuator: twice its kinetic energy at a largest speed of 1 m/s.
    """

    model: Model
    load_factor: float
    displacement: Array
    eigenvalues: Array
    shapes: Array
    modal_mass: Array

    __repr__ = brief

    @property
    def frequencies(self) -> Array:
        """Frequencies [Hz], (k,); a mode that grows instead of vibrating counts negative, its rate over 2π."""
        return np.sign(self.eigenvalues) * np.sqrt(np.abs(self.eigenvalues)) / (2 * np.pi)

    @property
    def by_mode(self) -> tuple[tuple[str, Array, str], ...]:
        """Name, values (k,) and unit of what each mode has."""
        return ("frequency", self.frequencies, "Hz"), ("modal_mass", self.modal_mass, "kg")

    @property
    def unstable(self) -> int:
        """How many of the modes grow: an equilibrium with such modes is unstable."""
        return int((self.eigenvalues < 0).sum())

    @property
    def message(self) -> str:
        """The frequencies in one sentence, and whether the state is stable."""
        lowest = ", ".join(f"{f:.4g}" for f in self.frequencies)
        text = f"Frequencies at load factor {self.load_factor:.4g}: {lowest} Hz."
        if self.unstable:
            text += f" {self.unstable} of them are negative: the state is unstable and would leave along these modes."
        return text


def natural_frequencies(
    model: Model, state: State | None = None, count: int = 6, *, options: EngineOptions | None = None
) -> Modes:
    """Find the lowest natural frequencies of a model at rest or about a state of its path.

    The tangent at the state, with its pressures and stresses, is the stiffness; the mass is that of rubber and sheets
    and of the liquid that moves along. Rubber that relaxes has its instantaneous stiffness, as in a vibration much
    faster than its relaxation times. A half model has the modes that are symmetric about its mirror planes, and no
    others.

    Parameters
    ----------
    model : Model
        What vibrates; every material needs a density. It may be free to move: rigid motions have the frequency 0.
    state : State, optional
        The equilibrium about which it vibrates, from `solve`; at rest and without loads by default.
    count : int
        How many modes, from 1 to a tenth of the unknowns.
    options : EngineOptions, optional
        Linear solver, threads.

    Returns
    -------
    Modes

    Raises
    ------
    TurgorError
        If a density is missing, the count is out of range, or a load has no potential: a pressure on an open surface,
        a moment.
    """
    one(model, Model, "model", "a Model is needed")
    refuse_turning(model)
    options = options or EngineOptions()
    with use_threads(options.threads):
        compile_kernels(options.notify, Needs.of(model))
        by_cavity = {} if state is None else _unknown_pressures(model, state)
        system = System(model, tuple(by_cavity))
        _check(system, count)
        unknowns = np.zeros(system.size)
        memory = None if state is None or state.memory is None else state.memory.without_friction  # friction yields
        history = system.history(memory)  # a sudden step
        if state is not None:
            unknowns = unknowns_of(system, state)
        load_factor = 0.0 if state is None else state.load_factor
        pressures = np.array(list(by_cavity.values())) / system.stress_scale if by_cavity else None
        at = system.evaluate(unknowns, load_factor, pressures, history=history)
        if at is None:
            raise TurgorError("the state turns a cell inside out; it is no equilibrium of this model.")
        stiffness, mass = system.tangent_data(at), mass_data(system)
        mass += added_mass(system, strips_of(system), system.configuration(at).position, load_factor)
        check_elastic(system, at)
        eigenvalues, vectors = _solve(system, stiffness, mass, count, options)
    rigid = np.abs(eigenvalues) < MODES.rigid_share * _first_shift(system)
    return _modes(system, (load_factor, unknowns), np.where(rigid, 0.0, eigenvalues), vectors, mass)


def _unknown_pressures(model: Model, state: State) -> dict[str, float]:
    """Pressures that the procedure of a state found, where no load states them [Pa]."""
    loaded = {load.face for load in model.pressures}
    return {face: pressure for face, pressure in state.pressures.items() if face not in loaded}


def check_elastic(system: System, at: Evaluation) -> None:
    """Refuse forces at a state that have no potential: modes and buckling loads are those of an elastic body.

    Parameters
    ----------
    system : System
    at : Evaluation

    Raises
    ------
    TurgorError
    """
    if not system.terms.symmetric:
        raise TurgorError(
            "a pressure acts on an open surface and has no potential there, so that its modes are not those of an "
            "elastic body; close the cavity, or leave the pressure out."
        )
    turning = system.terms.unsymmetric_matrix(system.configuration(at), system.size)
    rubs = any(getattr(load, "friction", 0.0) for load in system.model.loads)  # a cable that sticks is symmetric
    if rubs or (turning is not None and abs(turning).max() > 0):
        raise TurgorError(
            "a moment or a follower force on a reference point, or a cable with friction, has no potential, so that "
            "the modes are not those of an elastic body; leave it out, prescribe the rotation, or take no friction."
        )


def _check(system: System, count: int) -> None:
    largest = max(1, int((system.moving & ~system.prescribed).sum()) // 10)
    if not 1 <= count <= largest:
        raise TurgorError(f"count is {count}; allowed is 1 to {largest}, a tenth of the free displacements.")


def _solve(system: System, stiffness: Array, mass: Array, count: int, options: EngineOptions) -> tuple[Array, Array]:
    """Eigenvalues (k,) and vectors (size, k), found above a shift that no mode lies under."""
    system.apply_supports(stiffness)
    mass = system.layout.spread(mass.copy())
    system.apply_supports(mass)
    mass[system.pattern.diagonal[system.prescribed]] = 0.0
    solver = linear_solver(options.linear_solver, system.pattern, options.threads)
    shift = _first_shift(system)
    for _ in range(MODES.shift_lowerings):
        if _none_below(system, solver, stiffness + shift * mass):
            break
        shift *= 10
    full = system.pattern.full(mass)
    exactly = partial(_refined, solver, system.pattern, stiffness + shift * mass)
    inverse = LinearOperator((system.size, system.size), matvec=exactly, dtype=np.float64)
    begin = exactly(full @ np.random.default_rng(1).normal(size=system.size))
    try:
        values, vectors = eigsh(
            inverse, k=count, M=full, sigma=-shift, OPinv=inverse, v0=begin, which="LM", ncv=max(2 * count + 2, 20)
        )
    except ArpackNoConvergence as error:
        raise TurgorError(f"only {len(error.eigenvalues)} of {count} modes converged; ask for fewer.") from error
    order = np.argsort(values)
    return values[order], vectors[:, order]


def _refined(solver: LinearSolver, pattern: Pattern, data: Array, right: Array) -> Array:
    """Solve to the accuracy that Lanczos iterations need; factors may be of single precision."""
    solution = solver.solve(right)
    for _ in range(MODES.lanczos_refinements):
        residual = right - pattern.product(data, solution)
        if float(np.linalg.norm(residual)) <= MODES.lanczos_residual * float(np.linalg.norm(right)):
            break
        solution = solution + solver.solve(residual)
    return solution


def _first_shift(system: System) -> float:
    """A shift below the slowest vibration of most actuators [1/s²]."""
    sheets = (sheet.material for sheet in system.model.membranes.values())
    materials = system.model.region_materials.values() or list(sheets)
    speed = min(m.law.shear_modulus / m.density for m in materials if m.density is not None)
    extent = float(np.ptp(system.model.mesh.points, axis=0).max())
    own = total_mass(system.model)
    return MODES.first_shift * speed / extent**2 * own / (own + attached_mass(system.model))


def _none_below(system: System, solver: LinearSolver, data: Array) -> bool:
    """Factor K + shift M; whether no mode lies below the shift."""
    expected = system.constraint_count
    system.make_definite(data)
    try:
        solver.factor(data)
    except SingularTangentError:
        return False
    return solver.negative_pivots(expected) in (expected, None)


def _modes(system: System, at: tuple[float, Array], eigenvalues: Array, vectors: Array, mass: Array) -> Modes:
    load_factor, unknowns = at
    shapes, masses = [], []
    for vector in vectors.T:
        motion = np.where(system.prescribed, 0.0, vector)
        motion[~system.moving] = 0.0
        shape = system.displacement(motion)
        size = np.linalg.norm(shape, axis=1)
        largest = float(size.max()) * (1 if shape[size.argmax()].sum() >= 0 else -1)
        shapes.append(shape / largest)
        masses.append(motion @ system.layout.base.product(mass, motion) / largest**2)
    scale = system.stress_scale * system.length * system.model.mesh.symmetry_factor
    return Modes(
        model=system.model,
        load_factor=load_factor,
        displacement=system.physical(unknowns)[0],
        eigenvalues=eigenvalues,
        shapes=np.array(shapes),
        modal_mass=scale * np.array(masses),
    )
