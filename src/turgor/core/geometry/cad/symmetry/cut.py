"""Cut a named CAD part at mirror planes and keep the side toward positive coordinates, or cut a sector out of it."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from turgor.core.geometry import occ
from turgor.core.geometry.cad.facets import find_facets
from turgor.core.geometry.cad.part import Part, with_shape
from turgor.core.geometry.cad.surface.shape import SurfaceShape
from turgor.core.geometry.cad.symmetry.facet_cut import facet_half, facet_symmetry
from turgor.core.geometry.cad.symmetry.find import MirrorPlane, PartSymmetry, find_symmetry
from turgor.core.geometry.cad.symmetry.modeled_share import Modeled
from turgor.core.geometry.cad.symmetry.requested import RequestedSymmetry
from turgor.core.geometry.cad.symmetry.wedges import cut_to_wedge, requested_wedge, smaller_wedge
from turgor.core.geometry.shapes.tolerances import TOLERANCE
from turgor.foundation.errors import TurgorError
from turgor.foundation.finding import Finding, Severity


def modeled_part(part: Part, names: Sequence[str], requested: RequestedSymmetry) -> Modeled:
    """Cut a part at the mirror planes, or to the wedge, that are requested and that it has.

    Parameters
    ----------
    part : Part
        The whole part.
    names : sequence of str
        Name of each of its faces.
    requested : RequestedSymmetry

    Returns
    -------
    Modeled
        The half, quarter, eighth or sector.

    Raises
    ------
    TurgorError
        If what is requested by name does not map the part onto itself.
    """
    if not requested.automatic and not requested.normals and not requested.wedge:
        return Modeled(part=part, names=tuple(names))
    facets = isinstance(part.shape, SurfaceShape)
    if facets and requested.wedge:
        raise TurgorError(
            f"symmetry: '{part.path}' is given by facets, and is cut at mirror planes only, not to a wedge: "
            'use "automatic" or "y", or export STEP.'
        )
    symmetry = facet_symmetry(part, names) if facets else find_symmetry(part, names)
    if requested.wedge:
        return cut_to_wedge(part, names, requested_wedge(part, names, symmetry, requested.fold))
    used, refused = _chosen(part, symmetry, requested)
    smaller = smaller_wedge(part, names, symmetry, requested, 2 ** len(used)) if requested.automatic else None
    if smaller is not None:
        return cut_to_wedge(part, names, smaller)
    for plane in used:
        part, names = facet_half(part, names, plane) if facets else _half(part, names, plane)
    return Modeled(part=part, names=tuple(names), findings=(_finding(used, refused),))


def _chosen(
    part: Part, symmetry: PartSymmetry, requested: RequestedSymmetry
) -> tuple[list[MirrorPlane], dict[str, str]]:
    """The planes to cut at, and why the others are not used."""
    mirrors = {plane.normal: plane for plane in symmetry.mirrors}
    if not requested.automatic:
        for letter in requested.normals:
            _check_has(part, letter, mirrors)
            if letter in requested.broken:
                raise TurgorError(
                    f"symmetry: the mirror plane across {letter} cannot be used: {requested.broken[letter]}."
                )
        return [mirrors[letter] for letter in requested.normals], {}
    used, refused = [], {}
    for letter, plane in mirrors.items():
        if letter in requested.broken:
            refused[letter] = requested.broken[letter]
        elif any({"fixed", "tip"} & set(pair) for pair in plane.joined):
            continue  # the ends are fixed and moved differently, so a plane between them is not reported
        elif plane.joined:
            refused[letter] = (
                f"it maps '{plane.joined[0][0]}' onto '{plane.joined[0][1]}', which have names of their own"
            )
        else:
            used.append(plane)
    return used, refused


def _check_has(part: Part, letter: str, mirrors: dict[str, MirrorPlane]) -> None:
    if letter not in mirrors:
        there = ", ".join(mirrors) or "none"
        raise TurgorError(
            f"symmetry: '{part.path}' is not the same on both sides of a plane across {letter}; its mirror planes are "
            f"across: {there}."
        )
    joined = mirrors[letter].joined
    if joined:
        raise TurgorError(
            f"symmetry: the mirror plane across {letter} maps '{joined[0][0]}' onto '{joined[0][1]}'; give both the "
            "same name to model a half."
        )


def _half(part: Part, names: Sequence[str], plane: MirrorPlane) -> tuple[Part, tuple[str, ...]]:
    """The side of a part above a plane, with the names of its faces."""
    axis = "xyz".index(plane.normal)
    point, normal = np.zeros(3), np.zeros(3)
    point[axis], normal[axis] = plane.position, 1.0
    for face, name in zip(part.faces, names, strict=True):
        face.name = name
    below = occ.HalfSpace(occ.Pnt(*map(float, point)), occ.Vec(*map(float, normal)))
    pieces: list[Any] = []
    for solid in part.shape.solids:
        halves = list((solid - below).solids)
        for piece in halves:
            piece.name = str(solid.name)
        pieces += halves
    before, after = (sum(float(solid.mass) for solid in each) for each in (part.shape.solids, pieces))
    if abs(2 * after - before) > TOLERANCE.volume * before:
        raise TurgorError(
            f"symmetry: the sides of the plane {plane.normal} = {plane.position:.6g} mm of '{part.path}' have "
            f"{after:.6g} and {before - after:.6g} mm³; they are not mirror images."
        )
    return _named(part, occ.Glue(pieces), axis, plane)


def _named(part: Part, shape: Any, axis: int, plane: MirrorPlane) -> tuple[Part, tuple[str, ...]]:
    """The cut part, whose faces in the plane are named after it."""
    faces = list(dict.fromkeys(shape.faces))
    facets = find_facets(shape, faces)
    size = float(np.ptp(facets.points, axis=0).max())
    names = []
    for i, face in enumerate(faces):
        at = facets.corners(np.array([i]))[..., axis]
        on = float(np.abs(at - plane.position).max()) < TOLERANCE.round_off * size
        names.append(f"symmetry_{plane.normal}" if on else str(face.name))
        face.name = names[-1]
    return with_shape(part, shape, faces, facets), tuple(names)


def _finding(used: Sequence[MirrorPlane], refused: dict[str, str]) -> Finding:
    """Say what is modeled."""
    share = {0: "The whole part", 1: "Half of the part", 2: "A quarter of the part", 3: "An eighth of the part"}
    planes = " and ".join(f"{plane.normal} = {plane.position + 0.0:.4g} mm" for plane in used)
    at = f", cut at the mirror plane{'s' if len(used) > 1 else ''} {planes}" if used else ""
    rest = "".join(f" The mirror plane across {letter} is not used: {reason}." for letter, reason in refused.items())
    return Finding(
        code="D07",
        severity=Severity.NOTE,
        message=f"{share[len(used)]} is modeled{at}.{rest}",
        advice="Volumes, forces and pictures are those of the whole. A half cannot buckle to the side; "
        'symmetry = "none" models the whole part.',
    )
