"""Hardening: a body becomes stiffer in the shape that it has, as a core that freezes or layers that jam."""

from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from turgor.core.model.history import RAMP, History, checked
from turgor.core.model.history_text import shares_text
from turgor.core.model.loads.load import Array, Load
from turgor.foundation.errors import TurgorError
from turgor.foundation.given import name as name_of
from turgor.foundation.given import number


@dataclass(frozen=True, slots=True)
class Hardening(Load):
    """Stiffness that is added to a body, free of stress in the shape in which the stage begins.

    A second network of the same law, with a factor, acts besides the first one. The new stiffness changes nothing at
    the moment at which it comes: the body stays where it is, and resists what follows. A factor of 0 in a later stage
    takes the network away, and with it the stress that it has by then.

    Parameters
    ----------
    body : str
        Body that hardens.
    factor : float
        Shear stiffness of the new network over that of its law, 0 to 1e6.
    history : sequence of (float, float), or str, optional
        As that of a `Pressure`.
    shape : (n, 3) array or None [m]
        Displacement of the nodes at which the network has no stress. A stage states it, with that at its beginning;
        without stages it is the shape of the mesh.

    Examples
    --------
    >>> Hardening("core", 1.0).text()
    'Body core hardens by 1 of the stiffness of its law, free of stress in the shape of the mesh.'
    """

    body: str
    factor: float
    history: History = RAMP
    shape: NDArray[np.float64] | None = field(default=None, compare=False, repr=False)

    job_key = "hardening"
    of_bodies = True

    if TYPE_CHECKING:

        def __init__(self, body: str, factor: float, history: History = RAMP, shape: Array | None = None) -> None: ...

    def __post_init__(self) -> None:
        subject = f"hardening of '{name_of(self.body, 'body that hardens', 'body')}'"
        object.__setattr__(self, "factor", number(self.factor, f"{subject}: factor"))
        object.__setattr__(self, "history", checked(self.history, subject))
        if not 0 <= self.factor <= 1e6:
            raise TurgorError(f"{subject}: factor is {self.factor:g}; allowed is 0 to 1e6.")

    @property
    def hardens(self) -> bool:
        """It does."""
        return True

    def text(self) -> str:
        """Return the sentence of a report."""
        where = "of the mesh" if self.shape is None else "at the beginning of its stage"
        return (
            f"Body {self.body} hardens by {self.factor:g} of the stiffness of its law, free of stress in the shape "
            f"{where}{shares_text(self.history)}."
        )

    def begun(self, displacement: Array) -> "Hardening":
        """Return the load of a stage that begins at a displacement (n, 3)."""
        return replace(self, shape=displacement)

    def network(self, load_factor: float) -> float:
        """Return the factor of the network at a load factor."""
        return self.factor * self.share(load_factor)
