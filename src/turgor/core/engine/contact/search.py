"""Search: which side each point of a surface would touch first.

A side is a partner of a point if the two face each other across a gap, or if the point lies a little inside of it: no
deeper than a share of the cells there, so that the far face of a wall is not taken for a neighbor. The nearest foot
point wins.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numba import njit
from numpy.typing import NDArray

from turgor.core.engine.compiled import INNER, LOOP, calls, over
from turgor.core.engine.contact import closest
from turgor.core.engine.contact.closest import foot_point, overhang, unit_cross
from turgor.core.engine.contact.settings import CONTACT_SEARCH

Array = NDArray[np.float64]
Ints = NDArray[np.int64]

#: Two sides can touch where the cosine between their normals is below this.
OPPOSED = -0.3

#: A point keeps its partner as long as the foot point is no further than this beyond a smooth edge of it: where two
#: sides join in a kink, a point right above it would change from one to the other forever.
HOLD = 0.02


@dataclass(frozen=True, slots=True, eq=False)
class Grid:
    """Sides sorted into cubes of space by their centers.

    Parameters
    ----------
    low : (3,) array
    edge : float
        Edge length of a cube.
    counts : (3,) int array
        Cubes along each axis.
    start : (cubes + 1,) int array
        Where the sides of each cube begin in ``order``.
    order : (sides,) int array
    """

    low: Array
    edge: float
    counts: Ints
    start: Ints
    order: Ints

    @staticmethod
    def of(centers: Array, edge: float) -> "Grid":
        """Sort sides by their centers into cubes of at least the edge length."""
        low = centers.min(axis=0)
        span = np.ptp(centers, axis=0)
        while True:
            counts = (span / edge).astype(np.int64) + 1
            if counts.prod() <= CONTACT_SEARCH.most_cubes:
                break
            edge *= 1.5
        place = np.minimum(((centers - low) / edge).astype(np.int64), counts - 1)
        key = (place[:, 0] * counts[1] + place[:, 1]) * counts[2] + place[:, 2]
        order = np.argsort(key, kind="stable")
        start = np.searchsorted(key[order], np.arange(counts.prod() + 1))
        return Grid(low, float(edge), counts, start, order)


@njit(**LOOP)
@calls(closest)
def _find_partners(begin, end, out, looking, position, sides, about, grid, allowed, reach, apart):
    partner, at, gap = out
    own, other = about
    x, n = looking
    depth, radii = allowed[1], other[1]
    points, near = x.shape[1], np.empty(len(radii), dtype=np.int64)
    for k in range(begin, end):
        nearby = _near_sides(k, own, other, grid, depth, reach, apart, near)
        if nearby == 0:
            continue
        some, far = np.empty(nearby, dtype=np.int64), np.empty(nearby)
        for q in range(points):
            few, bound = _near_point(x[k, q], n[k, q], other, depth, reach, near[:nearby], some, far)
            if few > 0:
                best = (x[k, q], n[k, q], some[:few], far[:few], bound)
                partner[k, q], at[k, q, 0], at[k, q, 1], gap[k, q] = _nearest(
                    best, position, sides, radii, allowed, reach
                )


def find_partners(
    looking: tuple[Array, Array],
    position: Array,
    sides: Ints,
    about: tuple[Any, Any],
    grid: tuple[Any, ...],
    allowed: tuple[Array, Array],
    reach: float,
    apart: tuple[NDArray[np.bool_], NDArray[np.bool_], Ints, Ints],
) -> tuple[Ints, Array, Array]:
    """Nearest partner of every point: side (s, q), −1 for none; its place (s, q, 2); signed gap (s, q), inf for none.

    ``looking`` holds positions and normals of the points; ``about`` holds centers, radii and normals of their sides,
    then of the partner sides; ``grid`` low, edge, counts, start, order; ``allowed`` the overhang allowed over each edge
    of a side and the depth allowed behind it; ``apart`` says which sides of the points and of the partners are open,
    and lists for each side of the points, in rows, sorted, the exceptions (start, list): two open sides may touch, two
    others may not.
    """
    points = looking[0].shape[:2]
    out = np.full(points, -1, dtype=np.int64), np.zeros((*points, 2)), np.full(points, np.inf)
    over(len(looking[0]), _find_partners, out, looking, position, sides, about, grid, allowed, reach, apart)
    return out


@njit(**INNER)
def _near_sides(k, own, other, grid, depth, reach, apart, near):
    """Fill the sides that points of side k may touch, and return how many."""
    (center, radius, normal), (others, radii, normals) = own, other
    low, edge, counts, start, order = grid
    open_own, open_other, first, exceptions = apart
    p, u, count = center[k], normal[k], 0
    c0 = int(np.floor((p[0] - low[0]) / edge))
    c1 = int(np.floor((p[1] - low[1]) / edge))
    c2 = int(np.floor((p[2] - low[2]) / edge))
    for i0 in range(max(c0 - 1, 0), min(c0 + 2, counts[0])):
        for i1 in range(max(c1 - 1, 0), min(c1 + 2, counts[1])):
            for i2 in range(max(c2 - 1, 0), min(c2 + 2, counts[2])):
                key = (i0 * counts[1] + i1) * counts[2] + i2
                for o in range(start[key], start[key + 1]):
                    j = order[o]
                    facing, square, ahead = _towards(p, u, others[j], normals[j])
                    limit = reach + radii[j] + radius[k]
                    if facing > 0.3 or square > limit * limit or ahead < -depth[j] - radii[j] - radius[k]:
                        continue
                    if (open_own[k] and open_other[j]) == _listed(j, first[k], first[k + 1], exceptions):
                        continue
                    near[count] = j
                    count += 1
    return count


@njit(**INNER)
def _towards(p, u, center, normal):
    """Cosine between two normals, squared distance of two points, how far the second lies along the first normal."""
    facing, square, ahead = 0.0, 0.0, 0.0
    for i in range(3):
        away = center[i] - p[i]
        facing += normal[i] * u[i]
        square += away * away
        ahead += away * u[i]
    return facing, square, ahead


@njit(**INNER)
def _near_point(p, u, other, depth, reach, near, some, far):
    """Keep the near sides that a point may touch, with center distances; return their number and the smallest."""
    others, radii, normals = other
    few, bound = 0, np.inf
    for m in range(len(near)):
        j = near[m]
        facing, square, ahead = _towards(p, u, others[j], normals[j])
        distance = np.sqrt(square)
        if facing > 0.0 or ahead < -depth[j] - radii[j] or distance > reach + radii[j]:
            continue
        some[few], far[few] = j, distance
        few += 1
        bound = min(bound, distance)
    return few, bound


@njit(**INNER)
@calls(closest)
def _nearest(point, position, sides, radii, allowed, reach):
    """Partner, place and gap of a point: the nearest foot of all that are allowed."""
    p, u, some, far, bound = point
    (overhanging, depth), nodes = allowed, sides.shape[1]
    N, D, H = np.empty(nodes), np.empty((nodes, 2)), np.empty((nodes, 3))
    y, d, h, unit = np.empty(3), np.empty((2, 3)), np.empty((3, 3)), np.empty(3)
    corners = np.empty((nodes, 3))
    best, partner, at_r, at_s, gap = np.inf, -1, 0.0, 0.0, np.inf
    for wide in range(2):  # the nearest first; their neighbors only where none of them has a foot point
        if best < np.inf:
            break
        for m in range(len(some)):
            j = some[m]
            nearest = far[m] - radii[j]
            if nearest > min(bound + 2 * wide * radii[j], best) or (wide == 1 and nearest <= bound):
                continue
            _corners(position, sides[j], corners)
            r, s = foot_point(p, corners, (0.33, 0.33), (N, D, H), (y, d, h))
            out, over = overhang(nodes, r, s)
            if out > overhanging[j, over]:
                continue
            unit_cross(d[0], d[1], unit)
            distance, opposed, ahead = 0.0, 0.0, 0.0
            for i in range(3):
                distance += (p[i] - y[i]) * unit[i]
                opposed += u[i] * unit[i]
                ahead += (y[i] - p[i]) * u[i]
            if opposed > OPPOSED or distance < -depth[j] or distance > reach or (distance > 0 and ahead <= 0):
                continue
            size = abs(distance) + max(out, 0.0) * radii[j]
            if size < best:
                best, partner, at_r, at_s, gap = size, j, r, s, distance
    return partner, at_r, at_s, gap


@njit(**INNER)
def _listed(value, low, high, rows):
    end = high
    while low < high:
        middle = (low + high) // 2
        if rows[middle] < value:
            low = middle + 1
        else:
            high = middle
    return low < end and rows[low] == value


@njit(**LOOP)
@calls(closest)
def _follow_partners(begin, end, out, looking, position, sides, partner, at, around, overhanging, walk):
    side, place, gap = out
    x, n = looking
    first, neighbors = around
    points, nodes = partner.shape[1], sides.shape[1]
    N, D, H = np.empty(nodes), np.empty((nodes, 2)), np.empty((nodes, 3))
    y, d, h, unit = np.empty(3), np.empty((2, 3)), np.empty((3, 3)), np.empty(3)
    corners = np.empty((nodes, 3))
    for k in range(begin, end):
        for q in range(points):
            j = partner[k, q]
            if j < 0:
                continue
            p = x[k, q]
            _corners(position, sides[j], corners)
            r, s = foot_point(p, corners, (at[k, q, 0], at[k, q, 1]), (N, D, H), (y, d, h))
            least, edge = overhang(nodes, r, s)
            unit_cross(d[0], d[1], unit)
            place[k, q, 0], place[k, q, 1] = r, s
            distance = _along(p, y, unit)
            for _ in range(walk):
                if least <= min(HOLD, overhanging[j, edge]):
                    break
                best = j
                for o in range(first[j], first[j + 1]):
                    m = neighbors[o]
                    _corners(position, sides[m], corners)
                    r, s = foot_point(p, corners, (0.33, 0.33), (N, D, H), (y, d, h))
                    out, over = overhang(nodes, r, s)
                    unit_cross(d[0], d[1], unit)
                    opposed = 0.0
                    for i in range(3):
                        opposed += unit[i] * n[k, q, i]
                    if out < least - 1e-12 and opposed < OPPOSED:
                        least, best, edge = out, m, over
                        place[k, q, 0], place[k, q, 1] = r, s
                        distance = _along(p, y, unit)
                if best == j:
                    break
                j = best
            side[k, q] = j
            if walk == 0 or least <= 0.0 or least <= overhanging[j, edge]:
                gap[k, q] = distance


def follow_partners(
    looking: tuple[Array, Array],
    position: Array,
    sides: Ints,
    partner: Ints,
    at: Array,
    around: tuple[Ints, Ints],
    overhanging: Array,
    walk: int,
) -> tuple[Ints, Array, Array]:
    """Foot points near those that are known: side (s, q), place (s, q, 2) and signed gap (s, q).

    Where the foot has left its side, the sides around (start, list) are tried, then those around the best, as far as
    ``walk`` times; a point that then has none keeps its partner with a gap of inf.
    """
    out = partner.copy(), at.copy(), np.full(partner.shape, np.inf)
    over(len(partner), _follow_partners, out, looking, position, sides, partner, at, around, overhanging, walk)
    return out


@njit(**INNER)
def _corners(position, side, corners):
    for a in range(len(side)):
        for i in range(3):
            corners[a, i] = position[side[a], i]


@njit(**INNER)
def _along(p, y, unit):
    distance = 0.0
    for i in range(3):
        distance += (p[i] - y[i]) * unit[i]
    return distance
