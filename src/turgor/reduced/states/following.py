"""Following: answers of a reduced model along histories of its inputs, at rest in every state or in motion."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from math import inf
from typing import Any

import numpy as np
from numpy.typing import NDArray

from turgor.core.solvers.dynamics.generalized_alpha import Motion, TimeStep, Weights
from turgor.core.solvers.energies import Energies
from turgor.foundation.errors import NotSolved, TurgorError
from turgor.reduced.parts.inertia import Inertia, InertiaAt
from turgor.reduced.parts.points import Points, PointsAt
from turgor.reduced.settings import ESTIMATE, NEWTON
from turgor.reduced.states.answer import ReducedState
from turgor.reduced.states.energy import stored
from turgor.reduced.states.equations import Equations, EquationsAt
from turgor.reduced.states.newton import Balance, newton

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class Moving:
    """Inertia and damping of a reduced model in motion, with the names of `Dynamic`.

    Parameters
    ----------
    step : float [s]
        Longest time step; the requested times are met.
    mass_damping : float [1/s]
        Rayleigh's α.
    stiffness_damping : float [s]
        Rayleigh's β, a viscous stress in proportion to the rate of strain.
    spectral_radius : float [-]
        Numerical damping of vibrations that the steps do not resolve: 1 leaves all of them, 0 takes them at once.

    Examples
    --------
    >>> Moving(step=0.002).spectral_radius
    0.8
    """

    step: float = 0.004
    mass_damping: float = 0.0
    stiffness_damping: float = 0.0
    spectral_radius: float = 0.8

    def __post_init__(self) -> None:
        if not 0 < self.step < np.inf:
            raise TurgorError(f"step is {self.step:g} s; it must be more than 0.")
        for name in ("mass_damping", "stiffness_damping"):
            if not 0 <= getattr(self, name) < np.inf:
                raise TurgorError(f"{name} is {getattr(self, name):g}; allowed is 0 or more.")
        if not 0 <= self.spectral_radius <= 1:
            raise TurgorError(f"spectral_radius is {self.spectral_radius:g}; allowed is 0 to 1.")


@dataclass(frozen=True, slots=True, eq=False)
class Followed:
    """Answers along a history.

    Parameters
    ----------
    times : (k,) array [s]
    answers : tuple of ReducedState
    velocities : (k, r) array [1/s]
        Rates of the coordinates; zeros without inertia.
    energies : tuple of Energies
        Of the modeled part; empty without inertia.
    """

    times: Array
    answers: tuple[ReducedState, ...]
    velocities: Array
    energies: tuple[Energies, ...]

    @property
    def tip(self) -> Array:
        """Mean displacement (k, 3) [m] of the face ``tip``."""
        return np.array([answer.tip for answer in self.answers])


@dataclass(frozen=True, slots=True, eq=False)
class Now:
    """Where a history has arrived; the equations have the internal variables there.

    Parameters
    ----------
    time : float [s]
    equations : Equations
    at : EquationsAt
    inverse : (r + m, r + m) array
        Of the tangent of the last step.
    motion : Motion
    energies : Energies
    damping : (r,) array
        Scaled forces of the damping.
    """

    time: float
    equations: Equations
    at: EquationsAt
    inverse: Array
    motion: Motion
    energies: Energies
    damping: Array


def follow_history(reduced: Any, times: Array, table: Array, moving: Moving | None, start: ReducedState) -> Followed:
    """Follow inputs (k, n) at times (k,) from the equilibrium at the first of them; between them inputs are linear."""
    run, ends = Run(reduced, moving), np.column_stack([np.ones(len(times)), table])

    def inputs(time: float) -> Array:
        return np.array([np.interp(time, times, column) for column in ends.T])

    now = run.begin(start, float(times[0]))
    answers, rates, energies = [start], [now.motion.velocity], [now.energies]
    for time in times[1:]:
        while now.time < time:
            now = run.advance(now, time, inputs)
        answers.append(run.answer(now))
        rates.append(now.motion.velocity)
        energies.append(now.energies)
    return Followed(times, tuple(answers), np.array(rates), tuple(energies) if moving else ())


class Stepping:
    """A reduced model that another program drives step by step, from the equilibrium at some inputs.

    Parameters
    ----------
    reduced : Reduced
    inputs : (n,) array [SI]
    moving : Moving or None
        Inertia, damping and the longest time step; without, every state is an equilibrium.
    """

    def __init__(self, reduced: Any, inputs: Array, moving: Moving | None = None) -> None:
        self._run = Run(reduced, moving)
        self._now = self._run.begin(reduced.at(inputs), 0.0)

    def step(self, inputs: Array, length: float) -> ReducedState:
        """Return the answer after a time [s] in which the inputs (n,) are constant."""
        end, drive = self._now.time + length, np.concatenate([[1.0], inputs])
        while self._now.time < end:
            self._now = self._run.advance(self._now, end, lambda time: drive)
        return self._run.answer(self._now)


@dataclass(frozen=True, slots=True, eq=False)
class Run:
    """Steps of a reduced model in time.

    Parameters
    ----------
    reduced : Reduced
    moving : Moving or None
    """

    reduced: Any
    moving: Moving | None

    def begin(self, start: ReducedState, time: float) -> Now:
        """Begin in an equilibrium."""
        equations = _stepped(self.reduced.equations, inf)
        at = equations.at(start.y, np.concatenate([[1.0], start.inputs]))
        assert at is not None  # it was found before
        none = np.zeros(len(start.q))
        energy = stored(at) * self._unit if self.moving else 0.0
        energies = Energies(kinetic=0.0, strain=energy, dissipated=0.0, work=energy)
        motion = Motion(start.q, none, none, none)
        inverse: Array = np.linalg.inv(at.tangent()).astype(np.float64)
        return Now(time, _remembering(equations, at), at, inverse, motion, energies, none)

    @property
    def _unit(self) -> float:
        """Joule of a scaled force times a scaled length."""
        return self.reduced.scales[1] * self.reduced.scales[0] ** 3

    def advance(self, now: Now, aim: float, inputs: Callable[[float], Array]) -> Now:
        """Make one step towards a time, shorter where Newton's method finds nothing, with inputs (1 + n,) by time."""
        length = aim - now.time
        if self.moving is not None:
            length /= np.ceil(length / self.moving.step * (1 - 1e-9))
        for _ in range(NEWTON.substeps + 1):
            end = aim if length >= aim - now.time else now.time + length
            new = self.step(now, end, inputs(end))
            if new is not None:
                return new
            length *= 0.5
        raise NotSolved(
            f"the reduced model finds no state at {end:.4g} s, {self.reduced.inputs.text(inputs(end)[1:])}; "
            "train it more densely, or take shorter steps."
        )

    def step(self, now: Now, end: float, inputs: Array) -> Now | None:
        """Make a step to a time, at which the inputs are (1 + n,); None where Newton's method finds nothing."""
        reduced, r = self.reduced, len(now.motion.unknowns)
        equations = _stepped(now.equations, end - now.time)
        if self.moving is None:
            start = now.at.y - now.inverse @ (now.at.by_inputs() @ (inputs - now.at.inputs))
            for begin in (start, now.at.y):
                result = newton(equations, begin, inputs, reduced.size)
                if isinstance(result, Balance):
                    last = _remembering(equations, result.at)
                    return replace(now, time=end, equations=last, at=result.at, inverse=result.inverse)
            return None
        rule = TimeStep(Weights.of(self.moving.spectral_radius), now.motion, end - now.time, np.ones(r))
        start = np.concatenate([rule.prediction(), now.at.y[r:]])
        assert reduced.masses is not None
        inertia = Inertia(reduced.masses, rule, self.moving.mass_damping, self.moving.stiffness_damping)
        with_inertia = replace(equations, parts=(*equations.parts, inertia))
        for begin in (start, now.at.y):
            result = newton(with_inertia, begin, inputs, reduced.size)
            if isinstance(result, Balance):
                moved = self._moved(now, result, rule, end)
                return replace(moved, equations=_remembering(equations, moved.at))
        return None

    def _moved(self, now: Now, result: Balance, rule: TimeStep, end: float) -> Now:
        """The end of a step, with its energies; work by the trapezoidal rule."""
        at, r = result.at, len(now.motion.unknowns)
        (inertia,) = (part for part in at.parts if isinstance(part, InertiaAt))
        assert self.reduced.masses is not None
        motion, moved, before = rule.motion(at.y[:r]), at.y[:r] - now.at.y[:r], now.energies
        work = 0.5 * float((at.loads + now.at.loads) @ moved)
        for obstacle, earlier in zip(at.obstacles, now.at.obstacles, strict=True):
            work += obstacle.work(earlier, at.inputs - now.at.inputs)
        still = replace(at, parts=tuple(part for part in at.parts if part is not inertia))
        energies = Energies(
            kinetic=0.5 * self._unit * float(motion.velocity @ self.reduced.masses.mass @ motion.velocity),
            strain=self._unit * stored(still),
            dissipated=before.dissipated + 0.5 * self._unit * float((now.damping + inertia.damping) @ moved),
            work=before.work + self._unit * work,
        )
        return Now(end, now.equations, still, result.inverse, motion, energies, inertia.damping)

    def answer(self, now: Now) -> ReducedState:
        """The answer where the history is."""
        at = self.reduced.equations.at(now.at.y, now.at.inputs)
        assert at is not None  # it was found before
        answer = ReducedState.of(self.reduced, Balance.of(at, 0), 0)
        if self.moving is None and now.equations is self.reduced.equations:
            return answer
        away = np.linalg.norm(self.reduced.trained[:, : len(answer.q)] - answer.q, axis=1) / self.reduced.size
        near = int(away.argmin())
        place = self.reduced.trained_inputs[near] * self.reduced.weights
        known = self.reduced.known.at(place, float(np.linalg.norm(answer.q)) / self.reduced.size, answer.indicator)
        return replace(answer, estimate=max(known, answer.indicator, ESTIMATE.away * float(away[near])))


def _stepped(equations: Equations, length: float) -> Equations:
    """Equations with the internal variables for a step of a length [s]; the same where no rubber remembers."""
    if not any(isinstance(part, Points) and part.materials for part in equations.parts):
        return equations
    parts = (part.stepped(length) if isinstance(part, Points) and part.materials else part for part in equations.parts)
    return replace(equations, parts=tuple(parts))


def _remembering(equations: Equations, at: EquationsAt) -> Equations:
    """Equations with the internal variables at the end of a step."""
    new = (
        its.remembered() if isinstance(its, PointsAt) and its.points.memories else part
        for part, its in zip(equations.parts, at.parts, strict=False)
    )
    parts = tuple(new)
    same = all(a is b for a, b in zip(parts, equations.parts, strict=True))
    return equations if same else replace(equations, parts=parts)


def checked_history(times: Sequence[float] | Array, table: Array) -> Array:
    """Return times as an array.

    Raises
    ------
    TurgorError
        If they do not rise, or their number is not that of the inputs.
    """
    out = np.asarray(times, dtype=np.float64)
    if out.ndim != 1 or len(out) < 2 or not (np.diff(out) > 0).all():
        raise TurgorError("a history needs two times or more, each later than the one before.")
    if len(table) != len(out):
        raise TurgorError(
            f"the history has {len(out)} times and {len(table)} values of the inputs; both must be as many."
        )
    return out
