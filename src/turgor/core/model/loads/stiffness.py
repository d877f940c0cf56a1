"""Stiffness: a body becomes softer or stiffer, as a core that melts or grains that jam."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

from turgor.core.model.history import RAMP, History, checked
from turgor.core.model.history_text import shares_text
from turgor.core.model.loads.load import Load
from turgor.foundation.errors import TurgorError
from turgor.foundation.given import name as name_of
from turgor.foundation.given import number


@dataclass(frozen=True, slots=True)
class Stiffness(Load):
    """Factor on the shear stiffness of a body: its law times this number, with the shape of the mesh free of stress.

    The stress of the deformation so far grows and falls with the factor. A body that is deformed and made stiffer
    therefore springs back towards the shape of the mesh. The factor is a geometric mean on the way: half a share of
    0.01 is 0.1. The bulk modulus does not change.

    Parameters
    ----------
    body : str
        Body whose stiffness changes.
    factor : float
        Stiffness over that of its law, 1e-6 to 1e6.
    history : sequence of (float, float), or str, optional
        As that of a `Pressure`.

    Examples
    --------
    >>> melting = Stiffness("core", 1e-4)
    >>> round(melting.stiffness(0.5), 6), melting.text()
    (0.01, 'Body core has 0.0001 of the stiffness of its law.')
    """

    body: str
    factor: float
    history: History = RAMP

    job_key = "stiffness"
    of_bodies = True

    if TYPE_CHECKING:

        def __init__(self, body: str, factor: float, history: History = RAMP) -> None: ...

    def __post_init__(self) -> None:
        subject = f"stiffness of '{name_of(self.body, 'body whose stiffness changes', 'body')}'"
        object.__setattr__(self, "factor", number(self.factor, f"{subject}: factor"))
        object.__setattr__(self, "history", checked(self.history, subject, starting=True))
        if not 1e-6 <= self.factor <= 1e6:
            raise TurgorError(f"{subject}: factor is {self.factor:g}; allowed is 1e-6 to 1e6, and 1 is no change.")

    def text(self) -> str:
        """Return the sentence of a report."""
        return f"Body {self.body} has {self.factor:g} of the stiffness of its law{shares_text(self.history)}."

    def stiffness(self, load_factor: float) -> float:
        """Return the factor to the power of the share."""
        return float(self.factor ** self.share(load_factor))
