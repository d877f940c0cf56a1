"""Morison: added mass and drag of a slender body in a liquid, by strip theory."""

from collections.abc import Container
from dataclasses import dataclass, field
from math import isfinite
from typing import TYPE_CHECKING

import numpy as np

from turgor.core.meshing.mesh import Mesh
from turgor.core.model.history import CONSTANT, History, checked
from turgor.core.model.history_text import shares_text
from turgor.core.model.loads.gravity import fall_direction
from turgor.core.model.loads.load import Load
from turgor.foundation.errors import TurgorError
from turgor.foundation.given import Quantities, Quantity, number
from turgor.foundation.given import name as name_of


@dataclass(frozen=True, slots=True)
class SurroundingSettings:
    """Settings of the check that a face surrounds a body, as shares of its area.

    Parameters
    ----------
    across : float
        A face with less area across the axis is the end of a body, round-off and a little taper included.
    one_sided : float
        Vector area across the axis, over the area: 0 around a body, 1 of one flat side, a third without one of four.
    """

    across: float = 0.05
    one_sided: float = 0.5


SURROUNDING = SurroundingSettings()


@dataclass(frozen=True, slots=True, kw_only=True)
class Morison(Load):
    """Added mass and drag of a slender body that moves in a liquid at rest: Morison's equation, by strip theory.

    Each section of the body is on its own: it carries along ``added_mass`` times the liquid that it displaces, and has
    a drag of ½ ``density`` ``drag`` ``D |v| v`` per length, both for motion across the body's axis. D is the diameter
    of a circle with the perimeter of the section. It acts in motion only, not on equilibria: buoyancy is a
    `HydrostaticPressure`.

    Parameters
    ----------
    face : str
        Face around the body, usually ``"outside"``.
    density : float [kg/m³]
        Of the liquid.
    axis : (3,) floats
        Direction of the body at rest; any length but zero.
    added_mass : float
        Mass that moves along over the displaced mass, 0 or more: 1 for a circle, π w/(4 t) for a strip of width w and
        thickness t that moves along t.
    drag : float
        Coefficient of drag for the diameter D, 0 or more: about 1.1 for a circle, 3 for a flat strip (2 for its width,
        which is π/2 D).
    history : sequence of (float, float), or str, optional
        As that of a `Pressure`; by default the liquid is there from the start.

    Raises
    ------
    TurgorError
        If a number is not allowed.

    Examples
    --------
    >>> Morison(face="outside", density="1000 kg/m³", axis=(1, 0, 0)).text()
    'Liquid of 1000 kg/m³ around outside, by strip theory: added mass 1, drag 1.'
    """

    face: str
    density: float = field(metadata={"dimension": "density"})
    axis: tuple[float, float, float]
    added_mass: float = 1.0
    drag: float = 1.0
    history: History = CONSTANT

    job_key = "morison"
    acts_at_rest = False

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            face: str,
            density: Quantity,
            axis: Quantities,
            added_mass: float = 1.0,
            drag: float = 1.0,
            history: History = CONSTANT,
        ) -> None: ...

    def __post_init__(self) -> None:
        subject = f"liquid around '{name_of(self.face, 'face in a liquid', 'outside')}'"
        for key in ("density", "added_mass", "drag"):
            value = number(getattr(self, key), f"{subject}: {key}", "density" if key == "density" else "")
            if not (isfinite(value) and value >= 0):
                raise TurgorError(f"{subject}: {key} is {value:g}; allowed is 0 or more.")
            object.__setattr__(self, key, value)
        object.__setattr__(self, "axis", fall_direction(self.axis, subject))
        object.__setattr__(self, "history", checked(self.history, subject, starting=True))

    def check(self, mesh: Mesh, points: Container[str]) -> None:
        """Refuse cavities, and faces that lie across the axis or on one side of the body."""
        Load.check(self, mesh, points)
        around = f"name the face around it, such as 'outside' ({', '.join(mesh.faces)} are there)"
        subject = f"morison: '{self.face}'"
        if self.face in mesh.cavities:
            raise TurgorError(
                f"{subject} is a cavity, whose liquid moves with its walls: state it as [[loads.liquids]]; for the "
                f"liquid around the body {around}."
            )
        corners = mesh.points[mesh.face(self.face)[:, :3]]
        normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        axis = np.array(self.axis) / np.linalg.norm(self.axis)
        across = normals - (normals @ axis)[:, None] * axis
        width = float(np.linalg.norm(across, axis=1).sum())
        if width < SURROUNDING.across * float(np.linalg.norm(normals, axis=1).sum()):
            raise TurgorError(f"{subject} lies across the axis of the body and does not surround it; {around}.")
        total = across.sum(axis=0)
        total[[number for number, _ in mesh.mirror_planes]] = 0.0
        if mesh.wedge is None and float(np.linalg.norm(total)) > SURROUNDING.one_sided * width:
            raise TurgorError(f"{subject} lies on one side of the body and does not surround it; {around}.")

    def text(self) -> str:
        """Return the sentence of a report."""
        numbers = f"added mass {self.added_mass:g}, drag {self.drag:g}"
        shares = "" if self.history == CONSTANT else shares_text(self.history)
        return f"Liquid of {self.density:g} kg/m³ around {self.face}, by strip theory: {numbers}{shares}."

    def mirrored(self, axis: int) -> bool:
        """Whether the axis lies in the plane."""
        return not self.axis[axis]

    @property
    def outside(self) -> bool:
        """It is no dead force."""
        return False

    @property
    def strips(self) -> "Morison":
        """Itself."""
        return self
