"""Markers: named points on or near the surface that are followed along the path, as a camera follows them."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.faces.attached import Attached, attach
from turgor.core.geometry.cad.symmetry.whole import MirrorPlane
from turgor.core.meshing.mesh import Mesh
from turgor.core.results.fields.state_fields import MeshFacts, StateFields
from turgor.core.results.measures.measure import Measure
from turgor.foundation.errors import TurgorError
from turgor.units import mm

Array = NDArray[np.float64]
Point = tuple[float, float, float]

#: A marker may be this far from the surface, as a share of the size of the part; farther ones are mistakes of units.
FARTHEST = 0.25


def marker(name: str, point: Sequence[float]) -> tuple[Measure, Measure, Measure]:
    """Return the coordinates of a marker as measures, as a camera would record them.

    A marker on the surface moves with the point of the surface on which it lies. One next to it, such as a ball on a
    pin, moves with the nearest point of the surface and turns with the surface there. One on the mirror image of a
    modeled half is the image of its mirror image; one outside the modeled sector of a wedge, that of its turned image.

    Parameters
    ----------
    name : str
        The measures are ``NAME_x``, ``NAME_y`` and ``NAME_z``.
    point : (3,) floats [m]
        Where it is at rest.

    Returns
    -------
    tuple of three Measure
        Its coordinates [m], written in mm.

    Raises
    ------
    TurgorError
        If the name or the point cannot be used; when it is read, if it is farther from the surface than a quarter of
        the size of the part.

    Examples
    --------
    >>> [each.name for each in marker("knuckle", (20e-3, 0, 15e-3))]
    ['knuckle_x', 'knuckle_y', 'knuckle_z']
    """
    given = np.asarray(point, dtype=np.float64)
    if given.shape != (3,) or not np.isfinite(given).all():
        raise TurgorError(f"marker '{name}': {point!r} is no point; give three coordinates in meters.")
    known: Point = (float(given[0]), float(given[1]), float(given[2]))
    x, y, z = (
        Measure(
            name=f"{name}_{letter}",
            unit="mm",
            function=partial(_coordinate, name, known, axis),
            definition=f"{letter} coordinate of the marker '{name}', at rest near {_text(given)}",
        )
        for axis, letter in enumerate("xyz")
    )
    return x, y, z


def check_markers(mesh: Mesh, markers: Mapping[str, Point]) -> None:
    """Refuse markers that are too far from a part.

    Parameters
    ----------
    mesh : Mesh
    markers : mapping of str to (3,) floats [m]

    Raises
    ------
    TurgorError
        With the place, the distance and the nearest point of the surface.
    """
    mirrors = MeshFacts(mesh).mirrors
    for name, point in markers.items():
        _attached(mesh, name, point, mirrors)


def _coordinate(name: str, point: Point, axis: int, at: StateFields) -> float:
    fixed = at.facts.once((name, point), partial(_attached, at.mesh, name, point, at.facts.mirrors))
    return float(fixed.position(at.mesh.points + at.displacement)[axis])


def _attached(mesh: Mesh, name: str, point: Point, planes: tuple[MirrorPlane, ...]) -> Attached:
    """Find where a marker is fixed."""
    fixed = attach(mesh, point, planes)
    away, size = float(np.linalg.norm(fixed.arm)), float(np.ptp(mesh.points, axis=0).max())
    if away > FARTHEST * size:
        foot = replace(fixed, arm=np.zeros(3), mirrored=np.ones(3)).position(mesh.points)
        raise TurgorError(
            f"marker '{name}' at {_text(np.array(point))} is {away / mm:.4g} mm from the surface, whose nearest point "
            f"is {_text(foot)}; a marker lies on the surface or within {FARTHEST * size / mm:.3g} mm of it."
        )
    return fixed


def _text(point: Array) -> str:
    return f"({', '.join(f'{value / mm:.4g}' for value in point)}) mm"
