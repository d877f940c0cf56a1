"""Swelling: a body takes up liquid and would have a larger volume than it is meshed with."""

from dataclasses import dataclass, field
from math import log
from typing import TYPE_CHECKING

from turgor.core.model.history import RAMP, History, checked
from turgor.core.model.history_text import shares_text
from turgor.core.model.loads.load import Load
from turgor.foundation.errors import TurgorError
from turgor.foundation.given import name as name_of
from turgor.foundation.given import number


@dataclass(frozen=True, slots=True)
class Swelling(Load):
    """Swelling of a body by a solvent or by water, the same in all directions.

    The volume is what the body would have where it is free. The law counts per volume of dry rubber times this ratio;
    a softening by the liquid is a `Stiffness`.

    Parameters
    ----------
    body : str
        Body that swells.
    volume_ratio : float
        Volume of the free swollen body over that as meshed, 0.1 to 100.
    history : sequence of (float, float), or str, optional
        As that of a `Pressure`.

    Examples
    --------
    >>> Swelling("body", 1.2).text()
    'Body body swells to 1.2 of its volume where it is free.'
    """

    body: str
    volume_ratio: float = field()
    history: History = RAMP

    job_key = "swelling"
    of_bodies = True

    if TYPE_CHECKING:

        def __init__(self, body: str, volume_ratio: float, history: History = RAMP) -> None: ...

    def __post_init__(self) -> None:
        subject = f"swelling of '{name_of(self.body, 'body that swells', 'body')}'"
        object.__setattr__(self, "volume_ratio", number(self.volume_ratio, f"{subject}: volume_ratio"))
        object.__setattr__(self, "history", checked(self.history, subject, starting=True))
        if not 0.1 <= self.volume_ratio <= 100:
            raise TurgorError(f"{subject}: volume_ratio is {self.volume_ratio:g}; allowed is 0.1 to 100.")

    def text(self) -> str:
        """Return the sentence of a report."""
        return (
            f"Body {self.body} swells to {self.volume_ratio:g} of its volume where it is free"
            f"{shares_text(self.history)}."
        )

    @property
    def growth(self) -> float:
        """From the ratio of volumes."""
        return float(self.volume_ratio ** (1 / 3) - 1)

    def log_length(self, load_factor: float) -> float:
        """Return the same in all directions."""
        return self.share(load_factor) * log(self.volume_ratio) / 3
