"""Long line: a tube in which fluid has inertia and is compressed, as segments in series."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, ClassVar

from turgor.foundation.errors import TurgorError
from turgor.systems.air.fluids import Gas
from turgor.systems.air.nodes import Chamber
from turgor.systems.air.parts.part import Around, Part, PartFlow, PartRates, Port
from turgor.systems.air.parts.passages import Tubing

if TYPE_CHECKING:
    from turgor.systems.air.nodes import Node


@dataclass(frozen=True, slots=True)
class HeavyTube(Part):
    """A tube whose fluid has inertia: L/A dṁ/dt = p₁ − p₂ − friction.

    Parameters
    ----------
    start, end : str
    tube : tg.air.Tubing
    """

    kind: ClassVar[str] = ""

    tube: Tubing

    @property
    def volume(self) -> float:
        """Volume of the bore [m³]."""
        return self.tube.volume

    def first(self, around: Around) -> tuple[float, ...]:
        """At rest."""
        return (0.0,)

    def scales(self, around: Around) -> tuple[float, ...]:
        """Flow at a tenth of the speed of sound of a gas."""
        return (30.0 * self.tube.area * around.fluid.density(around.ambient, around.temperature),)

    def flow(self, around: Around) -> PartFlow:
        """Return its own state."""
        return lambda time, own, a, b: own[0]

    def rates(self, around: Around) -> PartRates:
        """Return how the difference of pressures speeds it up."""
        fluid, tube = around.fluid, self.tube
        factor = tube.area / tube.length

        def rates(time: float, own: Sequence[float], a: Port, b: Port) -> tuple[float]:
            density = fluid.density((a[0] + b[0]) / 2, (a[1] + b[1]) / 2)
            return (factor * (a[0] - b[0] - tube.pressure_loss(fluid, own[0], density)),)

        return rates


@dataclass(frozen=True, slots=True)
class LongLine(Part):
    """A long tube: segments with inertia, friction and compression, so that a signal travels with the speed of sound.

    Parameters
    ----------
    start, end : str
    diameter, length : float [m]
        Of the bore.
    segments : int
        Frequencies up to about c · segments / (6 length) are resolved.
    exponent : float, optional
        Of the gas in it: 1 for constant temperature, γ without exchange of heat, which is the default.
    """

    kind: ClassVar[str] = "long_line"

    diameter: float = field(metadata={"dimension": "length"})
    length: float = field(metadata={"dimension": "length"})
    segments: int = 10
    exponent: float | None = None

    def __post_init__(self) -> None:
        Tubing(diameter=self.diameter, length=self.length)
        if not 1 <= self.segments <= 200:
            raise TurgorError(f"segments of a line is {self.segments}; allowed is 1 to 200.")

    @property
    def _piece(self) -> Tubing:
        return Tubing(diameter=self.diameter, length=self.length / self.segments)

    def parts(self, name: str) -> Mapping[str, Part]:
        """The segments."""
        places = [self.start, *(f"{name}_{n}" for n in range(1, self.segments)), self.end]
        return {
            name if n == 0 else f"{name}_part_{n + 1}": HeavyTube(places[n], places[n + 1], self._piece)
            for n in range(self.segments)
        }

    def nodes(self, name: str) -> "Mapping[str, Node]":
        """Nodes between the segments."""
        return {f"{name}_{n}": Chamber(None, process=self.exponent or "isentropic") for n in range(1, self.segments)}

    def widened(self, factor: float) -> "LongLine":
        """Return it with a larger bore."""
        return LongLine(self.start, self.end, self.diameter * factor**0.5, self.length, self.segments, self.exponent)


def speed_of_sound(gas: Gas, temperature: float, exponent: float | None = None) -> float:
    """Return the speed of sound c = √(n R T) [m/s], with n = γ unless given."""
    return float((gas.heat_ratio if exponent is None else exponent) * gas.gas_constant * temperature) ** 0.5
