"""Cores of a mold: what fills the cavities, and stands out through their openings."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from turgor.core.geometry import occ
from turgor.core.geometry.cad.cavities import Hollow
from turgor.core.geometry.cad.facets import Facets
from turgor.core.geometry.molds.parting import areas
from turgor.foundation.errors import TurgorError

Array = NDArray[np.float64]

#: Cosine of the angle by which an opening may be off an axis.
STRAIGHT = 0.9999

#: A core leaves in the parting plane if the middle of its opening is this close to it [CAD units].
LEVEL = 1e-6

#: Facets of a cavity hold the core back if they look against its pull by more than this sine.
SLOPE = 1e-3


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Plug:
    """The way of a core out of the casting.

    Parameters
    ----------
    shape : CAD shape
        Prism over the opening, out of the casting.
    axis : int
        Axis along which it leaves.
    side : int
        1 if it leaves toward positive coordinates, else -1.
    trapped : float [CAD units²]
        Area of the cavity that the core cannot pass when it is pulled out.
    """

    shape: Any
    axis: int
    side: int
    trapped: float

    @property
    def foot(self) -> Array:
        """Middle of the opening."""
        low, high = (np.array([corner[i] for i in range(3)]) for corner in self.shape.bounding_box)
        middle = (low + high) / 2
        middle[self.axis] = (low if self.side > 0 else high)[self.axis]
        return np.asarray(middle)

    def steps(self, axis: int, height: float) -> bool:
        """Whether a step of the lower half carries it: it leaves across the pull, and not in the parting plane."""
        return axis != self.axis and abs(float(self.foot[axis]) - height) > LEVEL


def plug_of(name: str, hollow: Hollow, facets: Facets, faces: list[Any], length: float) -> Plug:
    """Return the plug of a cavity.

    Parameters
    ----------
    name : str
        Cavity, for messages.
    hollow : Hollow
        The cavity.
    facets : Facets
        Surface of the casting.
    faces : list of CAD faces
        Faces of the casting.
    length : float [CAD units]
        Length of the prism.

    Raises
    ------
    TurgorError
        If the cavity has no opening, or one that is not plane and across an axis.
    """
    if not hollow.openings:
        raise TurgorError(
            f"a mold for '{name}' needs an opening that holds its core, and the cavity is closed. Give a family its "
            "inlet_diameter, draw the inlet of a CAD part, or cast it in two parts."
        )
    rows = np.isin(facets.face, hollow.faces)
    corners = facets.points[facets.triangles[rows]]
    area, normal = areas(corners)
    out = -(area[:, None] * normal).sum(
        axis=0
    )  # the cap closes the surface: its area vector is minus that of the walls
    out = -out / np.linalg.norm(out)
    axis = int(np.argmax(np.abs(out)))
    if abs(out[axis]) < STRAIGHT:
        raise TurgorError(
            f"the opening of '{name}' faces {np.array2string(out, precision=2)}; a mold needs one across x, y or z."
        )
    side = 1 if out[axis] > 0 else -1
    cap = occ.Face(occ.Wire(_rim(hollow, faces)))
    way = [0.0, 0.0, 0.0]
    way[axis] = side * length
    trapped = area[normal[:, axis] * side < -SLOPE].sum()
    return Plug(shape=occ.Prism(cap, occ.Vec(*way)), axis=axis, side=side, trapped=float(trapped))


def _rim(hollow: Hollow, faces: list[Any]) -> list[Any]:
    """Edges that bound the walls of a cavity."""
    times: dict[Any, int] = {}
    for i in hollow.faces:
        for edge in faces[i].edges:
            times[edge] = times.get(edge, 0) + 1
    return [edge for edge, count in times.items() if count == 1]
