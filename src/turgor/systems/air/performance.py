"""performance: how fast an actuator fills, vents and follows, what that takes, and which part limits it."""

from dataclasses import dataclass, replace
from math import log10, pi

import numpy as np

from turgor.foundation.display import Shown
from turgor.foundation.errors import NotSolved, TurgorError, unknown
from turgor.systems.air.driven import ACTUATOR, VALVE
from turgor.systems.air.equations import Equations
from turgor.systems.air.fluids import Gas
from turgor.systems.air.history import History
from turgor.systems.air.integrate import integrate
from turgor.systems.air.network import Network
from turgor.systems.air.nodes import Chamber
from turgor.systems.air.parts.regulator import Regulator
from turgor.systems.air.parts.valves import ThreeWayValve
from turgor.systems.air.settings import PERFORMANCE
from turgor.systems.air.signals import AnySignal, Signal, Sine


@dataclass(frozen=True, slots=True, kw_only=True)
class Wider:
    """What twice the cross-section of a part would bring.

    Parameters
    ----------
    part : str
    fill_time, vent_time : float [s]
        With the wider part.
    """

    part: str
    fill_time: float
    vent_time: float


@dataclass(frozen=True, slots=True, kw_only=True)
class Performance(Shown):
    """What an actuator with its supply does.

    Parameters
    ----------
    pressure : float [Pa], gauge
        Wanted pressure in the chamber.
    fill_time : float [s]
        From the command to the wanted pressure.
    vent_time : float [s]
        From the command at the wanted pressure to 5 % of it.
    bandwidth : float [Hz]
        Frequency at which a wanted sine between zero and the wanted pressure arrives with 1/√2 of its amplitude
        (−3 dB). The valve opens in proportion to the missing pressure behind it, without delay.
    frequency : float [Hz]
        That of a slower sine, a third of the bandwidth.
    lag : float [Pa]
        Largest difference of this wanted pressure and that in the chamber.
    delay : float [s]
        How much later this sine arrives.
    volume : float [m³]
        Fluid that a cycle of filling and venting takes, at 100 kPa and 20 °C.
    flow : float [m³/s]
        The same per time of a cycle without pause.
    energy : float [J]
        Least work to compress this fluid from the air around to the supply, at constant temperature.
    stored : float [J]
        Work on the walls until the wanted pressure.
    wider : tuple of Wider
        Each part that has a cross-section.
    """

    pressure: float
    fill_time: float
    vent_time: float
    bandwidth: float
    frequency: float
    lag: float
    delay: float
    volume: float
    flow: float
    energy: float
    stored: float
    wider: tuple[Wider, ...]

    def __repr__(self) -> str:
        return (
            f"Performance({self.pressure / 1e3:.4g} kPa: fills in {self.fill_time:.3g} s, vents in "
            f"{self.vent_time:.3g} s, bandwidth {self.bandwidth:.3g} Hz; '{self.limiting.part}' limits)"
        )

    @property
    def limiting(self) -> Wider:
        """The part whose widening shortens a cycle most."""
        return min(self.wider, key=lambda each: each.fill_time + each.vent_time)

    @property
    def text(self) -> str:
        """All of it in lines."""
        lines = [
            f"wanted pressure       {self.pressure / 1e3:.4g} kPa",
            f"fill time             {self.fill_time:.4g} s",
            f"vent time, to 5 %     {self.vent_time:.4g} s",
            f"bandwidth (-3 dB)     {self.bandwidth:.4g} Hz",
            f"lag at {self.frequency:<10.3g} Hz  {self.lag / 1e3:.4g} kPa, {self.delay * 1e3:.3g} ms",
            f"fluid per cycle       {self.volume * 1e6:.4g} mL at 100 kPa and 20 °C",
            f"mean flow             {self.flow * 6e4:.4g} L/min",
            f"energy per cycle      {self.energy * 1e3:.4g} mJ, of which {self.stored * 1e3:.3g} mJ reach the walls",
        ]
        for each in self.wider:
            lines.append(
                f"'{each.part}' twice as wide: fills in {each.fill_time:.4g} s, vents in {each.vent_time:.4g} s"
            )
        return "\n".join([*lines, f"'{self.limiting.part}' limits the actuator."])


def performance(
    network: Network, pressure: float, *, chamber: str = ACTUATOR, valve: str = VALVE, delays: bool = True
) -> Performance:
    """Find how fast an actuator fills, vents and follows, what a cycle takes, and which part limits it.

    Parameters
    ----------
    network : Network
        With a 3/3 valve, whose command does not matter: `driven` makes one.
    pressure : float [Pa], gauge
        Wanted pressure in the chamber.
    chamber, valve : str
        Names of the chamber and of the valve.
    delays : bool
        Whether the delays of the valve count.

    Returns
    -------
    Performance

    Raises
    ------
    TurgorError
        If chamber or valve is unknown, or the wanted pressure is never reached.

    Examples
    --------
    >>> from turgor.systems.air.driven import driven
    >>> from turgor.systems.air.parts.passages import Restriction, Tubing
    >>> network = driven(18e-6, 200e3, Restriction(conductance=1e-8), Tubing(diameter=1e-3, length=1.0))
    >>> performance(network, 50e3).limiting.part
    'tube'
    """
    if chamber not in network.nodes or not isinstance(network.nodes[chamber], Chamber):
        raise unknown("chamber", chamber, (name for name, each in network.nodes.items() if isinstance(each, Chamber)))
    given = network.parts.get(valve)
    if not isinstance(given, ThreeWayValve):
        raise unknown("3/3 valve", valve, (n for n, each in network.parts.items() if isinstance(each, ThreeWayValve)))
    if not pressure > 0:
        raise TurgorError(f"pressure is {pressure / 1e3:g} kPa; a wanted gauge pressure of more than 0 is needed.")
    if not delays:
        network = network.with_part(valve, replace(given, on_delay=0.0, off_delay=0.0))
    case = _Case(network, chamber, valve, pressure)
    fill, vent = case.cycle()
    bandwidth = case.bandwidth(0.3 / (fill + vent))
    slow = bandwidth * PERFORMANCE.slow
    lag, delay = case.lag(slow)
    volume, energy = case.taken(fill)
    return Performance(
        pressure=pressure, fill_time=fill, vent_time=vent, bandwidth=bandwidth, frequency=slow, lag=lag, delay=delay,
        volume=volume, flow=volume / (fill + vent), energy=energy, stored=case.stored(fill), wider=case.wider(),
    )  # fmt: skip


@dataclass(frozen=True, slots=True)
class _Case:
    """A chamber that is filled and vented through a valve."""

    network: Network
    chamber: str
    valve: str
    pressure: float

    def _commanded(self, command: AnySignal) -> Network:
        valve = self.network.parts[self.valve]
        assert isinstance(valve, ThreeWayValve)
        return self.network.with_part(self.valve, replace(valve, command=command))

    def _until(self, command: Signal, level: float, rising: bool, begin: float = 0.0) -> float:
        """Time at which the pressure in the chamber passes a level."""
        equations = Equations(self._commanded(command), begin + PERFORMANCE.longest)
        node, ambient = equations.names.index(self.chamber), self.network.ambient
        sign = 1.0 if rising else -1.0

        def event(time: float, y: np.ndarray) -> float:
            if time <= begin:
                return -1.0
            return sign * (equations.ports(time, y.tolist())[node][0] - ambient - level)

        end = integrate(equations, np.zeros(0), PERFORMANCE.event_tolerance, event=event)[2]
        if end >= begin + PERFORMANCE.longest:
            raise NotSolved(
                f"'{self.chamber}' does not {'reach' if rising else 'fall to'} {level / 1e3:.4g} kPa within "
                f"{PERFORMANCE.longest:g} s; the supply or the exhaust does not suffice."
            )
        return end

    def cycle(self) -> tuple[float, float]:
        """Times to fill and to vent."""
        fill = self._until(Signal((0.0,), (1.0,)), self.pressure, rising=True)
        command = Signal((0.0, fill), (1.0, -1.0))
        return fill, self._until(command, PERFORMANCE.empty * self.pressure, False, fill) - fill

    def _run(self, network: Network, until: float, samples: int) -> History:
        equations, times = Equations(network, until), np.linspace(0.0, until, samples + 1)
        unknowns, evaluations, _ = integrate(equations, times, PERFORMANCE.tolerance)
        return History(equations=equations, time=times, unknowns=unknowns, evaluations=evaluations)

    def _followed(self, frequency: float) -> History:
        """The third period of a wanted sine between zero and the pressure."""
        valve = self.network.parts[self.valve]
        assert isinstance(valve, ThreeWayValve)
        sine = Sine(self.pressure / 2, self.pressure / 2, frequency)
        regulator = Regulator(
            valve.start, valve.end, valve.passage, sine, PERFORMANCE.band * self.pressure, valve.exhaust, 0.0
        )
        run = self._run(self.network.with_part(self.valve, regulator), 3 / frequency, 3 * PERFORMANCE.samples)
        last = slice(2 * PERFORMANCE.samples, -1)
        return replace(run, time=run.time[last], unknowns=run.unknowns[last])

    def _wave(self, frequency: float) -> complex:
        """Amplitude and phase of the first harmonic in the chamber, over those of the wanted sine."""
        run = self._followed(frequency)
        turned = np.exp(-2j * pi * frequency * run.time)
        return complex((run.pressure(self.chamber) * turned).mean() * 2j / (self.pressure / 2))

    def bandwidth(self, guess: float) -> float:
        """Frequency at which the amplitude is 1/√2, by bisection of its logarithm."""
        low = high = log10(guess)
        while abs(self._wave(10**low)) < 0.5**0.5:
            low -= 0.5
        while abs(self._wave(10**high)) > 0.5**0.5:
            high += 0.5
        while high - low > PERFORMANCE.octave:
            middle = (low + high) / 2
            low, high = (middle, high) if abs(self._wave(10**middle)) > 0.5**0.5 else (low, middle)
        return float(10 ** ((low + high) / 2))

    def lag(self, frequency: float) -> tuple[float, float]:
        """Largest difference to a wanted sine, and its delay."""
        run = self._followed(frequency)
        wanted = self.pressure / 2 * (1 + np.sin(2 * pi * frequency * run.time))
        delay = -np.angle(self._wave(frequency)) / (2 * pi * frequency)
        return float(np.abs(wanted - run.pressure(self.chamber)).max()), float(delay)

    def taken(self, fill: float) -> tuple[float, float]:
        """Volume at the reference state and least work of the fluid that flows in while it fills."""
        run = self._run(self._commanded(Signal((0.0,), (1.0,))), fill, PERFORMANCE.fine)
        valve = self.network.parts[self.valve]
        flow, source = run.flow(f"{self.valve}_fill"), run.pressure(valve.start)
        fluid, ambient = self.network.fluid, self.network.ambient
        if isinstance(fluid, Gas):
            work = fluid.gas_constant * self.network.temperature * np.log((source + ambient) / ambient)
        else:
            work = source / fluid.reference_density
        mass = float(np.trapezoid(flow, run.time))
        return mass / fluid.reference_density, float(np.trapezoid(flow * work, run.time))

    def stored(self, fill: float) -> float:
        """Work of the gauge pressure on the walls."""
        run = self._run(self._commanded(Signal((0.0,), (1.0,))), fill, PERFORMANCE.fine)
        return float(np.trapezoid(run.pressure(self.chamber), run.volume(self.chamber)))

    def wider(self) -> tuple[Wider, ...]:
        """Times with each part twice as wide."""
        results = []
        for name, part in self.network.parts.items():
            wide = part.widened(2.0)
            if wide is not None:
                fill, vent = replace(self, network=self.network.with_part(name, wide)).cycle()
                results.append(Wider(part=name, fill_time=fill, vent_time=vent))
        return tuple(results)
