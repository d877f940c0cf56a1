"""Repair of surfaces from prints and scans: double and flat facets, holes, wrong orientation, bodies that overlap."""

from dataclasses import dataclass

import numpy as np
from manifold3d import Manifold, Mesh64, OpType
from numpy.typing import NDArray

from turgor.core.geometry.cad.facets import weld
from turgor.core.geometry.cad.surface.crossing import crossings
from turgor.core.geometry.cad.surface.holes import close_holes
from turgor.core.geometry.cad.surface.orientation import oriented_shells, shells_of
from turgor.core.geometry.cad.surface.settings import SURFACE
from turgor.foundation.errors import TurgorError
from turgor.foundation.finding import Finding, Severity

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Repaired:
    """A closed surface.

    Parameters
    ----------
    points : (n, 3) array
    triangles : (t, 3) int array
        With the normal out of the solid.
    crossing : int
        Pairs of facets that cut through each other.
    findings : tuple of Finding
        What was repaired.
    """

    points: Array
    triangles: Ints
    crossing: int
    findings: tuple[Finding, ...]


def repaired(corners: Array, name: str) -> Repaired:
    """Make a closed surface of the triangles of a file.

    Corners at the same place become one. Flat facets are removed, and so are facets that lie on each other. Holes with
    a plane rim are closed. All normals point out of the solid: a shell within another one is a cavity. Shells that
    overlap are united.

    Parameters
    ----------
    corners : (t, 3, 3) array
    name : str
        Name of the file, for messages.

    Raises
    ------
    TurgorError
        If nothing is left, a hole is neither plane nor small, or shells cannot be united.
    """
    points, triangles = weld(corners.reshape(-1, 3))
    whole = (triangles != np.roll(triangles, 1, axis=1)).all(axis=1)
    triangles, doubles = _single(triangles[whole])
    if not len(triangles):
        raise TurgorError(f"'{name}' has no body: all of its triangles are flat or lie on each other; export it again.")
    count = len(triangles)
    points, triangles, holes = close_holes(points, triangles, name)
    shells = int(shells_of(triangles).max()) + 1
    if shells > SURFACE.most_shells:
        raise TurgorError(
            f"'{name}' has {shells} shells that are not joined to each other; at most {SURFACE.most_shells} can be "
            "read. Export the part as one closed surface with its cavities."
        )
    turned, overlapping = oriented_shells(points, triangles)
    wrong = int((turned != triangles)[:count].any(axis=1).sum())
    flipped = min(wrong, count - wrong)
    if overlapping:
        points, turned = _united(points, turned, name)
    crossing = len(crossings(points, turned))
    more = " and more" if len(holes) > 3 else ""
    repairs = [
        (doubles, f"{_count(doubles, 'facet')} removed that lay on another one"),
        (flipped, f"{_count(flipped, 'facet')} turned over whose normal pointed the wrong way"),
        (len(holes), f"{_count(len(holes), 'hole')} closed, {', '.join(holes[:3])}{more}"),
        (overlapping, f"{_count(overlapping, 'shell')} united that overlap"),
        (crossing, f"{_count(crossing, 'pair')} of facets left that cut through each other: the mesh ignores them"),
    ]
    findings = _findings(name, [text for number, text in repairs if number])
    return Repaired(points=points, triangles=turned, crossing=crossing, findings=findings)


def _count(number: int, what: str) -> str:
    return f"{number} {what}{'' if number == 1 else 's'}"


def _findings(name: str, repairs: list[str]) -> tuple[Finding, ...]:
    if not repairs:
        return ()
    return (
        Finding(
            code="D06",
            severity=Severity.NOTE,
            message=f"The surface of '{name}' was repaired: {'; '.join(repairs)}.",
            advice="Look at a picture of the part to see that it is the one that you mean.",
        ),
    )


def _single(triangles: Ints) -> tuple[Ints, int]:
    """Remove double facets: one of two that look the same way stays, none of two that look opposite ways."""
    key = np.sort(triangles, axis=1)
    _, first, group, count = np.unique(key, axis=0, return_index=True, return_inverse=True, return_counts=True)
    group = np.asarray(group).ravel()
    even = np.array([1, -1])[(_parity(triangles) == 1).astype(int)]
    sense = np.bincount(group, weights=even)
    single = first[(count == 1) | (sense != 0)]
    return triangles[np.sort(single)], len(triangles) - len(single)


def _parity(triangles: Ints) -> Ints:
    """Whether the corners of each triangle are an even (0) or odd (1) permutation of their sorted order."""
    a, b, c = triangles.T
    return np.asarray(((a > b).astype(int) + (b > c) + (a > c)) % 2)


def _united(points: Array, triangles: Ints, name: str) -> tuple[Array, Ints]:
    """Unite the solid shells and subtract the cavities, which look inward."""
    shell = shells_of(triangles)
    solids: list[Manifold] = []
    voids: list[Manifold] = []
    for number in range(int(shell.max()) + 1):
        own = triangles[shell == number]
        nodes, places = np.unique(own, return_inverse=True)
        own = places.reshape(-1, 3)
        hollow = _volume(points[nodes], own) < 0
        closed = manifold(points[nodes], own[:, ::-1] if hollow else own, name)
        (voids if hollow else solids).append(closed)
    body = Manifold.batch_boolean(solids, OpType.Add)
    if voids:
        body = body - Manifold.batch_boolean(voids, OpType.Add)
    mesh = body.to_mesh64()
    corners = np.asarray(mesh.vert_properties)[:, :3][np.asarray(mesh.tri_verts).astype(np.int64)]
    points, triangles = weld(corners.reshape(-1, 3))
    return points, triangles[(triangles != np.roll(triangles, 1, axis=1)).all(axis=1)]


def manifold(points: Array, triangles: Ints, name: str) -> Manifold:
    """Return a closed surface as a body for booleans."""
    body = Manifold(Mesh64(np.ascontiguousarray(points), np.ascontiguousarray(triangles.astype(np.uint64))))
    if body.is_empty():
        reason = str(body.status()).rsplit(".", 1)[-1]
        raise TurgorError(
            f"the shells of '{name}' overlap and cannot be united ({reason}); join the bodies in the CAD program."
        )
    return body


def _volume(points: Array, triangles: Ints) -> float:
    a, b, c = (points[triangles[:, i]] for i in range(3))
    return float(np.einsum("ti,ti->", a, np.cross(b, c)) / 6)
