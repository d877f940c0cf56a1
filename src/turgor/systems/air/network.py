"""Network: nodes that store fluid, and parts between them."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from math import inf

from turgor.foundation.errors import TurgorError, unknown
from turgor.systems.air.fluids import AIR, REFERENCE_TEMPERATURE, STANDARD_ATMOSPHERE, Fluid
from turgor.systems.air.nodes import Chamber, Node, Supply
from turgor.systems.air.parts.part import Around, Part
from turgor.systems.air.signals import values_in
from turgor.systems.air.volumes.coupled import CoupledChamber
from turgor.systems.air.volumes.moving import MovingChamber
from turgor.systems.air.volumes.rigid import Rigid

#: Name of the air around, or the tank at its pressure: a node of every network.
AMBIENT = "ambient"


@dataclass(frozen=True, slots=True, kw_only=True)
class Network:
    """Supplies, chambers and what lies between them.

    Parameters
    ----------
    nodes : mapping of str to Supply or Chamber
        By name; ``"ambient"`` is there always, at gauge pressure 0.
    parts : mapping of str to Part
        By name.
    fluid : Gas or Liquid
    ambient : float [Pa], absolute
        Pressure around; gauge pressures count from it.
    temperature : float [K]
        Around, and at the start.

    Raises
    ------
    TurgorError
        If a part names an unknown node, a junction has no volume, a supply is shut off for ever, or a pressure lies
        below vacuum: the sentence names node or part.

    Examples
    --------
    >>> from turgor.systems.air.parts.connection import Connection
    >>> from turgor.systems.air.parts.passages import Restriction
    >>> Network(
    ...     nodes={"supply": Supply(400e3), "tank": Chamber(18e-6)},
    ...     parts={"valve": Connection("supply", "tank", Restriction(conductance=1e-9))},
    ... )
    Network(supply, tank, ambient; valve; air)
    """

    nodes: Mapping[str, Node]
    parts: Mapping[str, Part]
    fluid: Fluid = AIR
    ambient: float = field(default=STANDARD_ATMOSPHERE, metadata={"dimension": "pressure"})
    temperature: float = REFERENCE_TEMPERATURE

    def __post_init__(self) -> None:
        if not 0 < self.ambient < inf:
            raise TurgorError(f"ambient is {self.ambient:g} Pa; a positive absolute pressure is needed.")
        if not 0 < self.temperature < inf:
            raise TurgorError(f"temperature is {self.temperature:g} K; a positive number is needed.")
        if not any(isinstance(node, Chamber) for node in self.nodes.values()):
            raise TurgorError("the network has no chamber; one node at least must store fluid.")
        self._check_parts()
        self._check_fluid()
        self._check_pressures()
        self._check_volumes()
        self._check_supplies()

    def __repr__(self) -> str:
        return f"Network({', '.join(self.all_nodes)}; {', '.join(self.parts)}; {self.fluid.name})"

    @property
    def all_nodes(self) -> dict[str, Node]:
        """The nodes, with the air around and those within parts."""
        nodes = dict(self.nodes)
        nodes.setdefault(AMBIENT, Supply(0.0))
        for name, part in self.parts.items():
            nodes |= part.nodes(name)
        return nodes

    @property
    def simple_parts(self) -> dict[str, Part]:
        """The parts of which the parts consist."""
        return {key: each for name, part in self.parts.items() for key, each in part.parts(name).items()}

    def dead_volumes(self) -> dict[str, float]:
        """Volume of tubes at each node [m³]: half of each tube that ends there."""
        dead = dict.fromkeys(self.all_nodes, 0.0)
        for part in self.simple_parts.values():
            for end in part.ends:
                dead[end] += part.volume / len(part.ends)
        return dead

    def around(self, until: float) -> Around:
        """Return what a part has to know."""
        return Around(fluid=self.fluid, ambient=self.ambient, temperature=self.temperature, until=until)

    def with_part(self, name: str, part: Part) -> "Network":
        """Return the network with another part of a name."""
        if name not in self.parts:
            raise unknown("part", name, self.parts)
        return replace(self, parts={**self.parts, name: part})

    def with_node(self, name: str, node: Node) -> "Network":
        """Return the network with another node of a name."""
        if name not in self.all_nodes:
            raise unknown("node", name, self.all_nodes)
        return replace(self, nodes={**self.nodes, name: node})

    def _check_parts(self) -> None:
        known = self.all_nodes
        for name, part in self.parts.items():
            for end in part.ends:
                if end not in known:
                    raise unknown(f"node of part '{name}':", end, known)
            if part.start == part.end:
                raise TurgorError(f"part '{name}' begins and ends at '{part.start}'; two nodes are needed.")
            if name in known:
                raise TurgorError(f"'{name}' is the name of a node and of a part; rename one of them.")

    def _check_fluid(self) -> None:
        for name, part in self.parts.items():
            for each in part.parts(name).values():
                try:
                    each.flow(self.around(1e-9))
                except TurgorError as error:
                    raise TurgorError(f"part '{name}': {error}") from None

    def _check_pressures(self) -> None:
        for name, node in self.nodes.items():
            values = values_in(node.pressure) if isinstance(node, Supply) else (getattr(node, "pressure", 0.0),)
            for value in values:
                if not -self.ambient < value < inf:
                    raise TurgorError(
                        f"pressure of node '{name}' is {value / 1e3:g} kPa; gauge pressures lie above vacuum, "
                        f"{-self.ambient / 1e3:g} kPa."
                    )

    def _check_volumes(self) -> None:
        dead = self.dead_volumes()
        for name, node in self.all_nodes.items():
            if isinstance(node, Chamber) and node.volume is None and not dead[name]:
                ends = [key for key, part in self.parts.items() if name in part.ends]
                raise TurgorError(
                    f"node '{name}' has no volume, so that its pressure would jump; give it one, or connect a tube "
                    f"({'its parts are ' + ', '.join(ends) if ends else 'no part ends there'})."
                )
        self._check_coupled()

    def _check_coupled(self) -> None:
        groups: dict[int, list[tuple[int, int]]] = {}
        for node in self.nodes.values():
            if isinstance(node, Chamber) and isinstance(node.volume, CoupledChamber):
                groups.setdefault(id(node.volume.table), []).append((node.volume.number, len(node.volume.table.low)))
            if isinstance(node, Chamber) and isinstance(node.volume, MovingChamber):
                actuator = node.volume.actuator
                groups.setdefault(id(actuator), []).append((node.volume.number, len(actuator.reduced.inputs.keys)))
        for group in groups.values():
            numbers, count = sorted(number for number, _ in group), group[0][1]
            if numbers != list(range(count)):
                raise TurgorError(
                    f"an actuator of {count} coupled chambers needs each of them once; the nodes have the chambers "
                    f"{numbers}."
                )

    def _check_supplies(self) -> None:
        parts = self.simple_parts.values()
        for name, node in self.nodes.items():
            ends = [part for part in parts if name in part.ends]
            if isinstance(node, Supply) and not any(part.open_ever for part in ends):
                why = "no part ends there" if not ends else "no command opens a valve there"
                raise TurgorError(f"supply '{name}' is closed for ever: {why}.")
        for name, node in self.nodes.items():
            if not isinstance(node, Chamber) or any(name in part.ends for part in parts):
                continue
            moved = isinstance(node.volume, Rigid) and not isinstance(node.volume.volume, float)
            if not moved:
                raise TurgorError(f"no part ends at node '{name}', so that nothing happens there.")
