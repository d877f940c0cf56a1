"""Time stepping: the steps of `Dynamic`. Each predicts, finds its end, counts the energies and chooses the next one.

It shares the step loop with the path follower, not the step. The error of a time step is one of the displacement, its
prediction comes from velocities, and a step that is too long is rejected although Newton's method converged.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from time import perf_counter

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.algebra.additions import Addition, Linear, Together
from turgor.core.engine.cells.internal_variables import Memory
from turgor.core.engine.damping import StrainRateDamping
from turgor.core.engine.energy import contact_energy, stored_energy, work_of_states
from turgor.core.engine.mass import mass_data, refuse_turning
from turgor.core.engine.system import Evaluation, System
from turgor.core.model.drive import kinks
from turgor.core.solvers.checkpoints.loop import Loop
from turgor.core.solvers.constraints.constraint import Constraint
from turgor.core.solvers.continuation.path_follower import step_loop
from turgor.core.solvers.dynamics.closed_cavities import ClosedCavities
from turgor.core.solvers.dynamics.contact_work import Pushing, pushing, taken_by_friction, work_of_contacts
from turgor.core.solvers.dynamics.generalized_alpha import Motion, TimeStep, Weights
from turgor.core.solvers.dynamics.initial_motion import Accelerations
from turgor.core.solvers.dynamics.motion_outcomes import moved, no_motion, out_of_time_steps
from turgor.core.solvers.dynamics.settings import TIME_STEPPING
from turgor.core.solvers.dynamics.slender_bodies import SlenderBodies
from turgor.core.solvers.dynamics.time_step_control import TimeControl
from turgor.core.solvers.energies import Energies
from turgor.core.solvers.newton.contact_newton import newton_with_contact
from turgor.core.solvers.newton.convergence import relative_residual
from turgor.core.solvers.newton.newton_values import NewtonResult, NewtonSettings, Start
from turgor.core.solvers.outcomes import Outcome, stopped_by
from turgor.core.solvers.problem import Problem
from turgor.core.solvers.procedures.time_options import TimeOptions
from turgor.core.solvers.restart import unknowns_of
from turgor.core.solvers.solution import State, Step
from turgor.core.solvers.states import state_of
from turgor.core.solvers.step_reasons import Cause, Reason
from turgor.foundation.errors import TurgorError

Array = NDArray[np.float64]


@dataclass(slots=True, eq=False)
class _Run:
    """Constants and state of a run."""

    problem: Problem
    procedure: TimeOptions
    control: TimeControl
    mass: Array
    bodies: SlenderBodies
    cavities: ClosedCavities
    moving: Array
    motion: Motion
    at: Evaluation
    pushed: Pushing
    damping: Array
    energies: Energies
    internal: Array
    memory: Memory | None = None
    time: float = 0.0
    largest: float = 0.0
    accepted: int = 0
    factored: float = 0.0
    weights: Weights = field(default_factory=lambda: Weights.of(1.0))

    @property
    def system(self) -> System:
        return self.problem.system


def follow_motion(problem: Problem, procedure: TimeOptions) -> Outcome:
    """Step from time 0 to the end; states and steps are added to the lists of the problem as they are found.

    The motion begins at rest without loads, or at the start of the problem with its velocity.
    """
    run = _begin(problem, procedure)
    return step_loop(
        Loop(problem, [run], keeps_factors=True),
        lambda: _advance(run),
        lambda: len(run.problem.steps) >= procedure.max_steps,
        lambda: out_of_time_steps(run.time, procedure),
    )


def _begin(problem: Problem, procedure: TimeOptions) -> _Run:
    system = problem.system
    unknowns, velocity = _restarted(system, problem.start)
    history = system.history(problem.memory)  # a sudden step
    cavities = ClosedCavities.of(system, procedure, unknowns, problem.restart)
    at = system.evaluate(unknowns, 0.0, cavities.acting, history=history)
    if at is None:
        raise TurgorError("the start turns a cell inside out; it is no state of this model.")
    refuse_turning(system.model)
    mass = mass_data(system)
    added = (bodies := SlenderBodies.of(system)).mass(at)
    accelerations = Accelerations(system, at, mass + added)
    if procedure.velocity is not None:
        points, stated = system.model.mesh.points, procedure.velocity
        given = np.broadcast_to(np.asarray(stated(points) if callable(stated) else stated), points.shape)
        velocity = accelerations.velocity(system.rates(unknowns, given))
    damping = np.zeros(system.size)
    if velocity.any():
        damping = procedure.mass_damping * system.layout.base.product(mass, velocity)
        if procedure.stiffness_damping:
            damping += StrainRateDamping(system, procedure.stiffness_damping, 0.0, velocity).forces(unknowns)
        damping += bodies.drag(at, velocity)
    acceleration, stress = accelerations.acceleration(velocity, damping)
    damping = damping + system.layout.base.product(added, acceleration)
    moving = system.moving.astype(np.float64)
    kinetic = _unit(system) * 0.5 * float(velocity @ system.layout.base.product(mass + added, velocity))
    strain = stored_energy(system, unknowns, at.load_factor, history) + contact_energy(system, at)
    run = _Run(
        problem=problem, procedure=procedure, control=TimeControl.of(procedure, kinks(system.model)),
        mass=mass, bodies=bodies, cavities=cavities, moving=moving, at=at, pushed=pushing(system, at), damping=damping,
        motion=Motion(unknowns + stress, velocity, acceleration, acceleration),
        energies=Energies(kinetic=kinetic, strain=strain, dissipated=0.0, work=kinetic + strain),
        internal=at.residual + at.external, memory=history.memory, largest=_largest(system, unknowns),
        weights=Weights.of(procedure.spectral_radius),
    )  # fmt: skip
    _, mean_stress = system.physical(run.motion.unknowns)
    problem.states.append(replace(_state(run), mean_stress=mean_stress, memory=history.memory))
    return run


def _restarted(system: System, start: State | None) -> tuple[Array, Array]:
    """Unknowns and velocity of a start, at rest by default."""
    if start is None:
        return np.zeros(system.size), np.zeros(system.size)
    velocity = np.zeros_like(start.displacement) if start.velocity is None else start.velocity
    unknowns = unknowns_of(system, start)
    return unknowns, system.rates(unknowns, velocity)


def _unit(system: System) -> float:
    """Joule of a scaled force times a scaled length."""
    return system.stress_scale * system.length**3


def _largest(system: System, unknowns: Array) -> float:
    """Largest scaled displacement of a node."""
    return float(np.linalg.norm(system.displacement(unknowns), axis=1).max())


def _advance(run: _Run) -> Outcome | None:
    """Attempt one step; return how the run ends, if it does."""
    system, procedure, began = run.system, run.procedure, perf_counter()
    time = run.control.next_time(run.time)
    rule = TimeStep(run.weights, run.motion, time - run.time, run.moving)
    damping = [*_damping(run, rule), *run.bodies.of_step(rule, time / procedure.duration)]
    acting = Together([_inertia(run, rule), *damping])
    constraint = run.cavities.constraint(system.history(run.memory, rule.length), acting)
    result = _equilibrium(run, constraint, rule, time / procedure.duration)
    accepted, reason = result.converged, result.reason
    following: TimeControl | None = run.control
    if not result.converged:
        following = run.control.failed(rule.length)
    else:
        assert result.evaluation is not None
        unknowns = result.evaluation.unknowns
        floor = TIME_STEPPING.small_displacement * float(np.ptp(system.points, axis=0).max())
        error = rule.error(unknowns) / max(run.largest, _largest(system, unknowns), floor)
        following, taken_back = run.control.after(rule.length, error)
        if taken_back:
            accepted, reason = False, Reason(Cause.TIME_ERROR, error)
    run.problem.steps.append(
        Step(
            load_factor=time / procedure.duration,
            increment=rule.length / procedure.duration,
            iterations=result.iterations,
            residual=result.residual,
            accepted=accepted,
            seconds=perf_counter() - began,
            why=reason,
        )
    )
    run.problem.listeners.rejected(len(run.problem.steps), run.problem.steps[-1])
    if following is None:
        return no_motion(run.time, run.problem.steps[-1])
    run.control = following
    return _accept(run, rule, time, result, damping) if accepted else None


def _inertia(run: _Run, rule: TimeStep) -> Linear:
    """M a + α M v as a function of the unknowns at the end."""
    pattern, alpha, nothing = run.system.layout.base, run.procedure.mass_damping, np.zeros(run.system.size)
    constant = rule.acceleration(nothing) + alpha * rule.velocity(nothing)
    factor = rule.stiffness + alpha * rule.rate
    return Linear(pattern, factor * run.mass, pattern.product(run.mass, constant))


def _damping(run: _Run, rule: TimeStep) -> Sequence[Addition]:
    tau = run.procedure.stiffness_damping
    if not tau:
        return ()
    return (StrainRateDamping(run.system, tau, rule.rate, rule.velocity(np.zeros(run.system.size))),)


def _equilibrium(run: _Run, constraint: Constraint, rule: TimeStep, load_factor: float) -> NewtonResult:
    """Newton's method from the prediction."""
    system, procedure = run.system, run.procedure
    report = run.problem.listeners.reporter(len(run.problem.steps) + 1, load_factor)
    predicted = _prediction(run, constraint, rule, load_factor)
    stresses = system.stresses(run.at, predicted - run.at.unknowns)
    other = abs(rule.length / run.factored - 1) > TIME_STEPPING.same_length if run.factored else True
    pressures = run.cavities.pressures  # their border needs factors of its own
    start = Start(predicted, stresses, pressures, fresh=other or bool(len(pressures)))
    run.factored = rule.length
    settings = NewtonSettings(tolerance=procedure.tolerance, max_iterations=procedure.max_iterations)
    return newton_with_contact(constraint, run.problem.tangent, start, load_factor, settings, report)


def _prediction(run: _Run, constraint: Constraint, rule: TimeStep, load_factor: float) -> Array:
    """Extrapolate the motion, or start from the last state, which may be nearer where rubber begins to unload."""
    system, here = run.system, run.motion.unknowns
    predicted = rule.prediction()
    predicted[system.prescribed] = here[system.prescribed]  # Newton moves the supports
    ahead = constraint.evaluate(predicted, load_factor, run.cavities.pressures)
    if ahead is None:
        return here
    if not system.remembers:
        return predicted
    still = constraint.evaluate(here, load_factor, run.cavities.pressures)
    stays = still is not None and relative_residual(system, still) < relative_residual(system, ahead)
    return here if stays else predicted


def _accept(
    run: _Run, rule: TimeStep, time: float, result: NewtonResult, damping: Sequence[Addition]
) -> Outcome | None:
    """Move on to the end of a step; return how the run ends if the caller wants that."""
    at = result.evaluation
    assert at is not None
    motion = rule.motion(at.unknowns)
    forces = run.procedure.mass_damping * run.system.layout.base.product(run.mass, motion.velocity)
    for part in damping:
        forces = forces + part.forces(at.unknowns)
    pushed = pushing(run.system, at)
    assert at.addition is not None
    internal = at.residual + at.external - at.addition.forces(at.unknowns)
    run.energies = _energies(run, (motion, at, pushed), (forces, internal))
    run.internal = internal
    run.motion, run.at, run.pushed, run.damping, run.time = motion, at, pushed, forces, time
    run.largest = max(run.largest, _largest(run.system, at.unknowns))
    run.cavities = run.cavities.onward(time / run.procedure.duration, at.unknowns, result.scalars)
    run.accepted += 1
    state, procedure, states = _state(run), run.procedure, run.problem.states
    run.memory = state.memory
    end = procedure.duration
    requested = any(abs(time - factor * end) < 1e-12 * end for factor in (*procedure.at, 1.0))
    if run.accepted % procedure.keep == 0 or requested:
        states.append(state)
    reason = run.problem.listeners.accepted(len(run.problem.steps), state, result)
    if reason is not None:
        return stopped_by(run.system.model, state, reason)
    return None if time < procedure.duration else moved(states, run.problem.steps, time, run.accepted)


def _energies(run: _Run, end: tuple[Motion, Evaluation, Pushing], forces: tuple[Array, Array]) -> Energies:
    """Energies at the end of a step; work by the trapezoidal rule, that of damping, drag and the stresses alike."""
    system, before, (motion, at, pushed) = run.system, run.energies, end
    damping, internal = forces
    moved = run.moving * (at.unknowns - run.at.unknowns)
    support = np.where(system.prescribed, 0.5 * (run.at.residual + at.residual), 0.0)
    work = float((0.5 * (run.at.external + at.external) + support) @ moved)
    unit = _unit(system)
    strain = stored_energy(system, at.unknowns, at.load_factor, at.history) + contact_energy(system, at)
    by_contacts = work_of_contacts(system, run.pushed, pushed)
    taken = 0.5 * unit * float((run.damping + damping) @ moved)
    if system.remembers:  # what the rubber took up and will not give back
        taken += 0.5 * unit * float((run.internal + internal) @ moved) - (strain - before.strain) + by_contacts
    else:
        taken += taken_by_friction(system, at)
    rubber = 0.5 * unit * float(motion.velocity @ system.layout.base.product(run.mass, motion.velocity))
    water = unit * run.bodies.kinetic(at, motion.velocity)
    taken -= water - unit * run.bodies.kinetic(run.at, run.motion.velocity)
    return Energies(
        kinetic=rubber + water,
        strain=strain,
        dissipated=before.dissipated + taken,
        work=before.work + unit * work + by_contacts + work_of_states(system, run.at, at),
    )


def _state(run: _Run) -> State:
    """The state at the end of the last step; its memory is that of the step that has begun."""
    system = run.system
    return replace(
        state_of(system, run.at, None),
        load_factor=run.time / run.procedure.duration,
        time=run.time,
        velocity=system.displacement(run.motion.velocity) * system.length,
        energies=run.energies,
    )
