"""Valves: pressures in the cavities of a reduced model as flows of gas through valves let them follow commands."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.foundation.errors import TurgorError
from turgor.reduced.states.answer import ReducedState
from turgor.reduced.states.reduced import Reduced
from turgor.systems.air.fluids import AIR, REFERENCE_TEMPERATURE, STANDARD_ATMOSPHERE, Gas
from turgor.systems.air.parts.passages import FlowLaw, Passage

Array = NDArray[np.float64]

#: Longest step of the flows [s]; ten times shorter ones change pressures by less than a percent of the range.
STEP = 1e-3


@dataclass(frozen=True, slots=True, kw_only=True)
class Valves:
    """A valve for each pressure, which opens in proportion to what is missing: to the supply, or to the air around.

    Gas keeps its temperature. The volumes that it fills are those of the cavities: they press each other, and yield to
    forces.

    Parameters
    ----------
    supply : float [Pa], gauge
        What the valves fill from.
    valve : Restriction, Orifice or Tubing
        What resists the flow, when it is fully open.
    band : float [Pa]
        Missing pressure at which a valve is fully open.
    delay : float [s]
        Before a valve sees a command; rounded to whole periods.
    gas : Gas

    Examples
    --------
    >>> from turgor.systems.air.parts.passages import Restriction
    >>> Valves(supply=100e3, valve=Restriction(conductance=1e-9)).band
    1000.0
    """

    supply: float
    valve: Passage
    band: float = 1000.0
    delay: float = 0.0
    gas: Gas = AIR

    def __post_init__(self) -> None:
        if not 0 < self.supply < np.inf:
            raise TurgorError(f"supply is {self.supply:g} Pa; allowed is more than 0 Pa.")
        if not 0 < self.band < np.inf:
            raise TurgorError(f"band is {self.band:g} Pa; allowed is more than 0 Pa.")
        if not 0 <= self.delay < np.inf:
            raise TurgorError(f"delay of the valves is {self.delay:g} s; allowed is 0 s or more.")
        if not isinstance(self.gas, Gas):
            raise TurgorError(f"the valves need a gas; {self.gas!r} is none.")

    def periods(self, period: float) -> int:
        """Delay in whole periods."""
        return round(self.delay / period)

    def after(self, state: ReducedState, commands: Array, period: float) -> Array:
        """Pressures (k,) [Pa] a period after a state, with commands (k,) [Pa] of the inputs that are pressures."""
        law, count = self.valve.law(self.gas), max(1, int(np.ceil(period / STEP)))
        density = 1.0 / (self.gas.gas_constant * REFERENCE_TEMPERATURE)
        places, cavities = pressed(state.reduced)
        pressures, volumes = state.inputs[places], np.array(list(state.volumes.values()))
        slopes = np.array(list(state.volume_rates.values()))[:, places]
        for _ in range(count):
            absolute = cavities @ pressures + STANDARD_ATMOSPHERE
            # derivative of the mass that each input fills, by the pressures
            stored = density * cavities.T @ (volumes[:, None] * cavities + absolute[:, None] * slopes)
            flows, falls = self._flows(law, commands, pressures)
            step = period / count
            change = np.linalg.solve(stored - step * np.diag(falls), step * flows)
            pressures, volumes = pressures + change, volumes + slopes @ change
        return pressures

    def _flows(self, law: FlowLaw, commands: Array, pressures: Array) -> tuple[Array, Array]:
        """Mass flows (n,) [kg/s] into the cavities, and their derivatives by their pressures."""

        def flow(missing: float, pressure: float) -> float:
            opening = min(max(missing / self.band, -1.0), 1.0)
            absolute = pressure + STANDARD_ATMOSPHERE
            other = STANDARD_ATMOSPHERE + (self.supply if opening > 0 else 0.0)
            size = law(max(other, absolute), min(other, absolute), REFERENCE_TEMPERATURE)
            return abs(opening) * (size if other > absolute else -size)

        small = 1e-4 * self.band
        at = [flow(w - p, p) for w, p in zip(commands.tolist(), pressures.tolist(), strict=True)]
        more = [flow(w - p - small, p + small) for w, p in zip(commands.tolist(), pressures.tolist(), strict=True)]
        return np.array(at), np.minimum((np.array(more) - at) / small, 0.0)


def pressed(reduced: Reduced) -> tuple[NDArray[np.intp], Array]:
    """Places (k,) of the inputs that are pressures, and by these the pressures (f, k) of the faces."""
    by_inputs = reduced.equations.pressures[:, 1:]
    places = np.flatnonzero(by_inputs.any(axis=0))
    return places, by_inputs[:, places] * reduced.scales[1]
