"""Part: the interface of everything that lies between two nodes."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar, TypeAlias

from turgor.systems.air.fluids import Fluid

if TYPE_CHECKING:
    from turgor.systems.air.nodes import Node

#: Absolute pressure [Pa] and temperature [K] of a node.
Port: TypeAlias = tuple[float, float]

#: Mass flow [kg/s] from start to end, of the time, the part's own states, and both ports.
PartFlow: TypeAlias = Callable[[float, Sequence[float], Port, Port], float]

#: Rates of the part's own states.
PartRates: TypeAlias = Callable[[float, Sequence[float], Port, Port], Sequence[float]]


@dataclass(frozen=True, slots=True, kw_only=True)
class Around:
    """What a part has to know of its network.

    Parameters
    ----------
    fluid : Fluid
    ambient : float [Pa], absolute
    temperature : float [K]
    until : float [s]
        End of the run.
    """

    fluid: Fluid
    ambient: float
    temperature: float
    until: float


@dataclass(frozen=True, slots=True)
class Part:
    """Something between two nodes. A new one is one class with `flow`; all else has a default.

    Parameters
    ----------
    start, end : str
        Names of nodes; flow from start to end is positive.
    """

    #: Its ``type`` in files; empty for parts of parts.
    kind: ClassVar[str] = ""

    start: str
    end: str

    @property
    def ends(self) -> tuple[str, ...]:
        """Names of all nodes that it touches."""
        return (self.start, self.end)

    @property
    def volume(self) -> float:
        """Volume of the fluid in it [m³]; half of it belongs to each end."""
        return 0.0

    @property
    def open_ever(self) -> bool:
        """Whether fluid may ever flow."""
        return True

    def flow(self, around: Around) -> PartFlow:
        """Return the mass flow."""
        raise NotImplementedError

    def rates(self, around: Around) -> PartRates | None:
        """Return the rates of its own states; None where it has none."""
        return None

    def first(self, around: Around) -> tuple[float, ...]:
        """Its own states at the start."""
        return ()

    def scales(self, around: Around) -> tuple[float, ...]:
        """Sizes of its own states, for their errors."""
        return tuple(1.0 for _ in self.first(around))

    def breaks(self, until: float) -> Sequence[float]:
        """Times at which its flow jumps or bends."""
        return ()

    def parts(self, name: str) -> "Mapping[str, Part]":
        """Simple parts of which it consists, by name."""
        return {name: self}

    def nodes(self, name: str) -> "Mapping[str, Node]":
        """Nodes within it, by name."""
        return {}

    def widened(self, factor: float) -> "Part | None":
        """Return it with a cross-section larger by a factor; None where it has none."""
        return None
