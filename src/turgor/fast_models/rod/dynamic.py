"""Motion of rods in time, by the generalized-α method on frames (Brüls, Cardona, Arnold 2012)."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from turgor.fast_models.rod.band import Factors
from turgor.fast_models.rod.frames import commutator, tangent_map, wrench_matrix
from turgor.fast_models.rod.layout import mass_matrices, nodal_mass
from turgor.fast_models.rod.model import RodModel
from turgor.fast_models.rod.newton import MOST_ITERATIONS, NotConverged, new_contact, touches_well, update_size
from turgor.fast_models.rod.solution import RodError, RodSolution
from turgor.fast_models.rod.state import RodState
from turgor.fast_models.rod.system import Evaluation, RodSystem
from turgor.foundation.errors import TurgorError

Array = NDArray[np.float64]

#: Largest update with which a time step is converged: over the length, and in rad.
SMALL_UPDATE = 1e-9


@dataclass(frozen=True, slots=True)
class _Scheme:
    """Numbers of the generalized-α method for a time step and a spectral radius."""

    step: float
    radius: float

    @property
    def alpha_m(self) -> float:
        return (2 * self.radius - 1) / (self.radius + 1)

    @property
    def alpha_f(self) -> float:
        return self.radius / (self.radius + 1)

    @property
    def gamma(self) -> float:
        return 0.5 + self.alpha_f - self.alpha_m

    @property
    def beta(self) -> float:
        return 0.25 * (self.gamma + 0.5) ** 2

    @property
    def by_velocity(self) -> float:
        return self.gamma / (self.step * self.beta)

    @property
    def by_acceleration(self) -> float:
        return (1 - self.alpha_m) / (self.step**2 * self.beta * (1 - self.alpha_f))


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
    motion = _Motion(RodSystem(model), _Scheme(duration / steps, spectral_radius))
    state = replace(motion.system.start() if start is None else start, load_factor=0.0)
    state = replace(state, velocity=np.zeros((len(state.turn), 6)) if state.velocity is None else state.velocity)
    states, time, count = [state], np.linspace(0.0, duration, steps + 1), 0
    rate = motion.acceleration(state)
    smoothed = rate.copy()
    for k in range(1, steps + 1):
        try:
            state, rate, smoothed, iterations = motion.next_state(state, rate, smoothed, k / steps)
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


class _Motion:
    """Steps in time of a system."""

    def __init__(self, system: RodSystem, scheme: _Scheme) -> None:
        self.system, self.scheme = system, scheme
        self.masses = mass_matrices(*nodal_mass(system.model, system.layout))
        rods = system.model.rods
        viscous = np.array([rod.section.damping_time * np.asarray(rod.section.stiffness) for rod in rods])
        which = system.layout.rod
        self.viscous = viscous[which] / system.layout.length[:, None, None] if viscous.any() else None

    def acceleration(self, state: RodState) -> Array:
        """Return the accelerations (n, 6) of a state; those of held motions are zero."""
        forces = self._forces(state, np.zeros((len(state.turn), 6)), self.system.evaluate(state))
        free = self.system.layout.free
        found = np.zeros_like(forces.residual)
        for node in range(len(found)):
            own = np.flatnonzero(free[node])
            mass = self.masses[node][np.ix_(own, own)]
            found[node, own] = np.linalg.lstsq(mass, -forces.residual[node, own], rcond=None)[0]
        return found

    def next_state(
        self, state: RodState, rate: Array, smoothed: Array, load_factor: float
    ) -> tuple[RodState, Array, Array, int]:
        """Return state, accelerations and smoothed accelerations after a step, and the iterations that it took."""
        scheme, system = self.scheme, self.system
        assert state.velocity is not None
        new_rate = np.zeros_like(rate)
        mean = (scheme.alpha_f * rate - scheme.alpha_m * smoothed) / (1 - scheme.alpha_m)
        velocity = state.velocity + scheme.step * ((1 - scheme.gamma) * smoothed + scheme.gamma * mean)
        moved = scheme.step * (state.velocity + scheme.step * ((0.5 - scheme.beta) * smoothed + scheme.beta * mean))
        force, contact = state.force, state.contact
        iterations = 0
        while True:
            iterations += 1
            here = replace(
                replace(state, force=np.zeros_like(force)).moved(moved, force),
                velocity=velocity, load_factor=load_factor, contact=contact,
            )  # fmt: skip
            forces = self._forces(here, new_rate, system.evaluate(here))
            map_ = tangent_map(moved)
            (update,) = self._factors(forces, map_).solve(-forces.residual)
            if not np.isfinite(update).all():
                raise NotConverged("not finite")
            turned = (map_ @ update[:, :, None])[:, :, 0]
            ends = (system.layout.to_end @ turned[system.layout.ends][..., None])[..., 0]
            force = force + forces.at.elements.new_force(ends[:, 0], ends[:, 1])
            contact = new_contact(system, forces.at, turned)
            moved = moved + update
            velocity = velocity + scheme.by_velocity * update
            new_rate = new_rate + scheme.by_acceleration * update
            if update_size(system, update) < SMALL_UPDATE and touches_well(system, here, forces.at):
                break
            if iterations == MOST_ITERATIONS:
                raise NotConverged("iterations")
        here = replace(
            replace(state, force=np.zeros_like(force)).moved(moved, force),
            velocity=velocity, load_factor=load_factor, contact=contact,
        )  # fmt: skip
        new_smoothed = mean + (1 - scheme.alpha_f) / (1 - scheme.alpha_m) * new_rate
        return here, new_rate, new_smoothed, iterations

    def _forces(self, state: RodState, rate: Array, at: Evaluation) -> _Forces:
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

    def _factors(self, forces: _Forces, map_: Array) -> Factors:
        scheme, ends = self.scheme, self.system.layout.ends
        blocks = forces.at.blocks @ map_[ends][:, None]
        if forces.damping is not None:
            blocks = blocks + scheme.by_velocity * forces.damping
        own = forces.at.own @ map_ + scheme.by_acceleration * self.masses + scheme.by_velocity * forces.by_velocity
        try:
            return self.system.band.factor(blocks, own)
        except FloatingPointError:
            raise NotConverged("singular") from None
