"""Cavity procedure: what procedures have in common that prescribe a value for cavities and find their pressures."""

from collections.abc import Mapping, Sequence
from itertools import compress
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from turgor.core.model.model import Model
from turgor.core.solvers.procedures.channel_flow import refuse_channels
from turgor.core.solvers.procedures.procedure import refuse_remeshing
from turgor.core.solvers.procedures.step_options import StepOptions
from turgor.foundation.errors import TurgorError, unknown

Array = NDArray[np.float64]


class CavityProcedure(StepOptions):
    """A procedure that prescribes a value for cavities, such as a volume; their pressures are unknown.

    It gives the conditions for the pressures (`target`) and what a response shows of them (`amounts`).
    """

    __slots__ = ()

    #: Field that states the values, or the names of the cavities.
    requested_field: ClassVar[str] = ""
    #: The value at which nothing is filled in or drawn off.
    neutral: ClassVar[float] = 0.0

    @property
    def requested(self) -> float | Mapping[str, float]:
        """The value requested for all cavities or by their names."""
        values: float | Mapping[str, float] = getattr(self, self.requested_field)
        return values

    def follow(self, problem: Any) -> Any:
        """Seek the pressures of the cavities."""
        from turgor.core.solvers.continuation.scalar_control.cavity_control import follow_cavities  # few jobs need it

        return follow_cavities(problem, self)

    def requested_of(self, names: Sequence[str]) -> Array:
        """Return the requested value of each cavity (k,); 0 where there is none."""
        values = self.requested
        each = [values.get(name, 0.0) for name in names] if isinstance(values, Mapping) else [values]
        return np.array(each, dtype=np.float64)

    def closed(self, model: Model) -> tuple[str, ...]:
        """Name the cavities whose pressure is unknown because channels lead to them."""
        refuse_channels(model, type(self).__name__)
        return ()

    def filled(self, model: Model) -> tuple[str, ...]:
        """Name the cavities for which it prescribes a value.

        Raises
        ------
        TurgorError
            If a cavity does not exist, or none is named where there are several.
        """
        requested, field, known = self.requested, self.requested_field, model.mesh.cavities
        if not isinstance(requested, Mapping):
            if len(known) != 1:
                if not known:
                    raise TurgorError(
                        f"procedure.{field} fills a cavity, and the model has no cavity: no face encloses one."
                    )
                names = ", ".join(known)
                given = "is one number" if field != "cavities" else "names none"
                raise TurgorError(
                    f"procedure.{field} {given}, and the cavities are {names}; give one for each by name."
                )
            return tuple(known)
        for name in requested:
            if name not in known:
                raise unknown(f"cavity in procedure.{field}", name, known)
        return tuple(requested)

    def emptied(self, model: Model) -> tuple[str, ...]:
        """Name the cavities that it draws from; all that it controls where others may press on them."""
        names = self.filled(model)
        less = self.requested_of(names) < self.neutral
        return names if len(model.mesh.cavities) > 1 else tuple(compress(names, less))

    def controlled(self, model: Model) -> tuple[str, ...]:
        """Name the cavities whose pressure is unknown.

        Raises
        ------
        TurgorError
            If a cavity is unknown, encloses no volume, or has a pressure of its own already.
        """
        from turgor.core.meshing.openings import torn_rims  # few jobs need it
        from turgor.core.meshing.surface import outer_triangles, rim_edges

        if self.remesh:
            refuse_remeshing(model)
        field, names = self.requested_field, self.filled(model)
        for name in names:
            if any(load.face == name for load in model.pressures):
                raise TurgorError(
                    f"{name} has a pressure load, and procedure.{field} seeks its pressure; leave the load out."
                )
            rim = rim_edges(model.mesh.face(name))
            if torn_rims(model.mesh, outer_triangles(model.mesh), rim):
                raise TurgorError(f"{name} encloses no volume that procedure.{field} could drive; close it (G02).")
        return tuple(dict.fromkeys((*names, *self.closed(model))))


def by_cavity(value: float | Mapping[str, float], name: str) -> dict[str, float]:
    """Values by the text that names their place after the field."""
    if not isinstance(value, Mapping):
        return {"": value}
    if not value:
        raise TurgorError(f"procedure.{name} names no cavity; state a number, or one for each cavity.")
    return {f".{cavity}": each for cavity, each in value.items()}
