"""Motion of rods in time, by the generalized-α method on frames (Brüls, Cardona, Arnold 2012)."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from turgor.core.solvers.dynamics.generalized_alpha import Motion, TimeStep, Weights
from turgor.core.solvers.newton.iteration import CONVERGED, iterate
from turgor.fast_models.rod.band import Factors
from turgor.fast_models.rod.frames import commutator, tangent_map, wrench_matrix
from turgor.fast_models.rod.layout import mass_matrices, nodal_mass
from turgor.fast_models.rod.model import RodModel
from turgor.fast_models.rod.newton import NotConverged, new_contact, touches_well, update_size
from turgor.fast_models.rod.settings import IN_TIME
from turgor.fast_models.rod.solution import RodError, RodSolution
from turgor.fast_models.rod.state import RodState
from turgor.fast_models.rod.system import Evaluation, RodSystem
from turgor.foundation.errors import TurgorError

Array = NDArray[np.float64]


def dynamic(
    model: RodModel,
    *,
    duration: float,
    step: float,
    start: RodState | None = None,
    spectral_radius: float = 0.9,
) -> RodSolution:
    """Follow the motion of rods in time.

    Loads follow their histories, of which the load factor is the time over the duration.

    Parameters
    ----------
    model : RodModel
    duration : float [s]
    step : float [s]
        Length of the time steps; the last one ends at the duration.
    start : RodState or None
        Where the motion begins, with its velocity; by default at rest without loads.
    spectral_radius : float [-]
        At infinite frequency, from 0 to 1: 1 damps nothing, less damps what is too fast for the steps.

    Returns
    -------
    RodSolution

    Raises
    ------
    RodError
        If a step does not converge; its `solution` holds the motion so far.
    TurgorError
        If a number is out of its range, or a section has no mass.
    """
    if not 0 < step <= duration < np.inf:
        raise TurgorError(f"step is {step:g} s and duration {duration:g} s; 0 < step <= duration is needed.")
    if not 0 <= spectral_radius <= 1:
        raise TurgorError(f"spectral_radius is {spectral_radius:g}; it must lie between 0 and 1.")
    model.check_mass("a motion")
    steps = int(np.ceil(duration / step - 1e-9))
    motion = _Motions(RodSystem(model), Weights.of(spectral_radius), duration / steps)
    state = replace(motion.system.start() if start is None else start, load_factor=0.0)
    velocity = np.zeros((len(state.turn), 6)) if state.velocity is None else state.velocity
    state = replace(state, velocity=velocity)
    states, time, count = [state], np.linspace(0.0, duration, steps + 1), 0
    rate = motion.acceleration(state)
    now = Motion(np.zeros_like(rate), velocity, rate, rate)
    for k in range(1, steps + 1):
        try:
            state, now, iterations = motion.next_state(state, now, k / steps)
        except (NotConverged, TurgorError) as error:
            message = f"The step from {time[k - 1]:.4g} s on did not converge ({error}); take shorter steps."
            raise RodError(message, _ended(model, states, time, message, "not_converged", count)) from None
        states.append(state)
        count += iterations
    return _ended(model, states, time, f"The motion of {duration:g} s took {steps} steps.", "converged", count)


def _ended(model: RodModel, states: list[RodState], time: Array, message: str, status: str, count: int) -> RodSolution:
    return RodSolution(
        model=model, states=tuple(states), status=status, message=message, iterations=count,
        stable=(None,) * len(states), time=time[: len(states)],
    )  # fmt: skip


@dataclass(frozen=True, slots=True, eq=False)
class _Forces:
    """Residual of a moving state and the parts of its tangent."""

    at: Evaluation
    residual: Array
    by_velocity: Array
    damping: Array | None


@dataclass(frozen=True, slots=True, eq=False)
class _Moving:
    """An iterate of a time step: motion (n, 6) in it, forces of elements and of contact, what was evaluated there.

    The size is that of the last update; ``contact_good`` says whether contact was resolved before it.
    """

    moved: Array
    force: Array
    contact: Array
    size: float = np.inf
    contact_good: bool = False


class _Motions:
    """Steps in time of a system."""

    def __init__(self, system: RodSystem, weights: Weights, length: float) -> None:
        self.system, self.weights, self.length = system, weights, length
        self.masses = mass_matrices(*nodal_mass(system.model, system.layout))
        rods = system.model.rods
        viscous = np.array([rod.section.damping_time * np.asarray(rod.section.stiffness) for rod in rods])
        which = system.layout.rod
        self.viscous = viscous[which] / system.layout.length[:, None, None] if viscous.any() else None

    def acceleration(self, state: RodState) -> Array:
        """Return the accelerations (n, 6) of a state; those of prescribed motions are zero."""
        forces = self.forces(state, np.zeros((len(state.turn), 6)), self.system.evaluate(state))
        free = self.system.layout.free
        accelerations = np.zeros_like(forces.residual)
        for node in range(len(accelerations)):
            own = np.flatnonzero(free[node])
            mass = self.masses[node][np.ix_(own, own)]
            accelerations[node, own] = np.linalg.lstsq(mass, -forces.residual[node, own], rcond=None)[0]
        return accelerations

    def next_state(self, state: RodState, now: Motion, load_factor: float) -> tuple[RodState, Motion, int]:
        """Return the state and the motion after a step, and the iterations that it took."""
        rule = TimeStep(self.weights, now, self.length, np.ones_like(now.velocity))
        step = _Step(self, rule, state, load_factor)
        end = iterate(step, _Moving(rule.without_acceleration(), state.force, state.contact), IN_TIME.iterations)
        if not end.converged:
            raise end.stopped or NotConverged("iterations")
        motion = replace(rule.motion(end.at.moved), unknowns=np.zeros_like(now.unknowns), lead=0.0)
        return step.state_at(end.at), motion, end.iterations

    def forces(self, state: RodState, rate: Array, at: Evaluation) -> _Forces:
        """Inertia, damping and static forces of a state that moves."""
        velocity, layout = state.velocity, self.system.layout
        assert velocity is not None
        momentum = (self.masses @ velocity[:, :, None])[:, :, 0]
        lowered = np.swapaxes(commutator(velocity), 1, 2)
        inertia = (self.masses @ rate[:, :, None] - lowered @ momentum[:, :, None])[:, :, 0]
        residual = at.residual + inertia
        by_velocity = -(lowered @ self.masses + wrench_matrix(momentum))
        if self.viscous is None:
            return _Forces(at, residual, by_velocity, None)
        ahead, back = at.elements.to_strain
        maps = np.stack([-back @ layout.to_end[:, 0], ahead @ layout.to_end[:, 1]], axis=1)
        lifted = np.swapaxes(maps, -1, -2) @ self.viscous[:, None]
        damping = lifted[:, :, None] @ maps[:, None]
        speeds = (maps @ velocity[layout.ends][..., None]).sum(axis=1, keepdims=True)
        np.add.at(residual, layout.ends, (lifted @ speeds)[..., 0])
        return _Forces(at, residual, by_velocity, damping)

    def factors(self, forces: _Forces, map_: Array, rule: TimeStep) -> Factors:
        """Factor the tangent of a moving state, by motions in the step."""
        ends = self.system.layout.ends
        blocks = forces.at.blocks @ map_[ends][:, None]
        if forces.damping is not None:
            blocks = blocks + rule.rate * forces.damping
        own = forces.at.own @ map_ + rule.stiffness * self.masses + rule.rate * forces.by_velocity
        try:
            return self.system.band.factor(blocks, own)
        except FloatingPointError:
            raise NotConverged("singular") from None


@dataclass(frozen=True, slots=True, eq=False)
class _Step:
    """The case of Newton's method for rods in a time step from a state."""

    motions: _Motions
    rule: TimeStep
    before: RodState
    load_factor: float

    def state_at(self, at: _Moving) -> RodState:
        """The state at the end of the step."""
        moved = replace(self.before, force=np.zeros_like(at.force)).moved(at.moved, at.force)
        velocity = self.rule.velocity(at.moved)
        return replace(moved, velocity=velocity, load_factor=self.load_factor, contact=at.contact)

    def update(self, at: _Moving) -> _Moving:
        """The iterate after the motions (n, 6) that the tangent gives."""
        system, here, map_ = self.motions.system, self.state_at(at), tangent_map(at.moved)
        forces = self.motions.forces(here, self.rule.acceleration(at.moved), system.evaluate(here))
        (update,) = self.motions.factors(forces, map_, self.rule).solve(-forces.residual)
        if not np.isfinite(update).all():
            raise NotConverged("not finite")
        turned = (map_ @ update[:, :, None])[:, :, 0]
        ends = (system.layout.to_end @ turned[system.layout.ends][..., None])[..., 0]
        force = at.force + forces.at.elements.new_force(ends[:, 0], ends[:, 1])
        contact, good = new_contact(system, forces.at, turned), touches_well(system, here, forces.at)
        return _Moving(at.moved + update, force, contact, update_size(system, update), good)

    def advanced(self, at: _Moving, update: _Moving) -> _Moving:
        """The whole update is taken."""
        return update

    def ended(self, at: _Moving, iteration: int) -> str | None:
        """Converged once the update is small and contact is resolved."""
        return CONVERGED if at.size < IN_TIME.small_update and at.contact_good else None
