"""Shrinkage: a body would be smaller than it is meshed, as rubber after its cure."""

from dataclasses import dataclass, field
from math import log1p
from typing import TYPE_CHECKING

from turgor.core.model.history import RAMP, History, checked
from turgor.core.model.history_text import shares_text
from turgor.core.model.loads.load import Load
from turgor.foundation.errors import TurgorError
from turgor.foundation.given import Quantity, number
from turgor.foundation.given import name as name_of


@dataclass(frozen=True, slots=True)
class Shrinkage(Load):
    """Linear shrinkage of a body, the same in all directions, as after the cure of a cast rubber.

    Alone, the body just becomes smaller; bonded to one that does not shrink, it is stretched and bends both.

    Parameters
    ----------
    body : str
        Body that shrinks.
    linear : float
        Share of its length that it loses where it is free: 0.003, or ``"0.3 %"``; at least -1 (it grows) and below 0.9.
    history : sequence of (float, float), or str, optional
        As that of a `Pressure`.

    Examples
    --------
    >>> Shrinkage("body", "0.3 %").text()
    'Body body shrinks by 0.3 % in length where it is free.'
    """

    body: str
    linear: float = field(metadata={"dimension": "share"})
    history: History = RAMP

    job_key = "shrinkage"
    of_bodies = True

    if TYPE_CHECKING:

        def __init__(self, body: str, linear: Quantity, history: History = RAMP) -> None: ...

    def __post_init__(self) -> None:
        subject = f"shrinkage of '{name_of(self.body, 'body that shrinks', 'body')}'"
        object.__setattr__(self, "linear", number(self.linear, f"{subject}: linear", "share"))
        object.__setattr__(self, "history", checked(self.history, subject, starting=True))
        if not -1 <= self.linear < 0.9:
            raise TurgorError(f"{subject}: linear is {self.linear * 100:g} %; allowed is -100 % to below 90 %.")

    def text(self) -> str:
        """Return the sentence of a report."""
        way = "shrinks" if self.linear >= 0 else "grows"
        size = f"{abs(self.linear) * 100:g} % in length"
        return f"Body {self.body} {way} by {size} where it is free{shares_text(self.history)}."

    @property
    def growth(self) -> float:
        """Minus the shrinkage."""
        return -self.linear

    def log_length(self, load_factor: float) -> float:
        """Return the same in all directions."""
        return self.share(load_factor) * log1p(-self.linear)
