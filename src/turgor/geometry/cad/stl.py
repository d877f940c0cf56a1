"""Reading of STL files, which hold triangles without names, as CAD bodies."""

import re
from pathlib import Path
from typing import Any

import numpy as np
from netgen.occ import Face, Pnt, Segment, Sew, Solid, Wire
from numpy.typing import NDArray

from turgor.errors import TurgorError
from turgor.geometry.cad.facets import find_facets, weld

Array = NDArray[np.float64]
Ints = NDArray[np.int64]

#: Largest number of triangles; sewing more takes minutes, and each triangle would get cells of its own.
MOST_TRIANGLES = 20_000


def stl_solids(path: Path) -> list[Any]:
    """Read a closed STL file as bodies; triangles in one plane become one face.

    Parameters
    ----------
    path : Path
        Text or binary.

    Raises
    ------
    TurgorError
        If it is damaged, open or flat, intersects itself, or has too many triangles.
    """
    corners = read_stl(path)
    if len(corners) > MOST_TRIANGLES:
        raise TurgorError(
            f"'{path}' has {len(corners)} triangles; at most {MOST_TRIANGLES} can be made a body. Export STEP, which "
            "keeps curved walls, or a coarser STL."
        )
    points, triangles = weld(corners.reshape(-1, 3))
    triangles = triangles[(triangles != np.roll(triangles, 1, axis=1)).all(axis=1)]
    if not len(triangles):
        raise TurgorError(f"'{path}' has no body: all of its triangles are flat; export it again.")
    _check_closed(path, points, triangles)
    _check_crossing(path, points, triangles)
    shells = list(Sew([_face(points[triangle]) for triangle in triangles]).shells)
    if not shells:
        raise TurgorError(f"'{path}' has no body: its triangles could not be sewn to one; export STEP instead.")
    solids = sorted((_positive(shell) for shell in shells), key=lambda solid: -solid.mass)
    return _nested(solids)


def read_stl(path: Path) -> Array:
    """Read the triangles of an STL file, text or binary, (t, 3, 3)."""
    content = path.read_bytes()
    count = int.from_bytes(content[80:84], "little") if len(content) >= 84 else -1
    if len(content) == 84 + 50 * count and count > 0:
        kind = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
        with np.errstate(invalid="ignore"):  # damaged numbers are refused below
            corners = np.frombuffer(content, dtype=kind, offset=84)["corners"].astype(np.float64)
    else:
        number = rb"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"
        found = re.findall(rb"vertex\s+(%b)\s+(%b)\s+(%b)" % (number, number, number), content)
        if not content.lstrip().startswith(b"solid") or not found or len(found) % 3:
            raise TurgorError(
                f"'{path}' is no whole STL file: neither text that begins with 'solid' and has three vertices a "
                "triangle nor binary of the length that it states; export it again."
            )
        corners = np.array(found, dtype=np.float64).reshape(-1, 3, 3)
    if not np.isfinite(corners).all():
        raise TurgorError(f"'{path}' has corners that are not finite numbers; export it again.")
    return corners


def _face(corners: Array) -> Any:
    a, b, c = (Pnt(*map(float, corner)) for corner in corners)
    return Face(Wire([Segment(a, b), Segment(b, c), Segment(c, a)]))


def _positive(shell: Any) -> Any:
    """Body within a shell, for either orientation of its triangles, with one face for each plane wall."""
    solid = Solid(shell)
    if solid.mass < 0:
        solid = Solid(shell.Reversed())
    return solid.UnifySameDomain()


def _nested(solids: list[Any]) -> list[Any]:
    """Subtract each shell that lies in an odd number of others from the smallest of them, the largest first."""
    triangles = [_triangles(solid) for solid in solids]
    bodies: dict[int, Any] = {}
    for i, solid in enumerate(solids):
        around = [j for j in range(i) if winding(triangles[i][0].mean(axis=0), triangles[j]) > 0.5]
        if len(around) % 2 == 0:
            bodies[i] = solid
        else:
            bodies[around[-1]] = bodies[around[-1]] - solid
    return [solid for body in bodies.values() for solid in body.solids]


def _triangles(solid: Any) -> Array:
    return find_facets(solid, list(dict.fromkeys(solid.faces))).corners()


def winding(point: Array, triangles: Array) -> float:
    """Return the winding number of a closed surface about a point, 1 inside, 0 outside (van Oosterom, Strackee 1983).

    Examples
    --------
    >>> corners = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1.0]])
    >>> tetrahedron = corners[np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])]
    >>> round(winding(np.full(3, 0.2), tetrahedron), 12)
    1.0
    """
    a, b, c = (triangles[:, i] - point for i in range(3))
    la, lb, lc = (np.linalg.norm(v, axis=1) for v in (a, b, c))
    volume = np.einsum("ti,ti->t", a, np.cross(b, c))
    dots = [np.einsum("ti,ti->t", u, v) * w for u, v, w in ((a, b, lc), (b, c, la), (c, a, lb))]
    return float(np.arctan2(volume, la * lb * lc + sum(dots)).sum() / (2 * np.pi))


def _check_closed(path: Path, points: Array, triangles: Ints) -> None:
    directed = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    edges, count = np.unique(np.sort(directed, axis=1), axis=0, return_counts=True)
    loose = edges[count != 2]
    if len(loose):
        x, y, z = points[loose].mean(axis=(0, 1))
        single, many = int((count == 1).sum()), int((count > 2).sum())
        raise TurgorError(
            f"'{path}' is no closed surface: {single} edges belong to one triangle only and {many} to more than two, "
            f"around ({x:.4g}, {y:.4g}, {z:.4g}) in units of the file; repair it, or export STEP instead."
        )


def _check_crossing(path: Path, points: Array, triangles: Ints) -> None:
    crossing = crossings(points, triangles)
    if len(crossing):
        x, y, z = points[triangles[crossing[0]]].mean(axis=(0, 1))
        raise TurgorError(
            f"'{path}' crosses itself: {len(crossing)} pairs of triangles cut through each other, the first around "
            f"({x:.4g}, {y:.4g}, {z:.4g}) in units of the file; join the bodies in the CAD program (a union), or "
            "export STEP instead."
        )


def crossings(points: Array, triangles: Ints) -> Ints:
    """Find pairs of triangles without a common corner of which an edge of one pierces the other, (p, 2)."""
    low, high = points[triangles].min(axis=1), points[triangles].max(axis=1)
    order = np.argsort(low[:, 0], kind="stable")
    ends = np.searchsorted(low[order, 0], high[order, 0], side="right")
    found = []
    for i in range(len(order)):
        one, others = order[i], order[i + 1 : ends[i]]
        near = ((low[others] <= high[one]) & (high[others] >= low[one])).all(axis=1)
        others = others[near]
        apart = ~np.isin(triangles[others], triangles[one]).any(axis=1)
        found += [(one, other) for other in others[apart]]
    pairs = np.array(found, dtype=np.int64).reshape(-1, 2)
    pierced = np.zeros(len(pairs), dtype=bool)
    for edges_of, walls in ((0, 1), (1, 0)):
        a, b, c = (points[triangles[pairs[:, walls], i]] for i in range(3))
        for i in range(3):
            p = points[triangles[pairs[:, edges_of], i]]
            q = points[triangles[pairs[:, edges_of], (i + 1) % 3]]
            pierced |= _pierces(p, q, a, b, c)
    return pairs[pierced]


def _pierces(p: Array, q: Array, a: Array, b: Array, c: Array) -> NDArray[np.bool_]:
    """Whether each segment from p to q intersects the interior of its triangle."""

    def side(u: Array, v: Array, w: Array, x: Array) -> Array:
        return np.asarray(np.einsum("pi,pi->p", np.cross(v - u, w - u), x - u))

    size = np.linalg.norm(b - a, axis=1) * np.linalg.norm(c - a, axis=1) * np.linalg.norm(q - p, axis=1)
    slack = 1e-9 * size
    s, t = side(a, b, c, p), side(a, b, c, q)
    through = (np.minimum(s, t) < -slack) & (np.maximum(s, t) > slack)
    u, v, w = side(p, q, a, b), side(p, q, b, c), side(p, q, c, a)
    inside = (np.minimum(np.minimum(u, v), w) > slack) | (np.maximum(np.maximum(u, v), w) < -slack)
    return through & inside
