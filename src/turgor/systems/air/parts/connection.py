"""Connections: passages that are always open, or open by what an opening says."""

from dataclasses import dataclass, field, replace
from typing import ClassVar

from turgor.foundation.errors import TurgorError
from turgor.systems.air.parts.part import Around, Part, PartFlow
from turgor.systems.air.parts.passages import Leakage, Passage


@dataclass(frozen=True, slots=True)
class Connection(Part):
    """A passage between two nodes: a restriction, an orifice or a tube.

    Parameters
    ----------
    start, end : str
        A node; flow from start to end is positive.
    passage : Restriction, Orifice, tg.air.Tubing or Leakage

    Examples
    --------
    >>> from turgor.systems.air.parts.passages import Tubing
    >>> Connection("valve", "finger", Tubing(diameter=2e-3, length=1.0)).ends
    ('valve', 'finger')
    """

    kind: ClassVar[str] = ""

    passage: Passage

    @property
    def volume(self) -> float:
        """That of the passage [m³]."""
        return self.passage.volume

    def flow(self, around: Around) -> PartFlow:
        """Return the flow through the passage, whose law holds in both directions."""
        law = self.passage.law(around.fluid)

        def flow(time: float, own: object, a: tuple[float, float], b: tuple[float, float]) -> float:
            return law(a[0], b[0], a[1]) if a[0] >= b[0] else -law(b[0], a[0], b[1])

        return flow

    def widened(self, factor: float) -> "Connection | None":
        """Return it with a wider passage; a leak is left as it is."""
        return None if isinstance(self.passage, Leakage) else replace(self, passage=self.passage.widened(factor))


def leak(start: str, flow: float, pressure: float, end: str = "ambient") -> Connection:
    """Return a leak as it is measured: the flow out of a node at a gauge pressure.

    Parameters
    ----------
    start : str
        The node that leaks.
    flow : float [m³/s]
        Of a gas at 100 kPa and 20 °C.
    pressure : float [Pa], gauge
    end : str
        Where to; the air around by default.

    Examples
    --------
    >>> leak("finger", 1e-6 / 60, 50e3).end
    'ambient'
    """
    return Connection(start, end, Leakage(flow=flow, pressure=pressure))


@dataclass(frozen=True, slots=True)
class CheckValve(Connection):
    """A check valve: it opens in proportion between two pressure differences, and nothing flows back.

    Parameters
    ----------
    start, end : str
        Flow from start to end only.
    passage : Restriction, Orifice or tg.air.Tubing
        What it is when it is open.
    cracking : float [Pa]
        Difference of pressures at which it begins to open.
    full : float [Pa]
        Difference at which it is open; more than ``cracking``.
    """

    kind: ClassVar[str] = "check_valve"

    cracking: float = field(default=1e3, metadata={"dimension": "pressure"})
    full: float = field(default=3e3, metadata={"dimension": "pressure"})

    def __post_init__(self) -> None:
        if not 0 <= self.cracking < self.full:
            raise TurgorError(
                f"cracking of a check valve is {self.cracking:g} Pa and full is {self.full:g} Pa; 0 ≤ cracking < full "
                "is needed."
            )

    def flow(self, around: Around) -> PartFlow:
        """Return the flow in its direction."""
        law = self.passage.law(around.fluid)

        def flow(time: float, own: object, a: tuple[float, float], b: tuple[float, float]) -> float:
            opening = (a[0] - b[0] - self.cracking) / (self.full - self.cracking)
            return min(opening, 1.0) * law(a[0], b[0], a[1]) if opening > 0 else 0.0

        return flow
