"""Pumps: flow against a difference of pressures."""

import itertools
from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import ClassVar

from turgor.foundation.errors import TurgorError
from turgor.systems.air.parts.part import Around, Part, PartFlow, Port
from turgor.systems.air.signals import AnySignal, signal_of


@dataclass(frozen=True, slots=True)
class Pump(Part):
    """A pump or compressor by its curve: volume flow at the inlet against the rise of pressure.

    Between its points the curve is straight. A rise beyond the last one stops the flow: nothing flows back.

    Parameters
    ----------
    start, end : str
        Inlet and outlet.
    rise : sequence of float [Pa]
        Rising differences of pressures.
    volume_flow : sequence of float [m³/s]
        Volume flow of the fluid at the inlet, which does not rise; the last one is 0.
    speed : float or Signal [-]
        Factor on the flow.

    Examples
    --------
    >>> pump = Pump("ambient", "finger", rise=(0.0, 40e3), volume_flow=(2e-5, 0.0))
    >>> pump.volume_flow_at(20e3)
    1e-05
    """

    kind: ClassVar[str] = "pump"

    rise: Sequence[float] = field(metadata={"dimension": "pressure"})
    volume_flow: Sequence[float] = field(metadata={"dimension": "flow rate"})
    speed: AnySignal = 1.0

    def __post_init__(self) -> None:
        rise, flow = tuple(map(float, self.rise)), tuple(map(float, self.volume_flow))
        object.__setattr__(self, "rise", rise)
        object.__setattr__(self, "volume_flow", flow)
        if len(rise) != len(flow) or len(rise) < 2:
            raise TurgorError(
                f"a pump curve has {len(rise)} rises and {len(flow)} flows; two or more of each are needed."
            )
        if any(b <= a for a, b in itertools.pairwise(rise)):
            raise TurgorError("rise of a pump must grow from point to point.")
        if any(b > a for a, b in itertools.pairwise(flow)) or flow[-1] != 0.0:
            raise TurgorError(f"volume_flow of a pump must fall to 0; its last value is {flow[-1]:g} m³/s.")

    def volume_flow_at(self, rise: float) -> float:
        """Volume flow at the inlet [m³/s] at a rise of pressure [Pa]."""
        k = bisect_right(self.rise, rise) - 1
        if k < 0:
            return self.volume_flow[0]
        if k >= len(self.rise) - 1:
            return 0.0
        share = (rise - self.rise[k]) / (self.rise[k + 1] - self.rise[k])
        return self.volume_flow[k] + share * (self.volume_flow[k + 1] - self.volume_flow[k])

    def breaks(self, until: float) -> Sequence[float]:
        """Times at which the speed bends or jumps."""
        return signal_of(self.speed).breaks(until)

    def flow(self, around: Around) -> PartFlow:
        """Return density at the inlet times volume flow."""
        signal, density = signal_of(self.speed), around.fluid.density

        def flow(time: float, own: Sequence[float], a: Port, b: Port) -> float:
            return signal.at(time) * density(a[0], a[1]) * self.volume_flow_at(b[0] - a[0])

        return flow


@dataclass(frozen=True, slots=True)
class FlowSource(Part):
    """A flow that does not depend on pressures: a syringe pump or a mass flow controller.

    Parameters
    ----------
    start, end : str
    volume_flow : float or Signal [m³/s]
        Of a gas at 100 kPa and 20 °C; negative from end to start.
    """

    kind: ClassVar[str] = "flow_source"

    volume_flow: AnySignal = field(metadata={"dimension": "flow rate"})

    def breaks(self, until: float) -> Sequence[float]:
        """Times at which the flow bends or jumps."""
        return signal_of(self.volume_flow).breaks(until)

    def flow(self, around: Around) -> PartFlow:
        """Return the given flow."""
        signal, density = signal_of(self.volume_flow), around.fluid.reference_density
        return lambda time, own, a, b: density * signal.at(time)
