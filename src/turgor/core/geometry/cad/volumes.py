"""Exact volumes of hollows: the CAD kernel integrates over the true faces, which facets only approximate."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from turgor.core.geometry import occ
from turgor.core.geometry.cad.cavities import Hollow, Opening, chains, rim
from turgor.core.geometry.cad.facets import Facets, Mirror, flux
from turgor.core.geometry.cad.surface.shape import SurfaceFace
from turgor.core.geometry.shapes.tolerances import TOLERANCE

Array = NDArray[np.float64]

#: Parabolas along each edge of a rim; the area of a circle is then exact to 1e-6.
PIECES = 48

#: Largest error of the volume of facets, as a share. An exact volume that differs by more is not used.
FACETS_MISS = 0.1


def measured(hollow: Hollow, facets: Facets, faces: Sequence[Any], mirrors: Sequence[Mirror]) -> Hollow:
    """Return a hollow with the volume and openings of its true faces.

    Parameters
    ----------
    hollow : Hollow
        Hollow with its faces; volume and openings are computed again.
    facets : Facets
        Surface of the part.
    faces : sequence of CAD faces
        All faces of the part.
    mirrors : sequence of (int, float)
        Axis and position of each mirror plane [CAD units]; a cavity is not open there.

    Returns
    -------
    Hollow
        Hollow of the modeled part. The fan over a rim that a mirror plane cuts starts in that plane.
    """
    chosen = [faces[i] for i in hollow.faces]
    triangles = facets.triangles[np.isin(facets.face, hollow.faces)]
    edges = rim(triangles)
    if isinstance(chosen[0], SurfaceFace):  # facets are all there is
        origin, exact, loops = facets.points.mean(axis=0), None, _facet_loops(facets, edges)
    else:
        origin, exact, loops = _mean_vertex(chosen), _kernel_flux(chosen), rim_loops(chosen)
    walls = drawn = flux(facets.points, triangles, origin)
    if exact is not None:
        walls = min((exact, -exact), key=lambda value: abs(value - drawn))
    total, drawn_total, openings = walls, drawn, []
    for loop in loops:
        apex, free = _apex(loop, mirrors)
        cap = _fan(loop, apex)
        near = edges[_chain_at(facets, edges, loop)]
        drawn_cap = _fan(_straight(facets.points[near[:, 1]], facets.points[near[:, 0]]), apex)
        cap = cap if cap @ drawn_cap >= 0 else -cap
        total += float((apex - origin) @ cap) / 3
        drawn_total += float((apex - origin) @ drawn_cap) / 3
        if free.any():
            area = float(np.linalg.norm(_fan(loop[free], apex)))
            openings.append(Opening(area=area, center=loop[free].mean(axis=(0, 1))))
    volume = total if abs(total - drawn_total) <= FACETS_MISS * abs(drawn_total) else drawn_total
    return Hollow(faces=hollow.faces, volume=-volume, openings=tuple(openings))


def rim_loops(chosen: Sequence[Any]) -> list[Array]:
    """Sample the loops that bound some faces, (k, 3, 3) each: parabolas by their start, middle and end."""
    count: dict[Any, int] = {}
    for face in chosen:
        for edge in face.edges:
            count[edge] = count.get(edge, 0) + 1
    edges = [edge for edge, times in count.items() if times == 1 and edge.mass > TOLERANCE.length]
    if not edges:
        return []
    samples = [_samples(edge) for edge in edges]
    ends = np.array([[line[0], line[-1]] for line in samples]).reshape(-1, 3)
    size = float(np.ptp(ends, axis=0).max()) or 1.0
    _, place = np.unique((ends / (1e-6 * size)).round(), axis=0, return_inverse=True)
    pairs = place.reshape(-1, 2)
    loops = []
    for chain in chains(pairs, closed=False):
        loops.append(_joined([samples[i] for i in chain], pairs[chain]))
    return loops


def _facet_loops(facets: Facets, edges: NDArray[np.int64]) -> list[Array]:
    """The loops that bound some facets, of straight pieces."""
    ends = facets.points[edges]
    return [_straight(ends[chain, 0], ends[chain, 1]) for chain in chains(edges, closed=False)]


def _joined(lines: list[Array], pairs: NDArray[np.int64]) -> Array:
    """Put the lines of one loop in order, head to tail."""
    remaining, out, at = list(range(1, len(lines))), [lines[0]], pairs[0, 1]
    while remaining:
        following = next((i for i in remaining if at in pairs[i]), None)
        if following is None:  # the remaining lines are another loop through the same corner
            following = remaining[0]
            at = pairs[following, 0]
        forward = pairs[following, 0] == at
        out.append(lines[following] if forward else lines[following][::-1])
        at = pairs[following, 1] if forward else pairs[following, 0]
        remaining.remove(following)
    return np.concatenate([np.stack([line[:-1:2], line[1::2], line[2::2]], axis=1) for line in out])


def _samples(edge: Any) -> Array:
    low, high = edge.parameter_interval
    points = [edge.Value(t) for t in np.linspace(low, high, 2 * PIECES + 1)]
    return np.array([[p.x, p.y, p.z] for p in points])


def _mean_vertex(chosen: Sequence[Any]) -> Array:
    """Mean of the ends of all edges of all faces, the reference point of the kernel for an open shell."""
    # the edge at the pole of a sphere has no length and no curve, and the kernel dies when its ends are requested
    edges = [edge for face in chosen for edge in face.edges]
    ends = [p for edge in edges if edge.mass > TOLERANCE.length for p in (edge.start, edge.end)]
    ends += [vertex.p for edge in edges if not edge.mass > TOLERANCE.length for vertex in edge.vertices]
    return np.array([[p.x, p.y, p.z] for p in ends]).mean(axis=0)


def _kernel_flux(chosen: Sequence[Any]) -> float | None:
    """⅓ ∫ (x − mean vertex)·n da over the true faces, up to its sign; None if they are not connected."""
    try:
        shell = occ.Sew(list(chosen))
        whole = len(list(shell.shells)) == 1 or (not list(shell.shells) and len(chosen) == 1)
        return float(occ.Solid(shell).mass) if whole else None
    except (occ.OCCException, RuntimeError, ValueError):
        return None


def _apex(loop: Array, mirrors: Sequence[Mirror]) -> tuple[Array, NDArray[np.bool_]]:
    """Apex of the fan over a loop, and the mask of its pieces outside the mirror planes."""
    tolerance = 1e-6 * float(np.ptp(loop, axis=(0, 1)).max())
    free, cutting = np.ones(len(loop), dtype=bool), []
    for axis, position in mirrors:
        on = (np.abs(loop[:, :, axis] - position) <= tolerance).all(axis=1)
        free &= ~on
        if on.any():
            cutting.append((axis, position))
    length = np.linalg.norm(loop[:, 2] - loop[:, 0], axis=1)
    weight = length * free if free.any() else length
    apex = np.asarray(weight @ loop.mean(axis=1) / weight.sum())
    for axis, position in cutting:
        apex[axis] = position
    return apex, free


def _fan(loop: Array, apex: Array) -> Array:
    """Vector area of the fan from an apex over pieces of a rim, (3,)."""
    start, middle, end = (loop[:, i] - apex for i in range(3))
    curved = np.cross(start, middle) + np.cross(middle, end)
    return np.asarray((4 * curved - np.cross(start, end)).sum(axis=0) / 6)


def _straight(start: Array, end: Array) -> Array:
    return np.stack([start, (start + end) / 2, end], axis=1)


def _chain_at(facets: Facets, edges: NDArray[np.int64], loop: Array) -> NDArray[np.int64]:
    """Boundary edges of the facets whose corners lie on a loop."""
    best, best_chain = np.inf, np.zeros(0, dtype=np.int64)
    for chain in chains(edges, closed=False):
        points = facets.points[np.unique(edges[chain])]
        off = np.linalg.norm(points[:, None] - loop[None, :, 0], axis=2).min(axis=1).max()
        if off < best:
            best, best_chain = off, chain
    return best_chain
