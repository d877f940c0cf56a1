"""Controller: pressures for a loop, from a target and a measurement, with a short horizon and the delay of the air."""

from collections import deque
from dataclasses import dataclass
from math import exp

import numpy as np
from numpy.typing import NDArray

from turgor.foundation.errors import NotSolved, TurgorError
from turgor.reduced.states.answer import ReducedState
from turgor.reduced.states.reduced import Reduced
from turgor.systems.control.forces import continued
from turgor.systems.control.least_squares import least_squares
from turgor.systems.control.limits import Limits, LimitsOf
from turgor.systems.control.outputs import Output, OutputOf, Tip
from turgor.systems.control.search import moved

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class Air:
    """How pressures in the chambers follow commands: after a delay, with a lag of first order.

    Parameters
    ----------
    delay : float [s]
        Rounded to whole periods.
    lag : float [s]
        Time constant.

    Examples
    --------
    >>> Air(delay=10e-3, lag=20e-3).decay(10e-3).__round__(3), Air(delay=10e-3).periods(5e-3)
    (0.607, 2)
    """

    delay: float = 0.0
    lag: float = 0.0

    def __post_init__(self) -> None:
        for name in ("delay", "lag"):
            if not 0 <= getattr(self, name) < np.inf:
                raise TurgorError(f"{name} of the air is {getattr(self, name):g} s; allowed is 0 s or more.")

    def periods(self, period: float) -> int:
        """Delay in whole periods."""
        return round(self.delay / period)

    def decay(self, period: float) -> float:
        """Share of a difference of pressure that is left after a period."""
        return exp(-period / self.lag) if self.lag else 0.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Tuning:
    """How a controller weighs errors, changes and measurements.

    Parameters
    ----------
    horizon : int
        Periods ahead that are optimized, at least one.
    smoothness : float
        Weight of the square of a change of an input over its range, against that of an error over the output's size.
    gain : float
        Share of the difference between measurement and prediction that the observer learns in a period, 0 to 1:
        large values remove errors of the model quickly and pass on noise.

    Examples
    --------
    >>> Tuning(gain=0.2).horizon
    3
    """

    horizon: int = 3
    smoothness: float = 1e-5
    gain: float = 0.1

    def __post_init__(self) -> None:
        if self.horizon < 1:
            raise TurgorError(f"horizon is {self.horizon}; allowed is 1 or more.")
        if not self.smoothness > 0:
            raise TurgorError(f"smoothness is {self.smoothness:g}; allowed is more than 0.")
        if not 0 <= self.gain <= 1:
            raise TurgorError(f"gain is {self.gain:g}; allowed is 0 to 1.")


class Controller:
    """Pressures for a loop, one call each period.

    The reduced model predicts the output when a new command arrives in the chambers. Inputs of a short horizon minimize
    ``Σ ‖y + d − y*‖² + μ ‖Δu‖²`` under the limits, with exact derivatives; the first one is the command. The observer
    of a constant disturbance d compares each measurement with what was predicted for it, so that errors of the model
    do not stay.

    Parameters
    ----------
    reduced : Reduced
    period : float [s]
        Time between calls.
    output : Output, optional
        What is measured and follows: `Tip` (the default), `Points`, `Shape`, `Angle` or `ContactForce`.
    limits : Limits, optional
    air : Air, optional
        Delay and lag between command and chamber.
    tuning : Tuning, optional
    """

    def __init__(
        self,
        reduced: Reduced,
        *,
        period: float,
        output: Output | None = None,
        limits: Limits | None = None,
        air: Air | None = None,
        tuning: Tuning | None = None,
    ) -> None:
        if not 0 < period < np.inf:
            raise TurgorError(f"period is {period:g} s; allowed is more than 0 s.")
        self.period, self.tuning, self.air = period, tuning or Tuning(), air or Air()
        self.follows = output or Tip()
        self.output: OutputOf = self.follows.of(reduced)
        self.limits: LimitsOf = (limits or Limits()).of(reduced)
        rest = np.clip(np.zeros(len(self.limits.low)), self.limits.low, self.limits.high)
        self.reset(reduced.at(rest))

    def reset(self, state: ReducedState) -> None:
        """Begin again at a state, at which the actuator rests.

        Parameters
        ----------
        state : ReducedState
        """
        value = self.output.at(state)[0]
        self.state, self.command, self.disturbance = state, state.inputs.copy(), np.zeros(len(value))
        self._predicted = deque([value] * (self.air.periods(self.period) + 1))

    def step(self, target: Array, measured: Array) -> Array:
        """Return the inputs to command now.

        Parameters
        ----------
        target : (m,) or (k, m) array [SI]
            Wanted output now, or now and in the next periods; the last row counts for all later ones.
        measured : (m,) array [SI]
            Output as measured now.

        Returns
        -------
        (n,) array [SI]
        """
        m = len(self.output.names)
        rows, seen = np.atleast_2d(np.asarray(target, dtype=np.float64)), np.asarray(measured, dtype=np.float64)
        if rows.shape[1] != m or seen.shape != (m,) or not (np.isfinite(rows).all() and np.isfinite(seen).all()):
            raise TurgorError(
                f"target and measurement have the shapes {rows.shape} and {seen.shape}; needed are {m} finite numbers, "
                f"{', '.join(self.output.names)}."
            )
        self.disturbance += self.tuning.gain * (seen - self._predicted.popleft() - self.disturbance)
        ahead = self.air.periods(self.period) + 1
        wanted = rows[np.minimum(np.arange(ahead, ahead + self.tuning.horizon), len(rows) - 1)] - self.disturbance
        command = self._plan(wanted)
        decay = self.air.decay(self.period)
        # where the model has no equilibrium, its last state stays, and the observer learns the difference
        try:
            self.state = moved(self.state, decay * self.state.inputs + (1 - decay) * command)
        except NotSolved:
            command = self.command
        self.command = command
        self._predicted.append(self.output.at(self.state)[0])
        return command.copy()

    def _plan(self, wanted: Array) -> Array:
        """First of the inputs (n,) of the horizon that bring the output nearest to what is wanted (h, m)."""
        widths, n, h = self.limits.widths, len(self.command), len(wanted)
        value, slopes = continued(self.output, self.state)
        by_inputs = slopes * (widths / self.output.size)
        effect = _lagged(h, self.air.decay(self.period))
        change = np.eye(h) - np.eye(h, k=-1)  # of each input of the horizon since the one before
        A = np.vstack([np.kron(effect, by_inputs), np.sqrt(self.tuning.smoothness) * np.kron(change, np.eye(n))])
        # unknowns are the inputs over their ranges, counted from the pressures when the command arrives
        last = (self.command - self.state.inputs) / widths
        b = np.concatenate([((wanted - value) / self.output.size).ravel(), np.zeros(n * h)])
        b[wanted.size : wanted.size + n] = np.sqrt(self.tuning.smoothness) * last
        up, down = (self.limits.high - self.state.inputs) / widths, (self.state.inputs - self.limits.low) / widths
        rows, ends = self.limits.rows(self.state)
        C = [np.eye(n * h), -np.eye(n * h), np.kron(effect, rows * widths)]
        d = [np.tile(up, h), np.tile(down, h), np.tile(ends, h)]
        rate = self.limits.rate * self.period / widths
        quick = np.isfinite(rate)
        if quick.any():
            each, first = np.kron(change, np.eye(n)[quick]), np.zeros(h * quick.sum())
            first[: quick.sum()] = last[quick]
            C += [each, -each]
            d += [np.tile(rate[quick], h) + first, np.tile(rate[quick], h) - first]
        result = least_squares(A, b, np.vstack(C), np.concatenate(d))
        if result is None:  # a volume cannot come back within its limits so soon
            C[2], d[2] = np.zeros((0, n * h)), np.zeros(0)
            result = least_squares(A, b, np.vstack(C), np.concatenate(d))
        plan = self.command if result is None else self.state.inputs + result.x[:n] * widths
        low, high = self.limits.after(self.command, self.period)
        return np.clip(plan, low, high)


def _lagged(count: int, decay: float) -> Array:
    """Effect (h, h) of the inputs of a horizon on the pressures after each period, counted from the first pressure."""
    powers = np.arange(count)[:, None] - np.arange(count)
    return np.where(powers >= 0, (1 - decay) * decay ** np.maximum(powers, 0), 0.0)
