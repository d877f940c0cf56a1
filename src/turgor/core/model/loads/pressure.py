"""Pressure: gauge pressure on faces, and the pressures among loads."""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING

from turgor.core.model.history import CONSTANT, RAMP, History, checked
from turgor.core.model.history_text import shares_text
from turgor.core.model.loads.load import Deck, DeckRows, Load
from turgor.foundation.given import Quantity, number
from turgor.foundation.given import name as name_of
from turgor.units import MPa, kPa


@dataclass(frozen=True, slots=True)
class Pressure(Load):
    """Gauge pressure on a face: a follower load on the current surface, normal to it.

    Parameters
    ----------
    face : str
        Name of the face, usually ``"cavity"``, or ``"cavity_1"`` where there are several.
    pressure : float [Pa], gauge
        The whole pressure; positive pushes against the solid.
    history : sequence of (float, float), or str, optional
        Points (load factor, share of the pressure that acts then), straight lines between them. The load factor
        rises from 0 to 1; the share lies within -1 to 1 and may fall again. Where it is not 0 at first, the load is
        there from the start, in equilibrium with the body; ``"constant"`` is 1 all along. By default the pressure grows
        in proportion to the load factor. `solve` makes a state at every point. An expression of the load factor ``s``
        such as ``"sin(pi * s)"`` says the same without points; `over_time` turns times into load factors.

    Raises
    ------
    TurgorError
        If the history is no such sequence.

    Examples
    --------
    >>> first = Pressure("cavity_1", 20e3, history=[(0, 0), (0.5, 1), (1, 0.5)])
    >>> first.at(0.25), first.at(0.5), first.at(1.0)
    (10000.0, 20000.0, 10000.0)
    """

    face: str
    pressure: float
    history: History = RAMP

    if TYPE_CHECKING:

        def __init__(self, face: str, pressure: Quantity, history: History = RAMP) -> None: ...

    def __post_init__(self) -> None:
        subject = f"pressure on '{name_of(self.face, 'face of a pressure', 'cavity')}'"
        object.__setattr__(self, "pressure", number(self.pressure, subject, "pressure"))
        object.__setattr__(self, "history", checked(self.history, subject, starting=True))

    def at(self, load_factor: float) -> float:
        """Return the pressure at a load factor [Pa]."""
        return self.share(load_factor) * self.pressure

    @property
    def label(self) -> str:
        """The face and the whole pressure."""
        return f"Pressure({self.face}, {self.pressure / kPa:.4g} kPa)"

    @property
    def outside(self) -> bool:
        """Not an outside load: the fluid drives the actuator."""
        return False

    def text(self) -> str:
        """Return the sentence of a report: the pressure at load factor 1, and how it gets there."""
        return f"Gauge pressure {self.at(1.0) / kPa:g} kPa on {self.face}, following the surface{self._way()}."

    def _way(self) -> str:
        """How it gets to its last value, unless it just grows."""
        if self.history in (RAMP, CONSTANT):
            return shares_text(self.history)
        if isinstance(self.history, str):
            return f", of {self.pressure / kPa:g} kPa times {self.history}"
        return ", after " + ", ".join(
            f"{self.at(factor) / kPa:g} kPa at load factor {factor:g}" for factor, _ in self.history[:-1]
        )

    def deck_rows(self, deck: Deck) -> tuple[DeckRows, ...]:
        """Return the row of a pressure on a surface."""
        row = f"{deck.name(self.face)}, P, {self.pressure / MPa:.12g}"
        return (DeckRows("*DSLOAD", self.history, (row,)),)


def pressures_among(loads: Iterable[Load]) -> tuple[Pressure, ...]:
    """Return the follower pressures among loads.

    Parameters
    ----------
    loads : iterable of Load

    Returns
    -------
    tuple of Pressure
    """
    return tuple(load for load in loads if isinstance(load, Pressure))
