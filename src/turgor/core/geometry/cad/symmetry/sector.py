"""Cut one sector out of a CAD part that is the same after each of n turns about an axis."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from turgor.core.geometry import occ
from turgor.core.geometry.cad.facets import find_facets
from turgor.core.geometry.cad.part import Part, with_shape
from turgor.core.geometry.cad.symmetry.settings import SYMMETRY
from turgor.core.geometry.shapes.tolerances import TOLERANCE
from turgor.core.geometry.wedge import HIGH, LOW, Wedge
from turgor.foundation.errors import TurgorError
from turgor.units import mm

Array = NDArray[np.float64]


def sector(part: Part, names: Sequence[str], wedge: Wedge) -> tuple[Part, tuple[str, ...]]:
    """Cut one sector out of a part.

    Parameters
    ----------
    part : Part
        The whole part.
    names : sequence of str
        Name of each of its faces.
    wedge : Wedge
        Its center in meters.

    Returns
    -------
    part, names
        The sector; its cut faces are named ``cyclic_low`` and ``cyclic_high``.

    Raises
    ------
    TurgorError
        If the sector is not one of n equal ones.
    """
    center = np.array(wedge.center) / mm
    start = cut_angle(part, wedge)
    for face, name in zip(part.faces, names, strict=True):
        face.name = name
    outside = _half_spaces(wedge, center, start)
    pieces: list[Any] = []
    for solid in part.shape.solids:
        remaining = solid
        for beyond in outside:
            remaining = remaining - beyond
        for piece in list(remaining.solids):
            piece.name = str(solid.name)
            pieces.append(piece)
    whole, own = (sum(float(solid.mass) for solid in each) for each in (part.shape.solids, pieces))
    if abs(wedge.fold * own - whole) > TOLERANCE.volume * whole:
        raise TurgorError(
            f"symmetry: a sector of 1/{wedge.fold} of '{part.path}' about {wedge.axis} has {own:.6g} mm³, which is not "
            f"1/{wedge.fold} of {whole:.6g} mm³; the part is not the same after such a turn."
        )
    return _named(part, occ.Glue(pieces), wedge, start)


def cut_angle(part: Part, wedge: Wedge) -> float:
    """Angle about the axis at which the sector begins [rad].

    Cuts run halfway between corners, so that they leave no slivers. Of several such places those with the largest
    radius are taken, where lobes have their crests: walls that face each other between lobes stay in one sector. Of
    several crests the one with the least surface is taken, where no chamber is cut.
    """
    center = np.array(wedge.center) / mm
    b, c = wedge.across
    vertices = np.array([[getattr(v.p, letter) for letter in "xyz"] for v in part.shape.vertices]) - center
    size = float(np.ptp(part.facets.points, axis=0).max())
    vertices = vertices[np.hypot(vertices[:, b], vertices[:, c]) > TOLERANCE.round_off * size]
    angles = np.unique(np.round(np.arctan2(vertices[:, c], vertices[:, b]) % wedge.angle, 6))
    ends = angles if len(angles) else np.zeros(1)
    gaps = np.diff(np.append(ends, ends[0] + wedge.angle))
    middles = (ends + gaps / 2)[gaps >= SYMMETRY.wide * gaps.max()]
    spots = part.facets.corners().mean(axis=1) - center
    corners = part.facets.corners() - center
    area = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    turned = np.arctan2(spots[:, c], spots[:, b]) % wedge.angle
    radius = np.hypot(corners[..., b], corners[..., c]).max(axis=1)
    best = []
    for middle in middles:
        off = np.abs((turned - middle + wedge.angle / 2) % wedge.angle - wedge.angle / 2)
        near = off <= max(0.05 * wedge.angle, float(off.min()))
        best.append((float(radius[near].max()), -float(area[near].sum())))
    largest = max(each[0] for each in best)
    chosen = max(range(len(best)), key=lambda i: (best[i][0] >= (1 - SYMMETRY.alike) * largest, best[i][1]))
    return float(middles[chosen])


def cut_pairs(shape: Any, wedge: Wedge, scale: float) -> list[tuple[Any, Any]]:
    """Pair the faces of a sector in its lower cut with their images in the higher one.

    Parameters
    ----------
    shape : CAD shape
        With the names of its faces.
    wedge : Wedge
    scale : float [m]
        Length of one CAD unit.

    Raises
    ------
    TurgorError
        If the sections at both cuts are not the same.
    """
    low, high = ([face for face in dict.fromkeys(shape.faces) if face.name == name] for name in (LOW, HIGH))
    places = np.array([[face.center.x, face.center.y, face.center.z] for face in high]).reshape(-1, 3) * scale
    images = wedge.images(np.array([[f.center.x, f.center.y, f.center.z] for f in low]).reshape(-1, 3) * scale)
    size = TOLERANCE.volume * float(np.ptp([tuple(corner) for corner in shape.bounding_box], axis=0).max()) * scale
    pairs = []
    for face, image in zip(low, images, strict=True):
        away = np.linalg.norm(places - image, axis=1)
        fits = [i for i in np.argsort(away) if away[i] <= size and _same_area(face, high[i])]
        if not fits:
            break
        pairs.append((face, high[fits[0]]))
    if not low or len(low) != len(high) or len({id(other) for _, other in pairs}) < len(high):
        raise TurgorError(
            f"symmetry: the sections of the part at both cuts of a wedge of 1/{wedge.fold} about {wedge.axis} differ "
            f"({len(low)} and {len(high)} faces); the part is not the same after such a turn."
        )
    return pairs


def cut_turn(wedge: Wedge, scale: float) -> Any:
    """The turn from the lower cut to the higher one, as the CAD kernel takes it; one CAD unit has ``scale`` meters."""
    x, y, z = (value / scale for value in wedge.center)
    return occ.gp_Trsf.Rotation(occ.Axis(occ.Pnt(x, y, z), (occ.X, occ.Y, occ.Z)[wedge.number]), 360 / wedge.fold)


def _same_area(face: Any, other: Any) -> bool:
    return abs(float(face.mass) - float(other.mass)) <= TOLERANCE.volume * float(face.mass)


def _half_spaces(wedge: Wedge, center: Array, start: float) -> list[Any]:
    """Half spaces beyond the two cuts of a sector that begins at an angle."""
    beyond = []
    for angle, side in ((start, 1.0), (start + wedge.angle, -1.0)):
        normal = np.zeros(3)
        normal[list(wedge.across)] = -side * np.sin(angle), side * np.cos(angle)
        beyond.append(occ.HalfSpace(occ.Pnt(*map(float, center)), occ.Vec(*map(float, normal))))
    return beyond[:1] if wedge.fold == 2 else beyond


def _named(part: Part, shape: Any, wedge: Wedge, start: float) -> tuple[Part, tuple[str, ...]]:
    """The sector, whose faces in the cuts are named."""
    faces = list(dict.fromkeys(shape.faces))
    facets = find_facets(shape, faces)
    tolerance = TOLERANCE.round_off * float(np.ptp(facets.points, axis=0).max())
    names = []
    for i, face in enumerate(faces):
        arms = (
            facets.corners(np.array([i]))[..., list(wedge.across)] - (np.array(wedge.center) / mm)[list(wedge.across)]
        )
        name = str(face.name)
        for cut, angle in ((LOW, start), (HIGH, start + wedge.angle)):
            across = arms @ np.array([-np.sin(angle), np.cos(angle)])
            along = arms @ np.array([np.cos(angle), np.sin(angle)])
            if np.abs(across).max() < tolerance and along.max() > tolerance:
                if along.min() < -tolerance:
                    raise TurgorError(
                        f"symmetry: a wedge of 1/2 of '{part.path}' is cut through its axis {wedge.axis}, where "
                        "one face would be its own image; model the whole part, or use a mirror plane."
                    )
                name = cut
        names.append(name)
        face.name = name
    cut_pairs(shape, wedge, mm)
    return with_shape(part, shape, faces, facets), tuple(names)
