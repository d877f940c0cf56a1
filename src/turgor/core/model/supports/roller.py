"""Roller: a plane face, or a place, that does not move along one direction, which need not be x, y or z."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from turgor.core.meshing.mesh import Mesh
from turgor.core.model.loads.load import Deck
from turgor.core.model.places import NodesAt, checked_face, described
from turgor.core.model.supports.support import Array, Ints, Support
from turgor.foundation.errors import TurgorError
from turgor.foundation.given import Quantities, vector
from turgor.foundation.round_off import ROUND_OFF
from turgor.units import mm


@dataclass(frozen=True, slots=True)
class Roller(Support):
    """Hold a face along one direction: along its normal, as on rollers on a slope, or along any other direction.

    Across the direction the face is free. `Fixed` holds along x, y and z, `Radial` along the radius of a cylinder.

    Parameters
    ----------
    face : str or NodesAt
        Name of the face. Or an edge, a node or the nodes in a box, which need a direction.
    along : (3,) floats, optional
        The direction, of any length but zero; the normal of a plane face by default.

    Raises
    ------
    TurgorError
        If the direction is zero, or a place has none.

    Examples
    --------
    >>> Roller("ramp", (1, 0, 1)).text()
    'ramp does not move along (1, 0, 1).'
    """

    face: str | NodesAt
    along: tuple[float, float, float] | None = None

    at_places = True
    job_texts: ClassVar[Mapping[str, Mapping[str, Any]]] = {"normal": {}}

    if TYPE_CHECKING:

        def __init__(self, face: str | NodesAt, along: Quantities | None = None) -> None: ...

    def __post_init__(self) -> None:
        what = f"roller of '{checked_face(self.face, 'face of a roller', 'ramp')}'"
        if self.along is None and isinstance(self.face, NodesAt):
            raise TurgorError(f"{what}: along is missing; only a face has a normal, give for example (1, 0, 1).")
        if self.along is not None:
            object.__setattr__(self, "along", vector(self.along, f"{what}: along"))
            if not np.linalg.norm(self.along) > 0:
                raise TurgorError(f"{what}: along is a zero vector; give for example (1, 0, 1).")

    def text(self) -> str:
        """Return the sentence of a report."""
        along = "its normal" if self.along is None else f"({', '.join(f'{part:g}' for part in self.along)})"
        return f"{described(self.face)} does not move along {along}."

    def check(self, mesh: Mesh) -> None:
        """Refuse a face that is not plane, and parts of a body of revolution and sectors."""
        if mesh.revolved or mesh.wedge is not None:
            raise TurgorError(
                f"roller of '{self.place}': it holds a direction that other sectors do not have; take Fixed along the "
                'axis or Radial, or model the whole part (symmetry = "none").'
            )
        self.normals(mesh)

    def normals(self, mesh: Mesh) -> tuple[Ints, Array]:
        """Return its nodes with one direction."""
        nodes = self.nodes(mesh)
        along = np.array(self._normal(mesh) if self.along is None else self.along, dtype=np.float64)
        return nodes, np.tile(along / np.linalg.norm(along), (len(nodes), 1))

    def _normal(self, mesh: Mesh) -> Array:
        points = mesh.points[mesh.face_nodes(self.place)]
        points = points - points.mean(axis=0)
        normal = np.asarray(np.linalg.svd(points, full_matrices=False)[2][2])
        off = float(np.abs(points @ normal).max())
        if off > ROUND_OFF.mesh_digits * float(np.ptp(points, axis=0).max()):
            raise TurgorError(
                f"roller of '{self.place}': the face is not plane, a node lies {off / mm:.3g} mm off; state along, or "
                "take Radial for a cylinder."
            )
        return normal

    def boundary_rows(self, deck: Deck) -> tuple[str, ...]:
        """No row: the directions of all rollers are equations in the file."""
        return ()

    def job_text(self) -> str | dict[str, object]:
        """Return the word, or a table with the direction."""
        if self.along is None:
            return "normal"
        stated: dict[str, object] = {"directions": list(self.along)}
        return stated if isinstance(self.face, str) else self.face.table() | stated
