"""Clock: turn the parameter of a path into time, for rubber that relaxes."""

from dataclasses import dataclass, replace
from math import inf


@dataclass(frozen=True, slots=True)
class Clock:
    """The time at each parameter of a path, and where the present step began.

    Parameters
    ----------
    duration : float or None [s]
        Time at parameter 1; None where the path is so slow that all has relaxed.
    began : float [-]
        Parameter of the last state, from which a step goes.

    Examples
    --------
    >>> Clock(20.0, 0.25).time_of(0.5), Clock().time_of(0.5)
    (10.0, None)
    """

    duration: float | None = None
    began: float = 0.0

    def time_of(self, parameter: float) -> float | None:
        """Time at a parameter [s], None where there is no duration."""
        return None if self.duration is None else parameter * self.duration

    def step_to(self, parameter: float) -> float:
        """Length of a step from the last state to a parameter [s]; infinite where there is no duration."""
        return inf if self.duration is None else max(parameter - self.began, 0.0) * self.duration

    def onward(self, parameter: float) -> "Clock":
        """The clock beyond a state."""
        return replace(self, began=parameter)
