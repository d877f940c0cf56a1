"""Channels: the pressures of cavities are unknown, and their volumes change by what flows through channels."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.chamber_volumes import Chambers
from turgor.core.model.drive import pressures_at
from turgor.core.solvers.constraints.constraint import Place
from turgor.core.solvers.constraints.elimination import Conditions

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class ChannelTarget:
    """The volume of each closed cavity changes by the inflow q = Σ (p_other − p)/R and by what a pump injects evenly.

    Backward differences (BDF2) are of second order in the step and damp what the steps do not resolve; the first step
    is backward Euler.

    Parameters
    ----------
    chambers : Chambers
        Closed cavities, whose pressures are the scalars.
    duration : float [s]
        Time at parameter 1.
    volume : float
        Scaled volume to which errors are relative.
    injected : (k,) array
        Scaled volumes that are injected from parameter 0 to 1.
    before : tuple of (float, (k,) array)
        Parameters and scaled volumes of the last one or two states, the last one first.
    """

    chambers: Chambers
    duration: float
    volume: float
    injected: Array
    before: tuple[tuple[float, Array], ...]

    def conditions(self, unknowns: Array, parameter: float, scalars: Array) -> Conditions:
        """Errors of the volumes."""
        step, weight, known = self._differences(parameter)
        inflow, conductance = self._flows(parameter, scalars)
        inflow = inflow + self.injected / self.duration
        errors = (weight * self.chambers.volumes(unknowns) + known - step * inflow) / self.volume
        rows = weight * self.chambers.gradients(unknowns) / self.volume
        return Conditions(errors, rows, step * conductance / self.volume)

    def onward(self, last: Place, now: Place) -> "ChannelTarget":
        """The conditions beyond a state."""
        return self.beyond(now.parameter, now.unknowns)

    def beyond(self, parameter: float, unknowns: Array) -> "ChannelTarget":
        """The conditions beyond the state at a parameter."""
        return replace(self, before=((parameter, self.chambers.volumes(unknowns)), *self.before[:1]))

    def _differences(self, parameter: float) -> tuple[float, float, Array]:
        """Step [s], and the weight and the constant of the step times the rate of the volumes."""
        last, volumes = self.before[0]
        step = parameter - last
        if len(self.before) == 1:
            return step * self.duration, 1.0, -volumes
        earlier, volumes_earlier = self.before[1]
        ratio = step / (last - earlier)
        known = ratio**2 / (1 + ratio) * volumes_earlier - (1 + ratio) * volumes
        return step * self.duration, (1 + 2 * ratio) / (1 + ratio), known

    def _flows(self, parameter: float, scalars: Array) -> tuple[Array, Array]:
        """Scaled inflow (k,) [1/s], and minus its derivatives (k, k) by the scaled pressures."""
        system, names = self.chambers.system, self.chambers.faces
        stated, count = pressures_at(system.model, parameter), len(names)
        supplied, conductance = np.zeros(count), np.zeros((count, count))
        for channel in (load.channel for load in system.model.loads if load.channel is not None):
            share = channel.share(parameter) / channel.resistance * system.stress_scale / system.length**3
            for here, there in (channel.between, channel.between[::-1]):
                if here not in names:
                    continue
                row = names.index(here)
                conductance[row, row] += share
                if there in names:
                    conductance[row, names.index(there)] -= share
                else:
                    supplied[row] += share * stated[there] / system.stress_scale
        return supplied - conductance @ scalars, conductance
