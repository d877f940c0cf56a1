"""HydrostaticPressure: the weight of a liquid, as a pressure on a face that grows with depth."""

from dataclasses import dataclass, field
from math import isfinite
from typing import TYPE_CHECKING

import numpy as np

from turgor.core.model.history import RAMP, History, checked
from turgor.core.model.history_text import shares_text
from turgor.core.model.loads.gravity import STANDARD_GRAVITY, fall_direction
from turgor.core.model.loads.load import Load, Vector
from turgor.foundation.errors import TurgorError
from turgor.foundation.given import Quantities, Quantity, number
from turgor.foundation.given import name as name_of
from turgor.units import mm


@dataclass(frozen=True, slots=True, kw_only=True)
class HydrostaticPressure(Load):
    """A liquid that fills a cavity or surrounds a face: its pressure is 0 at a level and grows with depth.

    The pressure acts on the deformed face, so that all of it together is the weight of what a cavity contains, or the
    buoyancy of a body. It adds to a `Pressure` or to a prescribed volume, whose pressure is then that at the level.

    Parameters
    ----------
    face : str
        Face that the liquid touches, usually ``"cavity"`` or ``"outside"``; a load for each where there are several.
    density : float [kg/m³]
        Of the liquid; above 0.
    level : float [m]
        Height against the fall, measured from the origin, at which the pressure of the liquid is 0.
    free_surface : bool
        Whether the liquid ends at the level, as that around a float does: what is above stays dry. If not, as in a
        closed cavity, the pressure above the level is negative.
    direction : (3,) floats
        Direction of the fall; normalized.
    acceleration : float [m/s²]
        That of gravity.
    history : sequence of (float, float), or str, optional
        As that of a `Pressure`: the share of the weight.

    Raises
    ------
    TurgorError
        If the density is not above 0, or another number is not allowed.

    Examples
    --------
    >>> HydrostaticPressure(face="cavity", density="1000 kg/m³", level="80 mm").text()
    'Liquid of 1000 kg/m³ on cavity, of no pressure at a height of 80 mm, following the surface.'
    """

    face: str
    density: float = field(metadata={"dimension": "density"})
    level: float = field(metadata={"dimension": "length"})
    free_surface: bool = False
    direction: tuple[float, float, float] = (0.0, 0.0, -1.0)
    acceleration: float = field(default=STANDARD_GRAVITY, metadata={"dimension": "acceleration"})
    history: History = RAMP

    job_key = "liquids"

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            face: str,
            density: Quantity,
            level: Quantity,
            free_surface: bool = False,
            direction: Quantities = (0, 0, -1),
            acceleration: Quantity = STANDARD_GRAVITY,
            history: History = RAMP,
        ) -> None: ...

    def __post_init__(self) -> None:
        subject = f"liquid on '{name_of(self.face, 'face of a liquid', 'cavity')}'"
        for key in ("density", "level", "acceleration"):
            value = number(getattr(self, key), f"{subject}: {key}", "length" if key == "level" else key)
            if not isfinite(value) or (key != "level" and value <= 0):
                raise TurgorError(f"{subject}: {key} is {value:g} in SI units; it must be above 0.")
            object.__setattr__(self, key, value)
        if not isinstance(self.free_surface, bool):
            raise TurgorError(f"{subject}: free_surface is {self.free_surface!r}; write true or false.")
        object.__setattr__(self, "direction", fall_direction(self.direction, subject))
        object.__setattr__(self, "history", checked(self.history, subject, starting=True))

    @property
    def gradient(self) -> Vector:
        """Derivative of the whole pressure by the place [Pa/m]."""
        scale = self.density * self.acceleration / float(np.linalg.norm(self.direction))
        x, y, z = (0.0 + scale * part for part in self.direction)
        return x, y, z

    @property
    def words(self) -> str:
        """Density, face and level."""
        above = ", dry above" if self.free_surface else ""
        height = f"of no pressure at a height of {self.level / mm:g} mm"
        return f"Liquid of {self.density:g} kg/m³ on {self.face}, {height}{above}"

    def text(self) -> str:
        """Return the sentence of a report."""
        return f"{self.words}, following the surface{shares_text(self.history)}."

    def mirrored(self, axis: int) -> bool:
        """Whether the pressure does not change across the plane."""
        return not self.direction[axis]

    @property
    def outside(self) -> bool:
        """Not an outside load: the liquid drives the actuator."""
        return False

    @property
    def liquid(self) -> "HydrostaticPressure":
        """Itself."""
        return self
