"""Energy: what the parts of a reduced model store."""

from typing import Protocol, cast

from turgor.reduced.states.equations import EquationsAt


class Storing(Protocol):
    """A part that stores energy: all but inertia."""

    def energy(self) -> float:
        """Scaled energy."""


def stored(at: EquationsAt) -> float:
    """Scaled energy of all parts, and of the compression of the rubber."""
    s = at.y[len(at.equations.forces) :]
    out = 0.5 * float(s @ at.equations.compliance @ s)
    if at.moments is not None:
        out += 0.5 * float(at.moments.values @ at.moments.values)
    return out + sum(cast(Storing, part).energy() for part in at.parts)
