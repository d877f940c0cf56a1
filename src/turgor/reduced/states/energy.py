"""Energy: what the parts of a reduced model store."""

from typing import Protocol, runtime_checkable

from turgor.foundation.errors import TurgorError
from turgor.reduced.states.equations import EquationsAt


@runtime_checkable
class Storing(Protocol):
    """A part that knows its energy."""

    def energy(self) -> float:
        """Scaled energy."""


def stored(at: EquationsAt) -> float:
    """Scaled energy of all parts, and of the compression of the rubber."""
    s = at.y[len(at.equations.forces) :]
    out = 0.5 * float(s @ at.equations.compliance @ s)
    if at.moments is not None:
        out += 0.5 * float(at.moments.values @ at.moments.values)
    for part in at.parts:
        if not isinstance(part, Storing):
            raise TurgorError(f"{type(part).__name__.removesuffix('At').lower()} has no energy in motion yet.")
        out += part.energy()
    return out
