"""Channel: a narrow way between two cavities, through which a liquid flows against a resistance."""

from collections.abc import Container, Iterable
from dataclasses import dataclass, field
from math import isfinite
from typing import TYPE_CHECKING

from turgor.core.meshing.mesh import Mesh
from turgor.core.model.history import CONSTANT, History, checked
from turgor.core.model.history_text import shares_text
from turgor.core.model.loads.load import Load
from turgor.core.model.loads.pressure import pressures_among
from turgor.foundation.errors import TurgorError, unknown
from turgor.foundation.given import Quantity, number


@dataclass(frozen=True, slots=True, kw_only=True)
class Channel(Load):
    """A channel between two cavities: an incompressible liquid flows through it, (p₁ − p₂)/R from the first one.

    A cavity at a channel that has no `Pressure` is closed: its volume grows by what flows in, and its pressure is the
    answer. The procedure needs time: `Static` with a duration, or `Dynamic`. The volume of the channel and the inertia
    of the liquid in it are left out. A laminar round channel of length l and diameter d has R = 128 η l/(π d⁴).

    Parameters
    ----------
    between : (str, str)
        Two cavities.
    resistance : float [Pa s/m³]
        Difference of the pressures over the flow, that of the whole actuator; above 0.
    history : sequence of (float, float), or str, optional
        As that of a `Pressure`: the share of the conductance, such as that of a valve. By default it is open from the
        start.

    Raises
    ------
    TurgorError
        If the cavities are not two, or the resistance is not above 0.

    Examples
    --------
    >>> Channel(between=("cavity_1", "cavity_2"), resistance="2 kPa s/mL").text()
    'Channel between cavity_1 and cavity_2 with a resistance of 2e+09 Pa s/m³.'
    """

    between: tuple[str, str] = field(metadata={"example": '["cavity_1", "cavity_2"]'})
    resistance: float = field(metadata={"dimension": "flow resistance"})
    history: History = CONSTANT

    job_key = "channels"
    acts_at_rest = False
    spread = False

    if TYPE_CHECKING:

        def __init__(self, *, between: tuple[str, str], resistance: Quantity, history: History = CONSTANT) -> None: ...

    def __post_init__(self) -> None:
        between = (self.between,) if isinstance(self.between, str) else tuple(self.between)
        if len(between) != 2 or len(set(between)) != 2 or not all(isinstance(name, str) for name in between):
            raise TurgorError(f"channel: between is {self.between!r}; two cavities are needed.")
        object.__setattr__(self, "between", between)
        subject = f"channel between {self.place}"
        value = number(self.resistance, f"{subject}: resistance", "flow resistance")
        if not (isfinite(value) and value > 0):
            raise TurgorError(f"{subject}: resistance is {value:g} Pa s/m³; it must be above 0.")
        object.__setattr__(self, "resistance", value)
        object.__setattr__(self, "history", checked(self.history, subject, starting=True))

    @property
    def place(self) -> str:
        """Both cavities."""
        return " and ".join(self.between)

    @property
    def named_faces(self) -> tuple[str, ...]:
        """Both cavities."""
        return self.between

    def text(self) -> str:
        """Return the sentence of a report."""
        shares = "" if self.history == CONSTANT else shares_text(self.history)
        return f"Channel between {self.place} with a resistance of {self.resistance:g} Pa s/m³{shares}."

    def check(self, mesh: Mesh, points: Container[str]) -> None:
        """Refuse faces that enclose nothing."""
        for name in self.between:
            if name not in mesh.cavities:
                raise unknown("cavity at a channel", name, mesh.cavities)

    @property
    def outside(self) -> bool:
        """It is no dead force."""
        return False

    @property
    def channel(self) -> "Channel":
        """Itself."""
        return self


def closed_cavities(loads: Iterable[Load]) -> tuple[str, ...]:
    """Name the cavities at channels that have no pressure among loads.

    Parameters
    ----------
    loads : iterable of Load

    Returns
    -------
    tuple of str

    Examples
    --------
    >>> from turgor.core.model.loads.pressure import Pressure
    >>> channel = Channel(between=("cavity_1", "cavity_2"), resistance=1e9)
    >>> closed_cavities([channel, Pressure("cavity_1", 1e3)])
    ('cavity_2',)
    """
    loads = tuple(loads)
    given = {load.face for load in pressures_among(loads)}
    ends = dict.fromkeys(name for load in loads if load.channel is not None for name in load.channel.between)
    return tuple(name for name in ends if name not in given)
