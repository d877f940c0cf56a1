"""PreStretch: a body that was stretched before it was bonded in the shape of the mesh."""

from collections.abc import Container, Mapping
from dataclasses import dataclass, field, fields, replace
from math import log
from typing import TYPE_CHECKING, Any

import numpy as np

from turgor.core.meshing.mesh import Mesh
from turgor.core.model.fibers import Fibers
from turgor.core.model.history import RAMP, History, checked
from turgor.core.model.history_text import shares_text
from turgor.core.model.loads.images import check_symmetric
from turgor.core.model.loads.load import Array, Load
from turgor.foundation.errors import TurgorError, unknown
from turgor.foundation.given import Quantities, number, vector
from turgor.foundation.given import name as name_of

#: How a body was stretched, with words for a report.
FORMS = {"along": "along", "across": "in all directions across", "around": "around the axis", "thread": "along itself"}


@dataclass(frozen=True, slots=True)
class PreStretch(Load):
    """Stretch that a body had before it was bonded: the mesh is the stretched shape.

    The volume does not change. Where nothing holds it any more, the body contracts by the inverse of the stretch and
    becomes thicker.

    Parameters
    ----------
    body : str
        Body, sheet or winding that is stretched in the shape of the mesh.
    stretch : float
        Length in the mesh over that without stress, 0.1 to 10; below 1 the body is compressed.
    direction : (3,) floats
        The direction that ``form`` refers to, of any length.
    form : str
        ``"along"`` the direction; ``"across"`` it, a sheet that is stretched alike in all directions of its plane,
        whose normal the direction is; ``"around"`` an axis of this direction, as a ring that is pulled over a core.
        A winding is stretched along its threads, and has the form ``"thread"`` without being stated.
    center : (3,) floats [m]
        Point on the axis; for ``"around"`` only.
    history : sequence of (float, float), or str, optional
        As that of a `Pressure`.

    Examples
    --------
    >>> PreStretch("skin", 1.2, direction=(1, 0, 0)).text()
    'Body skin was stretched to 1.2 along (1, 0, 0) before it was bonded.'
    """

    body: str
    stretch: float
    direction: tuple[float, float, float] = (1.0, 0.0, 0.0)
    form: str = "along"
    center: tuple[float, float, float] = field(default=(0.0, 0.0, 0.0), metadata={"dimension": "length"})
    history: History = RAMP

    job_key = "pre_stretch"
    of_bodies = True

    if TYPE_CHECKING:

        def __init__(
            self, body: str, stretch: float, direction: Quantities = (1, 0, 0), form: str = "along",
            center: Quantities = (0, 0, 0), history: History = RAMP,
        ) -> None: ...  # fmt: skip

    def __post_init__(self) -> None:
        subject = f"pre-stretch of '{name_of(self.body, 'body that is stretched', 'body')}'"
        object.__setattr__(self, "stretch", number(self.stretch, f"{subject}: stretch"))
        object.__setattr__(self, "direction", vector(self.direction, f"{subject}: direction"))
        object.__setattr__(self, "center", vector(self.center, f"{subject}: center", "length"))
        object.__setattr__(self, "history", checked(self.history, subject, starting=True))
        if not 0.1 <= self.stretch <= 10:
            raise TurgorError(f"{subject}: stretch is {self.stretch:g}; allowed is 0.1 to 10, and 1 is none.")
        if self.form not in FORMS:
            raise unknown("form of a pre-stretch", self.form, FORMS)
        if not np.linalg.norm(self.direction) > 0:
            raise TurgorError(f"{subject}: direction is a zero vector; give for example (1, 0, 0).")

    @property
    def unit(self) -> Array:
        """The direction with the length 1."""
        return np.array(self.direction) / np.linalg.norm(self.direction)

    def text(self) -> str:
        """Return the sentence of a report."""
        if self.form == "thread":
            return (
                f"Threads of {self.body} were stretched to {self.stretch:g} before they were bonded"
                f"{shares_text(self.history)}."
            )
        along = f"({', '.join(f'{part:.4g}' for part in self.direction)})"
        return (
            f"Body {self.body} was stretched to {self.stretch:g} {FORMS[self.form]} {along} before it was bonded"
            f"{shares_text(self.history)}."
        )

    def of_materials(self, materials: Mapping[str, Any]) -> Load:
        """Return the stretch with the form of what it stretches: threads are stretched along themselves.

        Raises
        ------
        TurgorError
            If a direction is stated for a winding, or the form of threads for something else.
        """
        subject = f"pre-stretch of '{self.body}'"
        if not isinstance(materials.get(self.body), Fibers):
            if self.form == "thread" and self.body in materials:
                raise TurgorError(f"{subject}: form 'thread' is that of windings, and '{self.body}' is none.")
            return self
        usual = [each.default for each in fields(self) if each.name in ("direction", "center")]
        if self.form not in ("along", "thread") or [self.direction, self.center] != usual:
            raise TurgorError(
                f"{subject}: '{self.body}' is a winding, whose threads are stretched along themselves; leave out "
                "direction, form and center."
            )
        return replace(self, form="thread")

    def mirrored(self, axis: int) -> bool:
        """Whether the direction lies in the plane or along its normal."""
        return float(abs(self.unit[axis])) in (0.0, 1.0)

    def turned(self, axis: int) -> bool:
        """Whether the direction is the axis; a stretch along another one is not the same after a turn."""
        return float(abs(self.unit[axis])) == 1.0

    def check(self, mesh: Mesh, points: Container[str]) -> None:
        """Refuse an axis that a half model or a wedge does not have in its planes."""
        super(PreStretch, self).check(mesh, points)
        if self.form == "around":
            off = np.array(self.center) - (np.array(self.center) @ self.unit) * self.unit
            check_symmetric(mesh, f"pre-stretch of '{self.body}': a center {{:.3g}} m off", tuple(off.tolist()))

    def log_length(self, load_factor: float) -> float:
        """Return minus the logarithm of the stretch, for threads."""
        return -self.share(load_factor) * log(self.stretch)

    def log_stretch(self, points: Array, load_factor: float) -> Array:
        """Return minus the logarithm of the stretch in its direction, and what keeps the volume across."""
        size = self.log_length(load_factor)
        if self.form == "across":
            size *= -2.0
        line = self._tangent(points) if self.form == "around" else self.unit
        return np.asarray(size * (1.5 * line[..., :, None] * line[..., None, :] - 0.5 * np.eye(3)))

    def _tangent(self, points: Array) -> Array:
        """Unit vectors around the axis."""
        around = np.cross(self.unit, points - np.array(self.center))
        return np.asarray(around / np.maximum(np.linalg.norm(around, axis=-1, keepdims=True), 1e-300))
