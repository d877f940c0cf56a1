"""Stores: pressure and temperature of nodes from the mass, and the energy, of the fluid in them.

The unknowns are what has flowed in since the start. Errors are then relative to it, and liquids keep their digits.
"""

import itertools
from collections.abc import Callable, Sequence
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from turgor.foundation.errors import NotSolved, TurgorError
from turgor.systems.air.fluids import Gas
from turgor.systems.air.nodes import Chamber, Supply
from turgor.systems.air.parts.part import Around, Port
from turgor.systems.air.settings import SOLVER
from turgor.systems.air.signals import signal_of
from turgor.systems.air.volumes.coupled import Coupled, CoupledChamber
from turgor.systems.air.volumes.law import Law
from turgor.systems.air.volumes.moving import MovingChamber
from turgor.systems.air.volumes.rigid import Rigid

#: Density, its derivative by the pressure, and the temperature at an absolute pressure.
Process: TypeAlias = Callable[[float], tuple[float, float, float]]

#: Absolute pressure [Pa] that no state falls below.
VACUUM = 1e-3


def process_of(chamber: Chamber, around: Around) -> Process:
    """Return how density and temperature follow from the pressure."""
    fluid, start = around.fluid, chamber.temperature or around.temperature
    exponent = chamber.process
    if not isinstance(fluid, Gas):
        return lambda p: (fluid.density(p, start), fluid.compression(p, start), start)
    if exponent in ("isothermal", "adiabatic", 1):
        factor = fluid.compression(0.0, start)  # this runs a thousand times: no calls within
        return lambda p: (factor * p, factor, start)
    n = fluid.heat_ratio if isinstance(exponent, str) else exponent
    first = chamber.pressure + around.ambient
    density = fluid.density(first, start)

    def process(p: float) -> tuple[float, float, float]:
        ratio = max(p, VACUUM) / first
        now = density * ratio ** (1 / n)
        return now, now / (n * max(p, VACUUM)), start * ratio ** (1 - 1 / n)

    return process


class FixedStore:
    """A node of prescribed pressure; its unknown is the mass that it has received."""

    size = 1

    def __init__(self, node: Supply, around: Around) -> None:
        self._signal, self._ambient = signal_of(node.pressure), around.ambient
        self._temperature = node.temperature or around.temperature
        self.scales = [0.0]

    def ports(self, time: float, y: Sequence[float]) -> list[Port]:
        """Its prescribed pressure."""
        return [(self._signal.at(time) + self._ambient, self._temperature)]

    def volumes(self, time: float, y: Sequence[float]) -> list[float]:
        """None of its own."""
        return [np.nan]

    def masses(self, y: Sequence[float]) -> list[float]:
        """What it has received."""
        return [y[0]]

    def outside(self, time: float, y: Sequence[float]) -> str:
        """Nothing lies outside."""
        return ""


class MassStore:
    """A chamber whose pressure follows from the mass in it.

    Parameters
    ----------
    chamber : Chamber
    dead : float [m³]
        Volume of tubes that ends here.
    around : Around
    """

    size = 1

    def __init__(self, chamber: Chamber, dead: float, around: Around) -> None:
        law = chamber.law
        assert law is not None and not isinstance(law, CoupledChamber | MovingChamber)  # others deal with those
        self.law: Law = law
        self.dead, self.around = dead, around
        self._process = process_of(chamber, around)
        self._place = self.law.place(chamber.pressure, 0.0)
        self._bounds = self.law.bounds(around.ambient)
        content, slope = self._content(self._place, 0.0)
        self.start = content
        rigid = isinstance(law, Rigid) and isinstance(law.volume, float) and isinstance(around.fluid, Gas)
        isothermal = chamber.process in ("isothermal", "adiabatic", 1)
        self._by_mass = 1.0 / slope if rigid and isothermal else 0.0  # p = m R T/V needs no search
        _p, volume, rise, _ = self.law.at(self._place, 0.0)
        around_density = around.fluid.density(around.ambient, around.temperature)
        whole = around_density * (volume + dead)
        self.scales = [min(whole, abs(slope / rise) * around.ambient) if rise else whole]

    def _content(self, place: float, time: float) -> tuple[float, float]:
        """Mass and its derivative by the coordinate."""
        p, volume, rise, growth = self.law.at(place, time)
        density, compression, _ = self._process(max(p + self.around.ambient, VACUUM))
        volume += self.dead
        return density * volume, compression * rise * volume + density * growth

    def place(self, time: float, y: Sequence[float]) -> float:
        """Coordinate at a mass."""
        if self._by_mass:
            return (self.start + y[0]) * self._by_mass - self.around.ambient
        self._place = solved(lambda place: self._content(place, time), self.start + y[0], self._place, self._bounds)
        return self._place

    def ports(self, time: float, y: Sequence[float]) -> list[Port]:
        """Pressure and temperature."""
        place = self.place(time, y)
        p = max((place if self._by_mass else self.law.at(place, time)[0]) + self.around.ambient, VACUUM)
        return [(p, self._process(p)[2])]

    def volumes(self, time: float, y: Sequence[float]) -> list[float]:
        """Volume without that of tubes [m³]."""
        return [self.law.at(self.place(time, y), time)[1]]

    def masses(self, y: Sequence[float]) -> list[float]:
        """Mass in it [kg]."""
        return [self.start + y[0]]

    def outside(self, time: float, y: Sequence[float]) -> str:
        """Say how its state is not known."""
        place = self.place(time, y)
        if self.law.at(place, time)[0] + self.around.ambient < 10 * VACUUM:
            return "vacuum: the fluid would tear"
        return self.law.outside(place)


class EnergyStore(MassStore):
    """A chamber of gas whose temperature follows from an energy balance.

    Internal energy and the work that the gas has done on the walls, p V/(γ − 1) + ∫p dV, change by what flows in and
    out, by heat, and by a plunger alone.
    """

    size = 2

    def __init__(self, chamber: Chamber, dead: float, around: Around) -> None:
        super().__init__(chamber, dead, around)
        assert isinstance(around.fluid, Gas)
        self.gas, self.heat = around.fluid, chamber.heat
        self.first_energy = self._energy(self._place, 0.0)[0]
        self.scales = [*self.scales, self.first_energy + around.ambient * self.law.at(self._place, 0.0)[1]]

    def _energy(self, place: float, time: float) -> tuple[float, float]:
        p, volume, rise, growth = self.law.at(place, time)
        absolute, g = p + self.around.ambient, self.gas.heat_ratio - 1
        energy = absolute * (volume + self.dead) / g + self.law.work(place, self.around.ambient)
        return energy, rise * (volume + self.dead) / g + absolute * growth * (1 + 1 / g)

    def place(self, time: float, y: Sequence[float]) -> float:
        """Coordinate at an energy."""
        self._place = solved(
            lambda place: self._energy(place, time),
            self.first_energy + y[1], self._place, self._bounds,
        )  # fmt: skip
        return self._place

    def ports(self, time: float, y: Sequence[float]) -> list[Port]:
        """Pressure, and T = p V/(m R)."""
        p, volume, _, _ = self.law.at(self.place(time, y), time)
        absolute = max(p + self.around.ambient, VACUUM)
        mass = max(self.start + y[0], 1e-30)
        return [(absolute, absolute * (volume + self.dead) / (mass * self.gas.gas_constant))]

    def heating(self, time: float, port: Port) -> float:
        """Power of heat and of the plunger [W]."""
        return self.heat * (self.around.temperature - port[1]) - port[0] * self.law.rate(time)


class CoupledStore:
    """Chambers of one actuator, the volume of each of which depends on all pressures.

    Parameters
    ----------
    table : Coupled
    chambers : sequence of Chamber
        In the order of the table.
    dead : sequence of float [m³]
    around : Around
    """

    def __init__(self, table: Coupled, chambers: Sequence[Chamber], dead: Sequence[float], around: Around) -> None:
        self.table, self.dead, self.around = table, np.array(dead), around
        self.size = len(chambers)
        self._processes = [process_of(each, around) for each in chambers]
        self._pressures = np.array([each.pressure for each in chambers])
        self.start, slope = self._content(self._pressures)
        self.scales = (np.diag(slope) * around.ambient).tolist()

    def _content(self, pressures: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        volumes, slopes = self.table.at(pressures)
        absolute = np.maximum(pressures + self.around.ambient, VACUUM)
        states = np.array([process(p) for process, p in zip(self._processes, absolute.tolist(), strict=True)])
        volumes = volumes + self.dead
        return states[:, 0] * volumes, states[:, :1] * slopes + np.diag(states[:, 1] * volumes)

    def pressures(self, y: Sequence[float]) -> NDArray[np.float64]:
        """Gauge pressures at masses, by Newton's method from the last ones."""
        target, p = self.start + np.array(y), self._pressures
        for _ in range(SOLVER.updates):
            content, slope = self._content(p)
            step = np.linalg.solve(slope, target - content)
            p = p + step
            if np.abs(step).max() < SOLVER.settled * self.around.ambient:
                self._pressures = p
                return p
        raise NotSolved("coupled chambers have no pressures at the gas in them; sample their table more densely.")

    def ports(self, time: float, y: Sequence[float]) -> list[Port]:
        """Pressures and temperatures."""
        absolute = np.maximum(self.pressures(y) + self.around.ambient, VACUUM).tolist()
        return [(p, process(p)[2]) for process, p in zip(self._processes, absolute, strict=True)]

    def volumes(self, time: float, y: Sequence[float]) -> list[float]:
        """Volumes without those of tubes [m³]."""
        return [float(each) for each in self.table.at(self.pressures(y))[0]]

    def masses(self, y: Sequence[float]) -> list[float]:
        """Masses in them [kg]."""
        return [float(each) for each in self.start + np.array(y)]

    def outside(self, time: float, y: Sequence[float]) -> str:
        """Say how pressures are not known."""
        return self.table.outside(self.pressures(y))


Store: TypeAlias = FixedStore | MassStore | EnergyStore | CoupledStore


def store_of(chamber: Chamber, dead: float, around: Around) -> MassStore:
    """Return the store of a chamber that is not coupled to others."""
    if chamber.process == "adiabatic" and isinstance(around.fluid, Gas):
        return EnergyStore(chamber, dead, around)
    return MassStore(chamber, dead, around)


def check_rising(chamber: Chamber, name: str, dead: float, around: Around) -> None:
    """Raise an error where a chamber holds less fluid at a larger volume: it would snap."""
    knots = getattr(chamber.law, "knots", None)
    if knots is None:
        return
    process, ambient = process_of(chamber, around), around.ambient
    law: Law = chamber.law  # type: ignore[assignment]
    fine = np.concatenate([np.linspace(a, b, 5)[:-1] for a, b in itertools.pairwise(knots)])
    content = [process(max(law.at(v, 0.0)[0] + ambient, VACUUM))[0] * (v + dead) for v in fine.tolist()]
    falls = np.flatnonzero(np.diff(content) <= 0)
    if len(falls):
        v = fine[falls[0]] * 1e6
        raise TurgorError(
            f"chamber '{name}' would snap at {v:.4g} mL, where the amount of fluid falls while it grows; a network "
            "follows chambers that hold more at a larger volume."
        )


def solved(
    content: Callable[[float], tuple[float, float]], target: float, place: float, bounds: tuple[float, float]
) -> float:
    """Find where a rising function has a value: Newton's method in an interval that shrinks."""
    (low, high), size = bounds, abs(bounds[0])
    for _ in range(SOLVER.updates):
        value, slope = content(place)
        if value < target:
            low = place
        else:
            high = place
        step = (target - value) / slope if slope > 0 else 0.0
        after = place + step
        if abs(step) <= SOLVER.settled * (abs(after) + size) and slope > 0:
            return after
        if not low < after < high or not slope > 0:
            after = (low + high) / 2
            if after in (low, high):
                return after
        place = after
    return place
