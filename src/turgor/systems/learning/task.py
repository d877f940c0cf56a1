"""FollowTask: what an agent is to do with a simulated actuator."""

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike

from turgor.foundation.errors import TurgorError
from turgor.reduced.states.reduced import Reduced
from turgor.systems.control.controller import Air
from turgor.systems.control.limits import Limits
from turgor.systems.control.outputs import Output, Tip
from turgor.systems.control.track import checked_path
from turgor.systems.learning.valves import Valves, pressed


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class FollowTask:
    """An output of an actuator is to follow a path, by commands of pressure.

    Parameters
    ----------
    reduced : Reduced
        Its pressures are commanded. Other inputs, such as a force on the tip, are drawn at each reset within the limits
        and stay.
    output : Output
        What follows: `Tip` (the default), `Points`, `Shape` or `Angle`.
    limits : Limits
        Of the inputs and of the rates of commands. A force with equal low and high is not drawn.
    air : Air or Valves
        How pressures follow commands.
    period : float [s]
        Time between commands.
    steps : int
        Periods of an episode.
    path : (k, m) array [SI], optional
        What is to be followed, a row each period; the last row stays. By default each reset draws a smooth path that
        the actuator can reach.
    ahead : int
        Later rows of the path that are observed.
    noise : float [SI]
        Standard deviation of each measured number of the output.
    pressure_noise : float [Pa]
        Standard deviation of each measured pressure.
    effort : float [-]
        Weight of the mean square change of the action in the reward.

    Raises
    ------
    TurgorError
        If a value is out of range, or the limits have volumes.
    """

    reduced: Reduced
    output: Output = field(default_factory=Tip)
    limits: Limits = field(default_factory=Limits)
    air: Air | Valves = field(default_factory=lambda: Air(lag=20e-3))
    period: float = 20e-3
    steps: int = 200
    path: ArrayLike | None = None
    ahead: int = 1
    noise: float = 0.0
    pressure_noise: float = 0.0
    effort: float = 0.01

    def __post_init__(self) -> None:
        if not 0 < self.period < np.inf:
            raise TurgorError(f"period is {self.period:g} s; allowed is more than 0 s.")
        if self.steps < 1:
            raise TurgorError(f"steps is {self.steps}; allowed is 1 or more.")
        for name in ("ahead", "noise", "pressure_noise", "effort"):
            if not 0 <= getattr(self, name) < np.inf:
                raise TurgorError(f"{name} is {getattr(self, name):g}; allowed is 0 or more.")
        if self.limits.volume:
            raise TurgorError(f"limits of volumes, here of {', '.join(self.limits.volume)}, are not part of this task.")
        if not len(pressed(self.reduced)[0]):
            raise TurgorError(f"no input is a pressure; the inputs are {', '.join(self.reduced.inputs.keys)}.")
        of = self.output.of(self.reduced)
        self.limits.of(self.reduced)
        if self.path is not None:
            object.__setattr__(self, "path", checked_path(np.asarray(self.path, dtype=np.float64), of))
