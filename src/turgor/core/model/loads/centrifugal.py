"""Centrifugal: the force on a body that turns about an axis at a constant speed, in the frame that turns with it."""

from collections.abc import Container
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from turgor.core.meshing.mesh import Mesh
from turgor.core.model.history import RAMP, History, checked
from turgor.core.model.history_text import shares_text
from turgor.core.model.loads.gravity import fall_direction
from turgor.core.model.loads.load import Deck, DeckRows, Load, Vector
from turgor.foundation.errors import TurgorError
from turgor.foundation.given import Quantities, Quantity, number, vector
from turgor.foundation.round_off import ROUND_OFF
from turgor.units import mm


@dataclass(frozen=True, slots=True, kw_only=True)
class Centrifugal(Load):
    """Centrifugal force on all regions and sheets of a part that turns about an axis at a constant speed.

    The force per volume is ρ ω² times the arm from the axis, at the deformed place: it grows where the part stretches
    outwards. Positions are those in the frame that turns with the part. The history is that of the force, so of the
    square of the speed.

    Parameters
    ----------
    speed : float [rad/s]
        Angular speed ω, 0 or more.
    axis : (3,) floats
        Direction of the axis; any length but zero.
    through : (3,) floats [m]
        A point of the axis.
    history : sequence of (float, float), or str, optional
        As that of a `Pressure`.

    Raises
    ------
    TurgorError
        If a number is not allowed.

    Examples
    --------
    >>> Centrifugal(speed="3000 rpm", axis=(0, 0, 1)).text()
    'Turning at 314.159 rad/s about (0, 0, 1) through (0, 0, 0) mm.'
    """

    speed: float = field(metadata={"dimension": "angular speed"})
    axis: Vector
    through: Vector = field(default=(0.0, 0.0, 0.0), metadata={"dimension": "length"})
    history: History = RAMP

    job_key = "centrifugal"
    needs_density = True

    if TYPE_CHECKING:

        def __init__(
            self, *, speed: Quantity, axis: Quantities, through: Quantities = (0, 0, 0), history: History = RAMP
        ) -> None: ...

    def __post_init__(self) -> None:
        object.__setattr__(self, "speed", number(self.speed, "centrifugal force: speed", "angular speed"))
        if self.speed < 0:
            raise TurgorError(f"centrifugal force: speed is {self.speed:g} rad/s; allowed is 0 or more.")
        object.__setattr__(self, "axis", fall_direction(self.axis, "centrifugal force"))
        object.__setattr__(self, "through", vector(self.through, "centrifugal force: through", "length"))
        object.__setattr__(self, "history", checked(self.history, "centrifugal force", starting=True))

    @property
    def along(self) -> np.ndarray:
        """Unit vector along the axis."""
        return np.array(self.axis) / np.linalg.norm(self.axis)

    @property
    def place(self) -> str:
        """No place: it acts on everything."""
        return ""

    def text(self) -> str:
        """Return the sentence of a report."""
        axis = ", ".join(f"{part:g}" for part in self.axis)
        through = ", ".join(f"{part / mm:g}" for part in self.through)
        return f"Turning at {self.speed:g} rad/s about ({axis}) through ({through}) mm{shares_text(self.history)}."

    @property
    def outside(self) -> bool:
        """Not an outside load: it acts on the mass of the actuator itself."""
        return False

    @property
    def spinning(self) -> "Centrifugal":
        """The load itself."""
        return self

    def mirrored(self, axis: int) -> bool:
        """Whether the axis lies in the plane, as far as its direction says, or stands on it."""
        share = abs(float(self.along[axis]))
        return share < ROUND_OFF.same or share > 1 - ROUND_OFF.same

    def turned(self, axis: int) -> bool:
        """Whether it has the direction of the axis."""
        return abs(float(self.along[axis])) > 1 - ROUND_OFF.same

    def check(self, mesh: Mesh, points: Container[str]) -> None:
        """Refuse an axis about which a modeled part is no image of the others."""
        Load.check(self, mesh, points)
        size = float(np.ptp(mesh.points, axis=0).max())
        for number_, level in mesh.mirror_planes:
            off = abs(self.through[number_] - level)
            if not self.turned(number_) and off > ROUND_OFF.mesh_digits * size:
                raise TurgorError(
                    f"centrifugal force: the axis lies {off / mm:.3g} mm off the mirror plane at {'xyz'[number_]} = "
                    f"{level / mm:.4g} mm; put it there, or model the whole part."
                )
        if mesh.revolved and not self.turned("xyz".index(mesh.revolved)):
            raise TurgorError(
                f"centrifugal force: axis is {self.axis}; a body of revolution about {mesh.revolved} turns about that."
            )
        if mesh.wedge is not None:
            off = max(abs(self.through[k] - mesh.wedge.center[k]) for k in mesh.wedge.across)
            if off > ROUND_OFF.mesh_digits * size:
                raise TurgorError("centrifugal force: the axis of a wedge is the one about which it turns.")

    def deck_rows(self, deck: Deck) -> tuple[DeckRows, ...]:
        """Return the row of all cells."""
        place = ", ".join(f"{part / mm:.12g}" for part in self.through)
        axis = ", ".join(f"{part:.12g}" for part in self.along)
        if any(deck.masses.values()):
            raise TurgorError("centrifugal force on masses of reference points has no form in .inp files.")
        return (DeckRows("*DLOAD", self.history, (f"Eall, CENTRIF, {self.speed**2:.12g}, {place}, {axis}",)),)
