"""Meridian: the section of a body of revolution, read from the mirror plane of its quarter."""

from collections.abc import Sequence
from dataclasses import dataclass
from math import pi
from typing import Any

import numpy as np
from numpy.typing import NDArray

from turgor.core.geometry.cad.planes.tracing import loops_of, outline_of, samples
from turgor.core.geometry.extrusion import Fill
from turgor.core.geometry.geometry import Geometry
from turgor.core.meshing.exchange.settings import MESH_FILE
from turgor.foundation.errors import TurgorError

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Meridian:
    """The section of a body of revolution in coordinates (along the axis, radius).

    Parameters
    ----------
    axis : int
        Number of the axis.
    center : (3,) array [m]
        A point on the axis.
    fill : tuple of (region or None, Outline) [m]
        What lies within each loop of edges; later ones cover earlier ones.
    edges : tuple of (name, (s, 2) array [m])
        Name of the face that each edge bounds, and points on the edge.
    cut : float or None [m]
        Where a mirror plane across the axis cuts it.
    """

    axis: int
    center: Array
    fill: tuple[Fill, ...]
    edges: tuple[tuple[str, Array], ...]
    cut: float | None = None


def meridian_of(geometry: Geometry) -> Meridian:
    """Read the meridian of a quarter of a body of revolution.

    Parameters
    ----------
    geometry : Geometry
        Cut at two mirror planes, such as ``symmetry_y`` and ``symmetry_z``; their line is the axis.

    Raises
    ------
    TurgorError
        If it is no such quarter, or no body of revolution.
    """
    letters = [letter for letter in "xyz" if f"symmetry_{letter}" in geometry.faces]
    if len(letters) < 2 or not hasattr(geometry._cad, "solids"):
        have = ", ".join(f"symmetry_{letter}" for letter in letters) or "none"
        raise TurgorError(
            f"'{geometry.name}' cannot be meshed as axisymmetric: it is no quarter between two mirror planes (it has "
            f'{have}). Use quarter = true of the actuator, or symmetry = "automatic" of the CAD part.'
        )
    # of a part with three mirror planes each axis may be the one
    possible = [axis for axis in range(3) if set("xyz") - {"xyz"[axis]} <= set(letters)]
    for axis in possible:
        meridian = _about(geometry, axis)
        volume = _turned_volume(meridian)
        if abs(volume - geometry.solid_volume) <= MESH_FILE.volume * geometry.solid_volume:
            return meridian
    raise TurgorError(
        f"'{geometry.name}' is no body of revolution: its section, turned by a quarter, has {volume * 1e9:.6g} mm³, "
        f"the part has {geometry.solid_volume * 1e9:.6g} mm³. Use another kind of cells."
    )


def is_revolved(geometry: Geometry) -> bool:
    """Whether a geometry is a quarter of a body of revolution, which `meridian_of` can read.

    Examples
    --------
    >>> from turgor.core.geometry.actuators.bellows_of_revolution import BellowsOfRevolution
    >>> from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
    >>> is_revolved(BellowsOfRevolution(folds=1).build()), is_revolved(FastPneuNet(chambers=2, length=20e-3).build())
    (True, False)
    """
    try:
        meridian_of(geometry)
    except TurgorError:
        return False
    return True


def _about(geometry: Geometry, axis: int) -> Meridian:
    """The meridian if the part is revolved about an axis."""
    planes = {letter: _position(geometry, letter) for letter in "xyz" if f"symmetry_{letter}" in geometry.faces}
    center = np.array([0.0 if i == axis else planes["xyz"[i]] for i in range(3)])
    across = ["xyz"[i] for i in range(3) if i != axis]
    loops, edges = _loops(geometry, axis, across, center)
    loops.sort(key=lambda loop: (-abs(loop[1].area), loop[0] is not None))
    return Meridian(axis=axis, center=center, fill=tuple(loops), edges=tuple(edges), cut=planes.get("xyz"[axis]))


def _turned_volume(meridian: Meridian) -> float:
    """Volume of the section turned by a quarter [m³], after Pappus."""
    parts = [(name, pi / 2 * outline.centroid[1] * outline.area) for name, outline in meridian.fill]
    return sum(part if name is not None else -part for name, part in parts)


def _position(geometry: Geometry, letter: str) -> float:
    """Where a mirror plane is [m]."""
    face = next(f for f in geometry._cad.faces if f.name == f"symmetry_{letter}")
    return float(getattr(face.center, letter)) * geometry.length_scale


def _loops(
    geometry: Geometry, axis: int, letters: Sequence[str], center: Array
) -> tuple[list[Fill], list[tuple[str, Array]]]:
    """Loops of the section with what is in them, and its edges by the faces that meet there."""
    plane, radial = letters[0], "xyz".index(letters[1])
    scale = geometry.length_scale
    borders = [(face, set(face.edges)) for face in geometry._cad.faces]
    loops: list[Fill] = []
    edges: list[tuple[str, Array]] = []
    for solid in geometry._cad.solids:
        for face in solid.faces:
            if face.name != f"symmetry_{plane}":
                continue
            for number, wire in enumerate(loops_of(face)):
                lines = [_points(edge, axis, radial, center / scale) * scale for edge in wire]
                loops.append((str(solid.name) if number == 0 else None, outline_of(lines)))
                for edge, line in zip(wire, lines, strict=True):
                    names = [
                        str(f.name) for f, owned in borders if edge in owned and not f.name.startswith("symmetry_")
                    ]
                    if names:
                        edges.append((names[0], line))
    return loops, edges


def _points(edge: Any, axis: int, radial: int, center: Array) -> Array:
    """Points of an edge (SAMPLES + 1, 2) along the axis and the radius, in the order of its parameter."""
    points = samples(edge) - center
    return np.stack([points[:, axis], np.abs(points[:, radial])], axis=1)
