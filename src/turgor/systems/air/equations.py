"""Equations: rates of masses, energies and states of parts of a network."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from turgor.foundation.errors import TurgorError
from turgor.systems.air.fluids import Gas
from turgor.systems.air.network import Network
from turgor.systems.air.nodes import Chamber, Supply
from turgor.systems.air.parts.part import PartFlow, PartRates, Port
from turgor.systems.air.stores import CoupledStore, EnergyStore, FixedStore, Store, check_rising, store_of
from turgor.systems.air.volumes.coupled import Coupled, CoupledChamber
from turgor.systems.air.volumes.moving import MovingChamber

Array = NDArray[np.float64]

#: Step of differences, over the size of an unknown: the root of the round-off.
STEP = 1.5e-8


@dataclass(frozen=True, slots=True)
class _Placed:
    """A store with the first of its unknowns and the numbers of its nodes."""

    store: Store
    first: int
    last: int
    nodes: tuple[int, ...]


@dataclass(frozen=True, slots=True)
class _Running:
    """A part of a run: its law, the numbers of its ends, and its own unknowns."""

    flow: PartFlow
    rates: PartRates | None
    start: int
    end: int
    own: slice


class Equations:
    """Ordinary differential equations of a network.

    Unknowns are, by store, the mass that each node has received since the start and, of adiabatic ones, the energy;
    then the states of parts. What one node loses, another receives: the sum of all masses does not change.

    Parameters
    ----------
    network : Network
    until : float [s]
        End of the run.
    """

    def __init__(self, network: Network, until: float) -> None:
        self.network, self.around = network, network.around(until)
        self.names = tuple(network.all_nodes)
        self.part_names = tuple(network.simple_parts)
        self._stores: list[_Placed] = []
        self.mass_place: dict[int, int] = {}
        self.energy_place: dict[int, int] = {}
        self._energies: dict[int, EnergyStore] = {}
        self.size = 0
        self._add_stores()
        self._parts = self._running()
        self.breaks = self._breaks(until)

    def _add_stores(self) -> None:
        dead, numbers = self.network.dead_volumes(), {name: n for n, name in enumerate(self.names)}
        groups: dict[int, tuple[Coupled, dict[int, str]]] = {}
        for name, node in self.network.all_nodes.items():
            if isinstance(node, Chamber) and isinstance(node.volume, MovingChamber):
                raise TurgorError(
                    f"chamber '{name}' is in motion, which `simulate` alone follows; take a `VolumeCurve`."
                )
            if isinstance(node, Chamber) and isinstance(node.volume, CoupledChamber):
                table = node.volume.table
                groups.setdefault(id(table), (table, {}))[1][node.volume.number] = name
            elif isinstance(node, Chamber):
                inner, own = (node.with_rigid(dead[name]), 0.0) if node.volume is None else (node, dead[name])
                check_rising(inner, name, own, self.around)
                self._add(store_of(inner, own, self.around), (numbers[name],))
            else:
                assert isinstance(node, Supply)
                self._add(FixedStore(node, self.around), (numbers[name],))
        for table, members in groups.values():
            names = [members[n] for n in range(len(members))]
            chambers = [self.network.nodes[name] for name in names]
            volumes = [dead[name] for name in names]
            store = CoupledStore(table, chambers, volumes, self.around)  # type: ignore[arg-type]
            self._add(store, tuple(numbers[name] for name in names))

    def _add(self, store: Store, nodes: tuple[int, ...]) -> None:
        self._stores.append(_Placed(store, self.size, self.size + store.size, nodes))
        for k, node in enumerate(nodes):
            self.mass_place[node] = self.size + k
        if isinstance(store, EnergyStore):
            self.energy_place[nodes[0]] = self.size + 1
            self._energies[nodes[0]] = store
        self.size += store.size

    def _running(self) -> list[_Running]:
        numbers, parts, self._first = {name: n for n, name in enumerate(self.names)}, [], list[float]()
        offset = self.size
        for part in self.network.simple_parts.values():
            first = part.first(self.around)
            own = slice(offset + len(self._first), offset + len(self._first) + len(first))
            self._first += first
            ends = numbers[part.start], numbers[part.end]
            parts.append(_Running(part.flow(self.around), part.rates(self.around), *ends, own))
        self.size += len(self._first)
        return parts

    def _breaks(self, until: float) -> list[float]:
        every = [*self.network.all_nodes.values(), *self.network.simple_parts.values()]
        return sorted({time for each in every for time in each.breaks(until) if 0 < time < until})

    @property
    def first(self) -> Array:
        """Unknowns at the start."""
        return np.array([0.0] * (self.size - len(self._first)) + self._first)

    @cached_property
    def scales(self) -> Array:
        """Sizes of the unknowns, for their errors."""
        scales = [scale for each in self._stores for scale in each.store.scales]
        largest = max(scales)
        scales = [scale or largest for scale in scales]
        for part in self.network.simple_parts.values():
            scales += part.scales(self.around)
        return np.array(scales)

    def ports(self, time: float, y: Sequence[float]) -> list[Port]:
        """Absolute pressure and temperature of every node."""
        ports: list[Port] = [(0.0, 0.0)] * len(self.names)
        for each in self._stores:
            its = each.store.ports(time, y[each.first : each.last])
            if len(its) == 1:
                ports[each.nodes[0]] = its[0]
                continue
            for node, port in zip(each.nodes, its, strict=True):
                ports[node] = port
        return ports

    def flows(self, time: float, y: Sequence[float], ports: Sequence[Port] | None = None) -> list[float]:
        """Mass flow [kg/s] of every simple part."""
        ports = self.ports(time, y) if ports is None else ports
        return [part.flow(time, y[part.own], ports[part.start], ports[part.end]) for part in self._parts]

    def rates(self, time: float, unknowns: Array) -> list[float]:
        """Rates of the unknowns."""
        y = unknowns.tolist()
        return self._rates(time, y, self.ports(time, y), self._parts, self.energy_place)

    def _rates(
        self, time: float, y: list[float], ports: list[Port], parts: Sequence[_Running], heated: Iterable[int]
    ) -> list[float]:
        """Share of some parts, and of the heat of some nodes, in the rates."""
        rates = [0.0] * self.size
        for part in parts:
            a, b = ports[part.start], ports[part.end]
            own = y[part.own]
            flow = part.flow(time, own, a, b)
            rates[self.mass_place[part.start]] -= flow
            rates[self.mass_place[part.end]] += flow
            if self.energy_place:
                self._carry(rates, part, flow * (a if flow > 0 else b)[1])
            if part.rates is not None:
                rates[part.own] = part.rates(time, own, a, b)
        for node in heated:
            rates[self.energy_place[node]] += self._energies[node].heating(time, ports[node])
        return rates

    def jacobian(self, time: float, unknowns: Array) -> Array:
        """Derivatives (n, n) of the rates by the unknowns: differences, of what an unknown touches only."""
        y = unknowns.tolist()
        ports, result = self.ports(time, y), np.zeros((self.size, self.size))
        steps = (STEP * np.maximum(np.abs(unknowns), self.scales)).tolist()
        for each in self._stores:
            if isinstance(each.store, FixedStore):
                continue  # its pressure is prescribed
            parts = [part for part in self._parts if part.start in each.nodes or part.end in each.nodes]
            heated = [node for node in each.nodes if node in self.energy_place]
            first = np.array(self._rates(time, y, ports, parts, heated))
            for k in range(each.first, each.last):
                moved, there = y.copy(), ports.copy()
                moved[k] += steps[k]
                its = each.store.ports(time, moved[each.first : each.last])
                for node, port in zip(each.nodes, its, strict=True):
                    there[node] = port
                result[:, k] = (np.array(self._rates(time, moved, there, parts, heated)) - first) / steps[k]
        for part in self._parts:
            for k in range(part.own.start, part.own.stop):
                moved = y.copy()
                moved[k] += steps[k]
                both = [np.array(self._rates(time, state, ports, [part], ())) for state in (y, moved)]
                result[:, k] = (both[1] - both[0]) / steps[k]
        return result

    def _carry(self, rates: list[float], part: _Running, flow_temperature: float) -> None:
        """Add the enthalpy that a flow carries."""
        assert isinstance(self.network.fluid, Gas)
        enthalpy = self.network.fluid.heat_capacity * flow_temperature
        if part.start in self.energy_place:
            rates[self.energy_place[part.start]] -= enthalpy
        if part.end in self.energy_place:
            rates[self.energy_place[part.end]] += enthalpy

    def read(self, values: Callable[[Store, Sequence[float]], Sequence[float]], y: Sequence[float]) -> list[float]:
        """Read a value of every node from the stores."""
        result = [0.0] * len(self.names)
        for each in self._stores:
            its = values(each.store, y[each.first : each.last])
            for node, value in zip(each.nodes, its, strict=True):
                result[node] = value
        return result

    def outside(self, time: float, y: Sequence[float]) -> str:
        """Say which chamber leaves what is known of it; empty where none does."""
        for each in self._stores:
            text = each.store.outside(time, y[each.first : each.last])
            if text:
                names = ", ".join(self.names[node] for node in each.nodes)
                return f"{names} reaches {text}"
        return ""
