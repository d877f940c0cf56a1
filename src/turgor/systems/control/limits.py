"""Limits: pressures, their rates and volumes that control keeps."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from math import inf

import numpy as np
from numpy.typing import NDArray

from turgor.foundation.errors import TurgorError, unknown
from turgor.reduced.states.answer import ReducedState
from turgor.reduced.states.inputs import Inputs
from turgor.reduced.states.reduced import Reduced

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class Limits:
    """Limits of the inputs of a reduced model, such as pressures, and of the volumes of its cavities.

    Parameters
    ----------
    low, high : float or mapping of str to float [SI]
        Range of every input, or by the key of an input or its end; by default the range that was trained.
    rate : float or mapping of str to float [SI/s]
        Largest change of an input in a second.
    volume : mapping of str to (float, float) [m³]
        Range of the volume of a cavity.

    Examples
    --------
    >>> Limits(high=5e3, rate=20e3).high
    5000.0
    """

    low: float | Mapping[str, float] = field(default_factory=dict)
    high: float | Mapping[str, float] = field(default_factory=dict)
    rate: float | Mapping[str, float] = inf
    volume: Mapping[str, tuple[float, float]] = field(default_factory=dict)

    def of(self, reduced: Reduced) -> "LimitsOf":
        """Check them against a reduced model."""
        box = reduced.inputs
        low, high = _values(self.low, box, box.low, "low"), _values(self.high, box, box.high, "high")
        for vector in (low, high):
            box.check(vector)
        for place in np.flatnonzero(low > high).tolist():
            raise TurgorError(
                f"the limits of '{box.keys[place]}' are {box.shown(place, low[place])} to "
                f"{box.shown(place, high[place])}; low must not exceed high."
            )
        rate = _values(self.rate, box, np.full(len(low), inf), "rate")
        for place in np.flatnonzero(~(rate > 0)).tolist():
            raise TurgorError(f"the rate of '{box.keys[place]}' is {rate[place]:g}; allowed is more than 0.")
        volumes = np.tile([-inf, inf], (len(reduced.faces), 1))
        for face, (least, most) in self.volume.items():
            if face not in reduced.faces:
                raise unknown("cavity", face, reduced.faces)
            if not least < most:
                raise TurgorError(
                    f"the volume of '{face}' is limited to {least * 1e6:g} to {most * 1e6:g} mL; its end must exceed "
                    "its beginning."
                )
            volumes[reduced.faces.index(face)] = least, most
        return LimitsOf(reduced, low, high, rate, volumes)


def _values(given: float | Mapping[str, float], box: Inputs, default: Array, name: str) -> Array:
    if not isinstance(given, Mapping):
        given = dict.fromkeys(box.keys, given)
    out = default.astype(np.float64).copy()
    for key, value in given.items():
        if np.isnan(value):
            raise TurgorError(f"{name} of '{key}' is {value}; a number is needed.")
        out[box.place(key)] = value
    return out


@dataclass(frozen=True, slots=True, eq=False)
class LimitsOf:
    """Limits of one reduced model.

    Parameters
    ----------
    reduced : Reduced
    low, high, rate : (n,) arrays
    volumes : (cavities, 2) array
        Infinite where there is no limit.
    """

    reduced: Reduced
    low: Array
    high: Array
    rate: Array
    volumes: Array

    @property
    def widths(self) -> Array:
        """Range of each input, by which changes are scaled."""
        return self.reduced.inputs.high - self.reduced.inputs.low

    def after(self, inputs: Array | None, seconds: float) -> tuple[Array, Array]:
        """Range of the inputs some time after others, or at first."""
        if inputs is None:
            return self.low, self.high
        change = self.rate * seconds
        low, high = np.maximum(self.low, inputs - change), np.minimum(self.high, inputs + change)
        return np.minimum(low, self.high), np.maximum(high, self.low)

    def rows(self, state: ReducedState) -> tuple[Array, Array]:
        """Limits of volumes as C dp ≤ d, linear in a change of the inputs."""
        rows, ends = [], []
        if np.isfinite(self.volumes).any():
            for value, slopes, (least, most) in zip(
                state.volumes.values(), state.volume_rates.values(), self.volumes, strict=False
            ):
                scale = max(abs(value), 1e-300)
                rows += [-slopes / scale, slopes / scale]
                ends += [(value - least) / scale, (most - value) / scale]
        keep = np.isfinite(ends)
        return np.array(rows).reshape(-1, len(self.low))[keep], np.array(ends)[keep]

    def excess(self, state: ReducedState) -> float:
        """Largest share by which a volume exceeds its limit; 0 where none does."""
        _, ends = self.rows(state)
        return float(max(0.0, *-ends)) if len(ends) else 0.0

    def active(self, state: ReducedState, before: Array | None, seconds: float, within: float) -> tuple[str, ...]:
        """Name the limits that a state has reached, within a share of the range."""
        names = []
        low, high = self.after(before, seconds)
        for place, key in enumerate(self.reduced.inputs.keys):
            value, slack = state.inputs[place], within * self.widths[place]
            for end, bound, own in (("low", low, self.low), ("high", high, self.high)):
                if abs(value - bound[place]) <= slack and low[place] < high[place]:
                    names.append(f"{key} {end}" if bound[place] == own[place] else f"{key} rate")
        for face, value, ends in zip(self.reduced.faces, state.volumes.values(), self.volumes, strict=False):
            for end, bound in zip(("low", "high"), ends, strict=True):
                if np.isfinite(bound) and abs(value - bound) <= max(within, 1e-7) * abs(bound):
                    names.append(f"volume of {face} {end}")
        return tuple(dict.fromkeys(names))
