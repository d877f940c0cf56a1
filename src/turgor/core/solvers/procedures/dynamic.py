"""Dynamic: the procedure that follows an actuator through time, with its inertia."""

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from turgor.core.solvers.procedures.step_options import make_numbers
from turgor.foundation.errors import TurgorError

Array = NDArray[np.float64]

TIME = {"dimension": "time"}


@dataclass(frozen=True, slots=True, kw_only=True)
class Dynamic:
    """Implicit dynamics of second order: the load factor is time over duration, and histories of loads are over it.

    The generalized-α method in the form that imposes equilibrium and constant volume at the end of every step (Arnold
    and Brüls 2007, doi 10.1007/s11044-007-9084-0). Steps adapt to an estimate of their error.

    Parameters
    ----------
    duration : float [s]
        Time at load factor 1.
    first_step : float [s], optional
        First time step; a thousandth of the duration by default.
    max_step : float [s], optional
        Longest step; a fiftieth of the duration by default.
    min_step : float [s], optional
        Shortest step before the run stops; a millionth of the duration by default.
    accuracy : float [-]
        Largest error of the displacement in one step, as a share of the largest displacement so far.
    adaptive : bool
        Whether steps adapt to the error; otherwise all are as long as the first, except where a load turns.
    mass_damping : float [1/s]
        Rayleigh's α: damping in proportion to the mass, strongest for slow motions. It resists rigid motions too.
    stiffness_damping : float [s]
        Rayleigh's β: damping in proportion to the rate of strain, strongest for fast vibrations; of the order of
        milliseconds for silicone.
    spectral_radius : float [-]
        Numerical damping of vibrations that the steps do not resolve: 1 leaves all of them, 0 takes them at once. With
        mean stresses as unknowns, 1 leaves these free to oscillate from step to step.
    velocity : callable, optional
        ``velocity(points) -> (n, 3) velocity [m/s]`` at the start, of the (n, 3) reference points [m]. The part that
        would change the volume of incompressible rubber is taken out.
    at : tuple of float [-]
        Load factors, time over duration, that must be hit exactly besides 1, each in (0, 1].
    keep : int
        Every which state is kept, besides the last one and the requested ones.
    tolerance : float [-]
        Largest residual force relative to the applied and reaction forces.
    max_iterations : int
        Newton iterations before a step is cut.
    max_steps : int
        Attempted steps before the run stops.

    Examples
    --------
    >>> Dynamic(duration=0.5).step_bounds
    (0.0005, 0.01, 5e-07)
    """

    duration: float = field(metadata=TIME)
    first_step: float | None = field(default=None, metadata=TIME)
    max_step: float | None = field(default=None, metadata=TIME)
    min_step: float | None = field(default=None, metadata=TIME)
    accuracy: float = 1e-3
    adaptive: bool = True
    mass_damping: float = field(default=0.0, metadata={"dimension": "rate"})
    stiffness_damping: float = field(default=0.0, metadata=TIME)
    spectral_radius: float = 0.8
    velocity: Callable[[Array], Array] | None = field(default=None, metadata={"job": False})
    at: tuple[float, ...] = ()
    keep: int = 1
    tolerance: float = 1e-6
    max_iterations: int = 15
    max_steps: int = 100_000

    def __post_init__(self) -> None:
        make_numbers(self)
        if not 0 < self.duration < np.inf:
            raise TurgorError(f"procedure.duration is {self.duration:g} s; it must be more than 0.")
        for name in ("first_step", "max_step", "min_step"):
            value = getattr(self, name)
            if value is not None and not 0 < value <= self.duration:
                raise TurgorError(
                    f"procedure.{name} is {value:g} s; allowed is more than 0 up to the duration, {self.duration:g} s."
                )
        first, longest, shortest = self.step_bounds
        if not shortest <= first <= longest:
            raise TurgorError(
                f"procedure.first_step is {first:g} s; it must lie between min_step, {shortest:g} s, and max_step, "
                f"{longest:g} s."
            )
        self._check_numbers()

    def _check_numbers(self) -> None:
        ranges = {"accuracy": (1e-9, 0.1), "tolerance": (1e-12, 1e-2), "spectral_radius": (0.0, 1.0)}
        for name, (low, high) in ranges.items():
            if not low <= getattr(self, name) <= high:
                raise TurgorError(f"procedure.{name} is {getattr(self, name):g}; allowed is {low:g} to {high:g}.")
        for name in ("mass_damping", "stiffness_damping"):
            if not 0 <= getattr(self, name) < np.inf:
                raise TurgorError(f"procedure.{name} is {getattr(self, name):g}; allowed is 0 or more.")
        for name in ("keep", "max_iterations", "max_steps"):
            if getattr(self, name) < 1:
                raise TurgorError(f"procedure.{name} is {getattr(self, name)}; allowed is 1 or more.")
        for factor in self.at:
            if not 0 < factor <= 1:
                raise TurgorError(f"procedure.at holds {factor:g}; a load factor lies in (0, 1].")

    @property
    def step_bounds(self) -> tuple[float, float, float]:
        """First, longest and shortest step [s]."""
        first = self.duration / 1000 if self.first_step is None else self.first_step
        longest = max(first, self.duration / 50) if self.max_step is None else self.max_step
        shortest = min(first, self.duration / 1e6) if self.min_step is None else self.min_step
        return (first if self.first_step is not None else min(first, longest)), longest, shortest
