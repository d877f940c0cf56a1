"""The loop of `Stabilized`: steps with viscous forces, then a rest until they have faded."""

from dataclasses import dataclass, replace
from math import inf
from time import perf_counter

import numpy as np
from numpy.typing import NDArray

from turgor.engine.additions import Linear
from turgor.engine.energy import contact_energy, softening_loss, stored_energy
from turgor.engine.mass import mass_data
from turgor.engine.system import Evaluation, System
from turgor.engine.tangent import Tangent
from turgor.model.drive import kinks
from turgor.solvers.checks.supports import free_motions
from turgor.solvers.constraints.loads import load_control
from turgor.solvers.continuation.step_control import StepControl
from turgor.solvers.dynamics.contact_work import Pushing, pushing, taken_by_friction, work_of_contacts
from turgor.solvers.dynamics.initial_stiffness import softness
from turgor.solvers.dynamics.motion_outcomes import came_to_rest, no_state, restless
from turgor.solvers.energies import Energies
from turgor.solvers.listeners import Listeners
from turgor.solvers.newton.contact_newton import newton_with_contact, touches
from turgor.solvers.newton.convergence import relative_residual
from turgor.solvers.newton.newton import NewtonResult, NewtonSettings, Start
from turgor.solvers.outcomes import Outcome, interrupted, stopped_by, too_many_steps
from turgor.solvers.procedures.stabilized import Stabilized
from turgor.solvers.reasons import Cause, Reason
from turgor.solvers.restart import unknowns_of
from turgor.solvers.solution import Iteration, State, Step

Array = NDArray[np.float64]

#: A step that leaves more of the strain energy unaccounted for than this share went too far, and is tried shorter.
ENERGY_ERROR = 1e-2

#: A step that moves nothing by more than this many edge lengths is no jump.
SMALL_MOVE = 1e-3

#: Where steps fall below the smallest, the viscosity is raised by this factor, so many times.
RAISE, RAISES = 10.0, 3

#: While the load is held, each step is this many times as long as the last, up to so many.
LONGER, HOLDS = 2.0, 80


@dataclass(slots=True, eq=False)
class _Run:
    """What stays the same, and how far it has come."""

    system: System
    tangent: Tangent
    procedure: Stabilized
    listeners: Listeners
    states: list[State]
    steps: list[Step]
    mass: Array
    viscosity: float
    at: Evaluation
    pushed: Pushing
    rate: Array
    viscous: Array
    energies: Energies
    free: bool = False
    softened: float = 0.0
    raised: int = 0


def follow_viscously(
    system: System,
    tangent: Tangent,
    procedure: Stabilized,
    listeners: Listeners,
    path: tuple[list[State], list[Step]],
    start: State | None = None,
) -> Outcome:
    """Step from load factor 0 to 1 and let the actuator come to rest; what is found is added to ``path``."""
    turns = kinks(system.model)
    control = StepControl.of(procedure.path, turns)
    run = _begin(system, tangent, procedure, listeners, path, start)
    try:
        while run.at.load_factor < 1.0:
            if len(run.steps) >= procedure.max_steps:
                return too_many_steps(system.model, run.states[-1], procedure)
            following = _advance(run, control)
            if isinstance(following, Outcome):
                return following
            control = following.turned(procedure.first_step) if run.at.load_factor in turns else following
        return _come_to_rest(run)
    except KeyboardInterrupt:
        return interrupted(system.model, path[0][-1])
    finally:
        system.addition = None


def _begin(
    system: System,
    tangent: Tangent,
    procedure: Stabilized,
    listeners: Listeners,
    path: tuple[list[State], list[Step]],
    start: State | None,
) -> _Run:
    unknowns = unknowns_of(system, start)
    system.materials.memory = None if start is None else start.memory
    system.materials.begin_step(inf)
    at = system.evaluate(unknowns, 0.0)
    assert at is not None
    even = np.full(len(system.cells), system.stress / system.length**2)  # a scaled mass of 1 for a scaled volume of 1
    mass = mass_data(system, even)
    strain = stored_energy(system, unknowns) + contact_energy(system, at)
    free = free_motions(system.model) > 0
    run = _Run(
        system=system, tangent=tangent, procedure=procedure, listeners=listeners, states=path[0], steps=path[1],
        mass=mass, viscosity=procedure.stabilization * softness(system, tangent, at, mass, free), at=at, free=free,
        pushed=pushing(system, at), rate=np.zeros(system.size), viscous=np.zeros(system.size),
        energies=Energies(kinetic=0.0, strain=strain, dissipated=0.0, work=strain),
    )  # fmt: skip
    run.softened = softening_loss(system, at)
    run.states.append(_state(run, at, None))
    return run


def _advance(run: _Run, control: StepControl) -> StepControl | Outcome:
    """Attempt one step; return the control for the next one, or how the run ends."""
    now = run.at.load_factor
    load = control.next_load(now)
    result = _attempt(run, load, load - now)
    if result.converged and not _too_far(run, result):
        reason = _accept(run, result, load - now)
        return reason or control.accepted(load - now, result.iterations)
    shorter = control.failed(load - now)
    if shorter is not None:
        return shorter
    if run.raised >= RAISES:
        return no_state(run.states[-1], run.steps[-1], RAISE**run.raised)
    run.raised += 1
    run.viscosity *= RAISE
    return control.turned(run.procedure.first_step)


def _drag(run: _Run, length: float) -> Linear:
    """The viscous forces of a step of a length from the last state."""
    base, drag = run.system.layout.base, run.viscosity / length * run.mass
    return Linear(base, drag, -base.product(drag, run.at.unknowns))


def _attempt(run: _Run, load: float, length: float) -> NewtonResult:
    """Solve for a load with the viscous forces of a step of a length."""
    system, listeners, began = run.system, run.listeners, perf_counter()
    number = len(run.steps) + 1

    def report(iteration: int, residual: float, correction: float, step: float) -> None:
        if listeners.progress is not None:
            listeners.progress(_iteration(number, load, iteration, residual, correction, step), None)

    system.materials.begin_step(inf)
    system.addition = _drag(run, length)
    settings = NewtonSettings(tolerance=run.procedure.tolerance, max_iterations=run.procedure.max_iterations)
    result = newton_with_contact(load_control(system), run.tangent, _start(run, load, length), load, settings, report)
    run.steps.append(
        Step(
            load_factor=load,
            increment=load - run.at.load_factor,
            iterations=result.iterations,
            residual=result.residual,
            accepted=result.converged,
            seconds=perf_counter() - began,
            why=result.reason,
        )
    )
    return result


def _start(run: _Run, load: float, length: float) -> Start:
    """Go on as before, or stay: whichever leaves the smaller residual."""
    system, best, smallest = run.system, run.at.unknowns, np.inf
    for trial in (run.at.unknowns + length * run.rate, run.at.unknowns):
        at = system.evaluate(trial, load)
        residual = np.inf if at is None else relative_residual(system, at)
        if residual < smallest:
            best, smallest = trial, residual
    return Start(best, system.stresses(run.at, best - run.at.unknowns))


def _too_far(run: _Run, result: NewtonResult) -> bool:
    """Whether a step jumped so far that its work is not known well; it is then marked as not accepted."""
    at, addition = result.evaluation, run.system.addition
    assert at is not None and addition is not None
    after = _energies(run, at, addition.forces(at.unknowns))
    lost = abs(after.missing - run.energies.missing)
    moved = np.abs(at.unknowns - run.at.unknowns)[: 3 * run.system.node_count].max()
    most = max(after.strain, run.energies.strain, after.dissipated if run.free else 0.0)  # a fall strains little
    if moved < SMALL_MOVE or lost <= ENERGY_ERROR * most:
        return False
    why = Reason(Cause.ENERGY_ERROR, 100 * lost / most)
    run.steps[-1] = replace(run.steps[-1], accepted=False, why=why)
    return True


def _accept(run: _Run, result: NewtonResult, length: float) -> Outcome | None:
    """Take a step, count its energies, and return how the run ends if the caller wants that."""
    at, system = result.evaluation, run.system
    assert at is not None and system.addition is not None
    viscous = system.addition.forces(at.unknowns)
    run.energies = _energies(run, at, viscous)
    run.softened = softening_loss(system, at)
    system.materials.memory = system.remembered(at)
    run.rate = (at.unknowns - run.at.unknowns) / length
    held = at.load_factor == run.at.load_factor
    run.at, run.pushed, run.viscous = at, pushing(system, at), viscous
    state = _state(run, at, None)
    system.contact.accept(at.contacts)  # after the state has been read
    if held:
        run.states.pop()  # while the load is held, only the last state counts
    run.states.append(state)
    if run.listeners.progress is not None:
        last = _iteration(len(run.steps), state.load_factor, result.iterations, result.residual, 0.0, 1.0)
        run.listeners.progress(last, state)
    reason = run.listeners.stop(state) if run.listeners.stop is not None else None
    return None if reason is None else stopped_by(system.model, state, reason)


def _come_to_rest(run: _Run) -> Outcome:
    """Hold the load until the viscous forces have faded."""
    length = run.procedure.first_step
    for _ in range(HOLDS):
        run.system.addition = None
        at = run.system.evaluate(run.at.unknowns, 1.0)
        assert at is not None
        if relative_residual(run.system, at) <= run.procedure.tolerance:
            break
        result = _attempt(run, 1.0, length)
        if not result.converged or _too_far(run, result):
            length *= 0.25
            if length < run.procedure.min_step:
                return no_state(run.states[-1], run.steps[-1], RAISE**run.raised)
            continue
        ended = _accept(run, result, length)
        if ended is not None:
            return ended
        run.rate = np.zeros_like(run.rate)
        length *= LONGER
    else:
        return restless(run.states[-1])
    run.at = at
    if run.free:  # where nothing holds it, the tangent is singular by itself
        run.system.addition = _drag(run, 1.0)
    run.tangent.factor(at)
    run.states[-1] = _state(run, at, run.tangent.unstable_modes())
    return came_to_rest(run.states, run.steps)


def _energies(run: _Run, at: Evaluation, viscous: Array) -> Energies:
    """Energies at the end of a step; work by the trapezoidal rule."""
    system, before, unit = run.system, run.energies, run.system.stress * run.system.length**3
    moved = at.unknowns - run.at.unknowns
    moved[3 * system.node_count :] = 0.0
    pushed = work_of_contacts(system, run.pushed, pushing(system, at))
    support = np.where(system.held, 0.5 * (run.at.residual + at.residual), 0.0)
    lasting = taken_by_friction(system, at) + softening_loss(system, at) - run.softened
    return Energies(
        kinetic=0.0,
        strain=stored_energy(system, at.unknowns) + contact_energy(system, at),
        dissipated=before.dissipated + 0.5 * unit * float((run.viscous + viscous) @ moved) + lasting,
        lasting=before.lasting + lasting,
        work=before.work + pushed + unit * float((0.5 * (run.at.external + at.external) + support) @ moved),
    )


def _state(run: _Run, at: Evaluation, modes: int | None) -> State:
    system = run.system
    displacement, mean_stress = system.physical(at.unknowns)
    return State(
        model=system.model,
        load_factor=at.load_factor,
        displacement=displacement,
        mean_stress=mean_stress,
        nodal_force=system.split(at.residual)[0] * system.stress * system.length**2,
        unstable_modes=modes,
        energies=run.energies,
        touches=touches(system, at),
        memory=system.materials.memory,
    )


def _iteration(step: int, load: float, iteration: int, residual: float, correction: float, length: float) -> Iteration:
    return Iteration(
        step=step, iteration=iteration, load_factor=load, residual=residual, correction=correction, step_length=length
    )
