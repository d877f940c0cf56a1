"""Checks of what all procedures say about their steps."""

from math import inf
from typing import Protocol

from turgor.errors import TurgorError
from turgor.solvers.continuation.step_control import Steps


class SteppedProcedure(Steps, Protocol):
    """What all of them say about steps and iterations."""

    @property
    def tolerance(self) -> float:
        """Largest relative residual."""

    @property
    def max_iterations(self) -> int:
        """Iterations of a step."""

    @property
    def max_steps(self) -> int:
        """Attempted steps."""


def check_steps(steps: SteppedProcedure, longest: float = 1.0) -> None:
    """Refuse steps, tolerances, numbers of iterations and a duration that make no sense.

    Raises
    ------
    TurgorError
        Naming the field, its value and what is allowed; ``longest`` is the largest step allowed.
    """
    duration = getattr(steps, "duration", None)
    if duration is not None and not 0 < duration < inf:
        raise TurgorError(f"procedure.duration is {duration:g} s; it must be more than 0.")
    for name, upper in (("first_step", 1.0), ("max_step", longest), ("min_step", 1.0)):
        value = getattr(steps, name)
        if not 0 < value <= upper:
            raise TurgorError(f"procedure.{name} is {value:g}; allowed is more than 0 up to {upper:g}.")
    if steps.min_step > steps.first_step:
        raise TurgorError(
            f"procedure.min_step is {steps.min_step:g}; it must not exceed first_step, {steps.first_step:g}."
        )
    if not 1e-12 <= steps.tolerance <= 1e-2:
        raise TurgorError(f"procedure.tolerance is {steps.tolerance:g}; allowed is 1e-12 to 0.01.")
    for name in ("max_iterations", "max_steps"):
        if getattr(steps, name) < 1:
            raise TurgorError(f"procedure.{name} is {getattr(steps, name)}; allowed is 1 or more.")
    for factor in steps.at:
        if not 0 < factor <= 1:
            raise TurgorError(f"procedure.at holds {factor:g}; a load factor lies in (0, 1].")
