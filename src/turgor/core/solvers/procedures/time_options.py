"""Time options: steps in time, damping and iterations of a procedure with inertia."""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from turgor.core.solvers.procedures.procedure import Procedure
from turgor.core.solvers.procedures.step_options import make_numbers
from turgor.foundation.errors import TurgorError
from turgor.foundation.given import vector

Array = NDArray[np.float64]

#: Velocity [m/s] of points at rest, or one of the whole body.
Velocity: TypeAlias = Callable[[Array], Array] | tuple[float, float, float]

TIME = {"dimension": "time"}


@dataclass(frozen=True, slots=True, kw_only=True)
class TimeOptions(Procedure):
    """Steps in time, damping, and the iterations in each step; `Dynamic` extends them and says what each one is."""

    duration: float = field(metadata=TIME)
    first_step: float | None = field(default=None, metadata=TIME)
    max_step: float | None = field(default=None, metadata=TIME)
    min_step: float | None = field(default=None, metadata=TIME)
    accuracy: float = 1e-3
    adaptive: bool = True
    mass_damping: float = field(default=0.0, metadata={"dimension": "rate"})
    stiffness_damping: float = field(default=0.0, metadata=TIME)
    spectral_radius: float = 0.8
    velocity: Velocity | None = field(default=None, metadata={"dimension": "speed", "three": True})
    at: tuple[float, ...] = ()
    keep: int = 1
    tolerance: float = 1e-6
    max_iterations: int = 15
    max_steps: int = 100_000

    def __post_init__(self) -> None:
        make_numbers(self)
        if self.velocity is not None and not callable(self.velocity):
            object.__setattr__(self, "velocity", vector(self.velocity, "procedure.velocity", "speed"))
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
