"""Second mesh: solve for states of a path on a refined mesh, each from its interpolated start."""

from dataclasses import dataclass, field, replace
from math import inf

import numpy as np
from numpy.typing import NDArray

from turgor.accuracy.adaptivity.simple_updates import SETTINGS as SIMPLE
from turgor.accuracy.adaptivity.simple_updates import Iterate, SimpleUpdates
from turgor.core.engine.algebra.linear import SingularTangentError
from turgor.core.engine.algebra.tangent import Tangent
from turgor.core.engine.cells.internal_variables import History
from turgor.core.engine.chamber_volumes import Chambers
from turgor.core.engine.points.read_motion import motions
from turgor.core.engine.runtime import EngineOptions
from turgor.core.engine.system import Evaluation, System
from turgor.core.engine.transfer import FilmTransfer, Transfer
from turgor.core.meshing.quality.quality_cache import hand_on
from turgor.core.meshing.quality.self_contact import may_meet
from turgor.core.meshing.refining.refinement import Refinement
from turgor.core.meshing.refining.split_films import FilmRefinement
from turgor.core.model.model import Model
from turgor.core.solvers.constraints.cavities import CavityPressures, VolumeTarget
from turgor.core.solvers.constraints.constraint import Constraint, Target
from turgor.core.solvers.constraints.load_factor import LoadFactor, WorkTarget
from turgor.core.solvers.constraints.loads import load_control
from turgor.core.solvers.newton.border import Border
from turgor.core.solvers.newton.contact_newton import newton_with_contact
from turgor.core.solvers.newton.iteration import iterate
from turgor.core.solvers.newton.newton import newton
from turgor.core.solvers.newton.newton_values import NewtonSettings, Start
from turgor.core.solvers.newton.pseudo_transient import pseudo_transient
from turgor.core.solvers.procedures.procedure import Procedure
from turgor.core.solvers.solution import State
from turgor.core.solvers.states import acting_pressures, touches

Array = NDArray[np.float64]

#: The equations on the second mesh, their tangent, and the internal variables of the step.
Equations = tuple[System, Tangent, History]

#: Relative residual on the second mesh where pressures are unknown.
SETTINGS = NewtonSettings(tolerance=1e-4, max_iterations=12)

#: The same with contact, or where simple updates diverge: for an estimate, which moves by 3 % of itself at most beyond
#: that (rows of 4, 5, 7 and 11 chambers), and for a state that takes the place of the first one.
ROUGH_SETTINGS = NewtonSettings(tolerance=2e-2, max_iterations=12)
EXACT_SETTINGS = NewtonSettings(tolerance=1e-5, max_iterations=30)

#: One update, whatever it leaves: an estimate by a linear solve.
LINEAR_SETTINGS = NewtonSettings(tolerance=inf, max_iterations=1)


@dataclass(slots=True, eq=False)
class SecondMesh:
    """A refined mesh and the equations on it, for every model that the states of one path belong to.

    Parameters
    ----------
    refinement : Refinement or FilmRefinement
    transfer : Transfer or FilmTransfer
        From the mesh of the path to it.
    options : EngineOptions
    """

    refinement: Refinement | FilmRefinement
    transfer: Transfer | FilmTransfer
    options: EngineOptions
    _known: list[tuple[Model, tuple[str, ...], System, Tangent]] = field(default_factory=list)

    def solved_again(
        self, state: State, procedure: Procedure, exact: bool = False, linear: bool = False
    ) -> State | None:
        """Find a state on the refined mesh under the constraint of its procedure; None where Newton's method fails.

        ``exact`` requests the tolerance of a solve, not only for a good estimate of the mesh error; ``linear`` for one
        linear solve alone, where the loads are given.
        """
        controlled = procedure.filled(state.model)
        system, tangent = self._equations(state, controlled)
        history = system.history(self.transfer.memory(state.memory), 0.0 if state.memory is not None else inf)
        start, equations = self._start(system, state), (system, tangent, history)
        free = controlled or (procedure.finds_load and state.model.pressures)
        try:
            if free:
                return _at_volume(equations, start, state, controlled)
            if linear:
                return _linearly(equations, start, state)
            return _at_load(equations, start, state, exact or procedure.finds_load)
        except (SingularTangentError, np.linalg.LinAlgError):
            return None

    def at_rest(self, state: State) -> State:
        """Transfer the undeformed state to the refined mesh."""
        return replace(
            state,
            model=replace(state.model, mesh=self.refinement.mesh),
            displacement=self.transfer.nodal(state.displacement),
            mean_stress=self.transfer.mean_stress(
                state.model, replace(state.model, mesh=self.refinement.mesh), state.mean_stress
            ),
            nodal_force=np.zeros_like(self.refinement.mesh.points),
            touches={},
        )

    def _equations(self, state: State, controlled: tuple[str, ...]) -> tuple[System, Tangent]:
        model = state.model
        for known, faces, system, tangent in self._known:
            if known is model and faces == controlled:
                return system, tangent
        if model.contact.automatic:
            hand_on(may_meet, model.mesh, self.refinement.mesh)
        system = System(replace(model, mesh=self.refinement.mesh), controlled)
        if _touching(state):  # else the tangent would be analyzed again, with what touches
            at = system.evaluate(self._start(system, state), state.load_factor)
            if at is not None:
                system.lay_out(at)
        tangent = Tangent(system, self.options.linear_solver, self.options.threads, self.options.iteration)
        self._known = [(model, controlled, system, tangent)]  # one at a time: factors are large
        return system, tangent

    def _start(self, system: System, state: State) -> Array:
        """Scaled unknowns of a state, interpolated."""
        moved = self.transfer.nodal(state.displacement)
        mean = self.transfer.mean_stress(state.model, system.model, state.mean_stress)
        obstacles = {obstacle.name: obstacle for obstacle in system.model.contact.obstacles}
        springs = [
            (state.touches[name].place - obstacles[name].displacement(0.0)) / system.length
            for name in system.contact.bodies.names
        ]
        return np.concatenate([system.unknowns(moved, mean), *springs])


def _at_load(equations: Equations, unknowns: Array, state: State, exact: bool) -> State | None:
    """Equilibrium at the load factor of the state, with the accuracy that the estimate needs."""
    system, tangent, history = equations
    at = system.evaluate(unknowns, state.load_factor, history=history)
    if at is None:
        return None
    if not len(system.cells) and system.model.sheets_wrinkle:
        return _with_folds(equations, at, state)
    if _touching(state):
        return _carefully(system, tangent, at, state, exact)
    case = SimpleUpdates(
        Border(load_control(system, history=history), tangent), exact, float(np.linalg.norm(unknowns[system.moving]))
    )
    start = Iterate(at, np.zeros(int(system.moving.sum())), system.stresses(at) if tangent.mixed_points else None)
    end = iterate(case, start, SIMPLE.updates)
    if end.converged:
        return _state(system, end.at.at, state, tangent.unstable_modes())
    return _carefully(system, tangent, at, state, exact)


def _carefully(system: System, tangent: Tangent, at: Evaluation, state: State, exact: bool) -> State | None:
    """Equilibrium by the Newton's method of a solve: with contact, or where simple updates diverge."""
    start = Start(at.unknowns, system.stresses(at), evaluation=at)
    constraint = load_control(system, history=at.history)
    settings = EXACT_SETTINGS if exact else ROUGH_SETTINGS
    result = newton_with_contact(constraint, tangent, start, state.load_factor, settings, _silent)
    if not result.converged or result.evaluation is None:
        return None
    moved = (result.evaluation.unknowns - at.unknowns)[system.moving]
    if np.linalg.norm(moved) > SIMPLE.far * np.linalg.norm(at.unknowns[system.moving]):
        return None  # another equilibrium
    return _state(system, result.evaluation, state, result.unstable_modes)


def _with_folds(equations: Equations, at: Evaluation, state: State) -> State | None:
    """Equilibrium of films at the load factor of the state: they have more folds on a finer mesh, and move there."""
    system, tangent, history = equations
    constraint = load_control(system, history=history)
    result = pseudo_transient(constraint, tangent, at.unknowns, state.load_factor, EXACT_SETTINGS, _silent)
    if result.evaluation is None:
        return None
    return _state(system, result.evaluation, state, result.unstable_modes)


def _linearly(equations: Equations, unknowns: Array, state: State) -> State | None:
    """The state after one update of Newton's method at its load factor; None where the update is too large."""
    system, tangent, history = equations
    start = Start(unknowns, None, np.zeros(0))
    constraint = load_control(system, history=history)
    result = newton(constraint, tangent, start, state.load_factor, LINEAR_SETTINGS, _silent).evaluation
    if result is None:
        return None
    moved = (result.unknowns - unknowns)[system.moving]
    if np.linalg.norm(moved) > SIMPLE.far * np.linalg.norm(unknowns[system.moving]):
        return None
    return _state(system, result, state)


def _at_volume(equations: Equations, unknowns: Array, state: State, controlled: tuple[str, ...]) -> State | None:
    """Equilibrium with the volumes of the state; pressures, or the load factor, are unknown."""
    system, tangent, history = equations
    if controlled:
        chambers = Chambers(system, controlled)
        volumes = chambers.volumes(unknowns)
        target: Target = VolumeTarget(chambers, volumes, np.zeros_like(volumes))
        constraint = Constraint.of(CavityPressures(system), target, history=history)
        scalars = np.array([state.pressures[name] for name in controlled]) / system.stress_scale
        parameter = state.load_factor
    else:
        weights = {load.face: load.pressure for load in state.model.pressures}
        chambers = Chambers(system, tuple(weights))
        shares = np.array(list(weights.values())) / max(map(abs, weights.values()))
        now, rest = (float(shares @ chambers.volumes(x)) for x in (unknowns, np.zeros(system.size)))
        target = WorkTarget(chambers, shares, rest, now)
        constraint = Constraint.of(LoadFactor(system), target, history=history)
        scalars, parameter = np.array([state.load_factor]), 1.0
    start = Start(unknowns, None, scalars)
    result = newton(constraint, tangent, start, parameter, SETTINGS, _silent)
    if not result.converged or result.evaluation is None:
        return None
    return _state(system, result.evaluation, state)


def _state(system: System, at: Evaluation, state: State, modes: int | None = None) -> State:
    displacement, mean_stress = system.physical(at.unknowns)
    return replace(
        state,
        model=system.model,
        load_factor=at.load_factor,
        displacement=displacement,
        mean_stress=mean_stress,
        nodal_force=system.nodal_forces(at),
        points=motions(system, at),
        unstable_modes=modes,
        touches=touches(system, at),
        pressures={**state.pressures, **acting_pressures(system, at)},
        memory=at.history.memory,
    )


def _touching(state: State) -> bool:
    return any(touch.area > 0 for touch in state.touches.values())


def _silent(iteration: int, residual: float, correction: float, step_length: float) -> None:
    """Report nothing: the progress of a run is that of its path."""
