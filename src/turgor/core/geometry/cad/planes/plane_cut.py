"""Plane cut: the cross-section of a CAD part at a place along x, as outlines and named edges."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from turgor.core.geometry import occ
from turgor.core.geometry.cad.planes.tracing import loops_of, outline_of, samples
from turgor.core.geometry.extrusion import Fill
from turgor.core.geometry.geometry import Geometry
from turgor.foundation.errors import TurgorError
from turgor.units import mm

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class PlaneCut:
    """The cross-section of a part.

    Parameters
    ----------
    name : str
        Title of the part.
    at : float [m]
        Where along x.
    fill : tuple of (region or None, Outline) [m]
        What lies within each loop of edges, as (y, z); later ones cover earlier ones.
    edges : tuple of (str, (s, 2) array [m])
        Name of the face that each edge bounds, and points on the edge.
    """

    name: str
    at: float
    fill: tuple[Fill, ...]
    edges: tuple[tuple[str, Array], ...]

    @property
    def regions(self) -> tuple[str, ...]:
        """Names of the regions, each once."""
        return tuple(dict.fromkeys(name for name, _ in self.fill if name is not None))


def plane_cut(geometry: Geometry, at: float | None = None) -> PlaneCut:
    """Cut a CAD part across x.

    Parameters
    ----------
    geometry : Geometry
    at : float or None [m]
        Where along x; the middle by default.

    Raises
    ------
    TurgorError
        If the part is no CAD part of solids, or the plane misses it.
    """
    if not hasattr(geometry._cad, "solids"):
        raise TurgorError(f"'{geometry.name}' has no CAD solids that a plane could cut; give a Sketch instead.")
    low, high = geometry.bounds
    place = (low[0] + high[0]) / 2 if at is None else at
    if not low[0] < place < high[0]:
        raise TurgorError(
            f"a section at x = {place / mm:.4g} mm misses '{geometry.name}', which reaches from "
            f"{low[0] / mm:.4g} mm to {high[0] / mm:.4g} mm."
        )
    plane = _plane(geometry, place)
    fill: list[Fill] = []
    edges: list[tuple[str, Array]] = []
    for solid in geometry._cad.solids:
        for face in (solid * plane).faces:
            for number, wire in enumerate(loops_of(face)):
                lines = [samples(edge)[:, 1:] * geometry.length_scale for edge in wire]
                fill.append((str(solid.name) if number == 0 else None, outline_of(lines)))
                edges += [(_name_at(edge, solid), line) for edge, line in zip(wire, lines, strict=True)]
    if not fill:
        raise TurgorError(f"the plane x = {place / mm:.4g} mm cuts no solid of '{geometry.name}'.")
    fill.sort(key=lambda part: (-abs(part[1].area), part[0] is not None))
    return PlaneCut(name=geometry.name, at=place, fill=tuple(fill), edges=tuple(edges))


def _plane(geometry: Geometry, at: float) -> Any:
    """A square across x that is larger than the part, in CAD units."""
    x, reach = at / geometry.length_scale, 2 * geometry.extent / geometry.length_scale
    (_, y, z), _ = ((value / geometry.length_scale for value in corner) for corner in geometry.bounds)
    corners = [occ.Pnt(x, y + a * reach, z + b * reach) for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    return occ.Face(occ.Wire([occ.Segment(corners[i], corners[(i + 1) % 4]) for i in range(4)]))


def _name_at(edge: Any, solid: Any) -> str:
    """Name of the face of a solid on which the middle of an edge lies."""
    low, high = edge.parameter_interval
    middle = occ.Vertex(edge.Value((low + high) / 2))
    face = min(solid.faces, key=lambda each: float(middle.Distance(each)))
    return str(face.name or "outside")
