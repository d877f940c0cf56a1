"""Tendon: a cable through guides on the surface, pulled by a motor at its first point."""

from collections.abc import Container, Sequence
from dataclasses import dataclass, field
from math import isfinite
from typing import TYPE_CHECKING

from turgor.core.meshing.mesh import Mesh
from turgor.core.model.history import RAMP, History, checked
from turgor.core.model.history_text import shares_text
from turgor.core.model.loads.images import refuse_in_sectors
from turgor.core.model.loads.load import Load, Vector
from turgor.foundation.errors import TurgorError
from turgor.foundation.given import Quantities, Quantity, checked_guides, number
from turgor.units import N, mm

#: Largest coefficient of friction between a cable and its guides.
MOST_FRICTION = 2.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Tendon(Load):
    """A cable that runs straight from guide to guide, pulled at its first point and fastened at its last.

    Either the tension at the motor is given, or the length of cable that the motor draws in, with the stiffness of the
    cable. A cable cannot push: it goes slack. At each guide friction takes its share of the tension, exp(−μ θ) for a
    turn by θ (Euler and Eytelwein) where the cable slides towards the motor, and exp(μ θ) where it slides back. Between
    the two it sticks, so that a state depends on all states before it.

    Parameters
    ----------
    through : sequence of (3,) floats [m]
        Points of the surface at rest, from the motor to the end, at least two.
    tension : float, optional [N]
        Tension at the motor; 0 in a stage that lets go.
    pull : float, optional [m]
        Length of cable that is drawn in at a share of one; 0 in a stage that lets go. It needs a ``cable_stiffness``.
    cable_stiffness : float, optional [N/m]
        Tension for each meter that the whole cable is stretched: its modulus times its section over its length.
    friction : float [-]
        Coefficient of friction at the guides, 0 to 2.
    history : sequence of (float, float), or str, optional
        As that of a `Pressure`.

    Raises
    ------
    TurgorError
        If not exactly one of tension and pull is given, there are fewer than two points, two neighbors coincide, or a
        number is not allowed.

    Examples
    --------
    >>> Tendon(through=[(0, 0, 5e-3), (0.08, 0, 5e-3)], tension="2 N").words
    'Tendon through 2 points with a tension of 2 N'
    """

    through: tuple[Vector, ...] = field(metadata={"dimension": "length"})
    tension: float | None = field(default=None, metadata={"dimension": "force"})
    pull: float | None = field(default=None, metadata={"dimension": "length"})
    cable_stiffness: float | None = field(default=None, metadata={"dimension": "spring stiffness"})
    friction: float = 0.0
    history: History = RAMP

    job_key = "tendons"
    #: Whether heat drives it.
    heated = False
    spread = False
    lasting = True

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            through: Sequence[Quantities],
            tension: Quantity | None = None,
            pull: Quantity | None = None,
            cable_stiffness: Quantity | None = None,
            friction: float = 0.0,
            history: History = RAMP,
        ) -> None: ...

    def __post_init__(self) -> None:
        object.__setattr__(self, "through", checked_guides(self.through, "tendon"))
        if (self.tension is None) == (self.pull is None):
            raise TurgorError("tendon: give either tension or pull, not both.")
        if (self.pull is None) != (self.cable_stiffness is None):
            raise TurgorError("tendon: pull needs the cable_stiffness, and only pull does.")
        for key, dimension in (("tension", "force"), ("pull", "length"), ("cable_stiffness", "spring stiffness")):
            self._positive(key, dimension)
        friction = number(self.friction, "tendon: friction")
        if not 0 <= friction <= MOST_FRICTION:
            raise TurgorError(f"tendon: friction is {friction:g}; allowed is 0 to {MOST_FRICTION:g}.")
        object.__setattr__(self, "friction", friction)
        object.__setattr__(self, "history", checked(self.history, "tendon", starting=True))

    def _positive(self, key: str, dimension: str) -> None:
        if getattr(self, key) is None:
            return
        value = number(getattr(self, key), f"tendon: {key}", dimension)
        drives = key != "cable_stiffness"
        if not (value > 0 or (drives and value == 0)) or not isfinite(value):
            raise TurgorError(f"tendon: {key} is {value:g} in SI units; it must be {'0 or ' * drives}above 0.")
        object.__setattr__(self, key, value)

    @property
    def place(self) -> str:
        """Its points."""
        return str(self.through)

    @property
    def label(self) -> str:
        """Its class; the points would be long."""
        return "Tendon"

    @property
    def words(self) -> str:
        """Number of points, and the tension or the pull."""
        drive = (
            f"a tension of {self.tension / N:g} N"
            if self.tension is not None
            else f"{(self.pull or 0) / mm:g} mm drawn in"
        )
        rubbing = f", friction {self.friction:g}" if self.friction else ""
        return f"Tendon through {len(self.through)} points with {drive}{rubbing}"

    def text(self) -> str:
        """Return the sentence of a report."""
        return f"{self.words}{shares_text(self.history)}."

    def turned(self, axis: int) -> bool:
        """A cable is elsewhere after a turn."""
        return False

    def check(self, mesh: Mesh, points: Container[str]) -> None:
        """Refuse sectors of a wedge; whether the points are on the surface is checked by the equations."""
        refuse_in_sectors(mesh, "a tendon")

    @property
    def outside(self) -> bool:
        """The work of the motor is not that of a dead force."""
        return False

    @property
    def path_dependent(self) -> str:
        """Its friction, if there is any."""
        return "the friction of a cable" if self.friction else ""

    @property
    def alone(self) -> str:
        """What to do where two loads contradict each other."""
        return "a stage that pulls at a cable repeats its friction and cable_stiffness, and tension stays tension."

    def of_same(self, other: "Tendon") -> bool:
        """Whether two loads pull at one cable."""
        alike = (self.friction, self.cable_stiffness) == (other.friction, other.cable_stiffness)
        return alike and (self.tension is None) == (other.tension is None)

    @property
    def cable(self) -> "Tendon":
        """Itself."""
        return self
