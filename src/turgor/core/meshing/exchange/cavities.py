"""Cavities that come as a surface of their own: which sides of the mesh lie on it."""

from itertools import permutations, product
from pathlib import Path

import numpy as np

from turgor.core.meshing.exchange.boundary import Sides, components, enclosed_volume, is_cavity, rim
from turgor.core.meshing.exchange.formats.raw import Array, Ints
from turgor.core.meshing.exchange.formats.stl import Triangles, read_stl
from turgor.core.meshing.exchange.frame import Frame
from turgor.core.meshing.exchange.settings import MESH_FILE
from turgor.foundation.errors import TurgorError
from turgor.foundation.finding import Finding, Severity
from turgor.units import mm

#: Distances computed together, so that a large mesh does not need gigabytes.
CHUNK = 400_000


def sides_on_stl(sides: Sides, name: str, path: str | Path, frame: Frame, mirrors: list[Ints]) -> tuple[Ints, Finding]:
    """Find the boundary sides that lie on the surface of a cavity.

    Parameters
    ----------
    sides : Sides
    name : str
        Name of the cavity.
    path : str or Path
        STL file of its surface.
    frame : Frame
        Unit and axes of that file, the same as those of the mesh.
    mirrors : list of int arrays
        Sides of each mirror plane.

    Returns
    -------
    rows : (f,) int array
        Rows of ``sides.nodes``.
    finding : Finding
        G23: how far they lie from the surface, and how the volumes compare.

    Raises
    ------
    TurgorError
        If the mesh has no boundary there.
    """
    given = read_stl(path)
    surface = Triangles(points=frame.meters(given.points), triangles=given.triangles)
    outer = np.flatnonzero(sides.outer)
    off = side_distances(sides, outer, surface)
    edge = np.sqrt(2 * np.linalg.norm(sides.vector_areas[outer], axis=1))
    rows = outer[off <= MESH_FILE.on_surface * edge]
    extent = float(np.ptp(surface.points, axis=0).max())
    exact = len(rows) > 0 and is_cavity(sides, rows, mirrors)
    if not exact:
        inner = [part for part in components(sides, outer) if is_cavity(sides, part, mirrors)]
        worst = [float(side_distances(sides, part, surface).max()) for part in inner]
        if inner and min(worst) <= MESH_FILE.near * extent:
            rows = inner[int(np.argmin(worst))]
        elif _is_pocket(sides, rows, surface):
            exact = True
        else:
            raise _nowhere(sides, name, path, surface, inner, worst)
    distance = float(side_distances(sides, rows, surface).max())
    return rows, _compared(sides, name, path, rows, distance, abs(surface.volume), exact)


def _is_pocket(sides: Sides, rows: Ints, surface: Triangles) -> bool:
    """Whether sides are most of the walls of a surface, which the mesh leaves open, such as at an inlet."""
    if not len(rows):
        return False
    walls = float(np.linalg.norm(sides.vector_areas[rows], axis=1).sum())
    whole = float(np.linalg.norm(np.cross(*_spans(surface)), axis=1).sum()) / 2
    return (
        walls > MESH_FILE.pocket * whole
        and enclosed_volume(sides, rows, sides.points[rim(sides, rows)].mean(axis=(0, 1))) < 0
    )


def _spans(surface: Triangles) -> tuple[Array, Array]:
    corners = surface.points[surface.triangles]
    return corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]


def _compared(
    sides: Sides, name: str, path: str | Path, rows: Ints, distance: float, volume: float, exact: bool
) -> Finding:
    ends = rim(sides, rows)
    enclosed = -enclosed_volume(sides, rows, sides.points[ends].mean(axis=(0, 1)) if len(ends) else sides.points[0])
    return Finding(
        code="G23",
        severity=Severity.NOTE if exact else Severity.WARNING,
        message=f"The cavity '{name}' lies on the surface of '{Path(path).name}' with {len(rows)} sides, at most "
        f"{distance / mm:.3g} mm away; it holds {enclosed / mm**3:.5g} mm³, the surface {volume / mm**3:.5g} mm³.",
        advice="They fit each other."
        if exact
        else "The nearest inner surface of the mesh was taken, and its shape is what counts; check that both files "
        "show the same part.",
    )


def _nowhere(
    sides: Sides, name: str, path: str | Path, surface: Triangles, inner: list[Ints], worst: list[float]
) -> TurgorError:
    start = f"no inner surface of the mesh lies on the cavity '{name}' of '{path}'"
    if not inner:
        nearest = distances(surface.points, _boundary(sides))
        if (nearest < MESH_FILE.near * float(np.ptp(surface.points, axis=0).max())).mean() > MESH_FILE.pocket:
            return TurgorError(
                f"{start}: its walls there are open, and up to {float(nearest.max()) / mm:.3g} mm away from it; name "
                "these walls as a face of the mesh instead."
            )
        return TurgorError(
            f"{start}: the mesh has no closed inner surface at all, it is solid there; mesh the outer surface together "
            "with the cavity (mesh_surfaces), or export the volume mesh with the cavity cut out."
        )
    hint = _axes_hint([sides.points[np.unique(sides.nodes[part])] for part in inner], surface.points)
    return TurgorError(f"{start}: the nearest one is {min(worst) / mm:.3g} mm away{hint or '; check units and place'}.")


def _boundary(sides: Sides) -> Triangles:
    """The boundary of the mesh as triangles."""
    corners = sides.corners[sides.outer]
    return Triangles(
        points=sides.points, triangles=np.vstack([corners[:, [0, i, i + 1]] for i in range(1, corners.shape[1] - 1)])
    )


def _axes_hint(parts: list[Array], points: Array) -> str:
    """Say which axes to exchange so that the boxes around both agree, if that is the trouble."""
    low, high = points.min(axis=0), points.max(axis=0)
    for order, signs in product(permutations(range(3)), product((1, -1), repeat=3)):
        turned = np.sort(np.stack([low, high])[:, order] * signs, axis=0)
        for part in parts:
            box = np.stack([part.min(axis=0), part.max(axis=0)])
            if np.abs(box - turned).max() <= MESH_FILE.near * float(np.ptp(points, axis=0).max()):
                axes = ", ".join(f"{'-' if s < 0 else ''}{'xyz'[o]}" for s, o in zip(signs, order, strict=True))
                return f"; it fits with the axes of the STL file taken as ({axes})"
    return ""


def side_distances(sides: Sides, rows: Ints, surface: Triangles) -> Array:
    """How far each side lies from a surface: the largest distance of its corners and middle, (f,) [m]."""
    nodes, place = np.unique(sides.corners[rows], return_inverse=True)
    positions = sides.positions[rows]
    at_nodes = distances(sides.points[nodes], surface)[np.asarray(place).reshape(len(rows), -1)]
    return np.asarray(np.maximum(at_nodes.max(axis=1), distances(positions.mean(axis=1), surface)))


def distances(points: Array, surface: Triangles) -> Array:
    """Distance of points (n, 3) to the nearest place on a surface, (n,)."""
    corners = surface.points[surface.triangles]
    nearest = np.empty(len(points))
    step = max(1, CHUNK // max(1, len(corners)))
    for start in range(0, len(points), step):
        nearest[start : start + step] = _to_triangles(points[start : start + step, None], corners[None]).min(axis=1)
    return nearest


def _to_triangles(points: Array, corners: Array) -> Array:
    """Distances of points (n, 1, 3) to triangles (1, f, 3, 3)."""
    nearest = np.full((len(points), corners.shape[1]), np.inf)
    for i in range(3):
        a, b = corners[..., i, :], corners[..., (i + 1) % 3, :]
        along = b - a
        t = np.einsum("...i,...i->...", points - a, along) / np.einsum("...i,...i->...", along, along)
        offset = points - a - np.clip(t, 0, 1)[..., None] * along
        nearest = np.minimum(nearest, np.linalg.norm(offset, axis=-1))
    a, u, v = corners[..., 0, :], corners[..., 1, :] - corners[..., 0, :], corners[..., 2, :] - corners[..., 0, :]
    normal = np.cross(u, v)
    square = np.einsum("...i,...i->...", normal, normal)
    w = points - a
    r = np.einsum("...i,...i->...", np.cross(u, w), normal) / square
    s = np.einsum("...i,...i->...", np.cross(w, v), normal) / square
    inside = (r >= 0) & (s >= 0) & (r + s <= 1)
    height = np.abs(np.einsum("...i,...i->...", w, normal)) / np.sqrt(square)
    return np.where(inside, np.minimum(height, nearest), nearest)
