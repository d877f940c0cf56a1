"""Compiled loops over points of a surface that may touch sides, in reduced coordinates.

Energy, foot points and second derivatives are those of `turgor.core.engine.contact.pairs`.
"""

# mypy: disallow-untyped-defs=False
# numba infers the types of the compiled loops, as in `turgor.core.engine.cells.kernels`

import numpy as np
from numba import njit

from turgor.core.engine.compiled import INNER, LOOP, calls
from turgor.core.engine.contact import closest
from turgor.core.engine.contact.closest import centers_of, curvature, foot_point, overhang, place, shapes, unit_cross

#: A side leaves the plane of its corners by less than the first share of its radius, or this many times the distance of
#: its nodes; its foot points lie within the last many radii about its center.
FLAT, BULGE, WIDE = 1e-3, 1.5, 1.1

#: A point is before a side, and Newton's method need not say how far, where its distance from the surface above its
#: foot on the plane exceeds this share of what the side leaves the plane by, and more where that place is aside of it.
#: On the demo finger a thousand answers stay the same to the last digit, and the search takes a quarter less.
BEFORE, STEEP = 0.05, 4.0

#: Points whose foot on the plane lies farther outside of a side, in its coordinates, have none on the side.
ASIDE = 0.25


@njit(**INNER)
def flat_foot(p, x, side):
    """Foot (r, s) of a point on the plane of a side, from its first corner and the two next to it."""
    last = 2 if len(side) == 6 else 3
    rr, rs, ss, f, g = 0.0, 0.0, 0.0, 0.0, 0.0
    for i in range(3):
        u = x[side[1], i] - x[side[0], i]
        v = x[side[last], i] - x[side[0], i]
        away = p[i] - x[side[0], i]
        rr += u * u
        rs += u * v
        ss += v * v
        f += away * u
        g += away * v
    determinant = rr * ss - rs * rs
    return (ss * f - rs * g) / determinant, (rr * g - rs * f) / determinant


@njit(**LOOP)
@calls(closest)
def find(x, points, shape, sides, limits, candidates):
    """Partner (k,), its place (k, 2) and the signed gap (k,) of points that are inside a side; −1 for none.

    Points that are clearly before a side have none either.

    ``points`` (k, n) are the nodes of the sides of the points, ``shape`` (k, n) their shape functions. ``limits`` are
    the allowed overhang (s, e) and depth (s,) of sides; ``candidates`` (start, list) the sides of each point.
    """
    overhanging, depth = limits
    start, listed = candidates
    nodes = sides.shape[1]
    partner, at, gap = np.full(len(points), -1, dtype=np.int64), np.zeros((len(points), 2)), np.zeros(len(points))
    N, D, H = np.empty(nodes), np.empty((nodes, 2)), np.empty((nodes, 3))
    y, d, h, unit = np.empty(3), np.empty((2, 3)), np.empty((3, 3)), np.empty(3)
    corners, p = np.empty((nodes, 3)), np.empty(3)
    center, radius, normal = centers_of(x, sides, 3 if nodes == 6 else 4)
    bulge = np.empty(len(sides))
    for j in range(len(sides)):
        bulge[j] = FLAT * radius[j]
        for a in range(nodes):
            away = 0.0
            for i in range(3):
                away += (x[sides[j, a], i] - center[j, i]) * normal[j, i]
            bulge[j] = max(bulge[j], BULGE * abs(away))
    for k in range(len(points)):
        for i in range(3):
            p[i] = 0.0
            for a in range(points.shape[1]):
                p[i] += shape[k, a] * x[points[k, a], i]
        best = np.inf
        for o in range(start[k], start[k + 1]):
            j = listed[o]
            ahead, square = 0.0, 0.0
            for i in range(3):
                away = p[i] - center[j, i]
                ahead += away * normal[j, i]
                square += away * away
            curved = bulge[j]
            if ahead > curved or ahead < -depth[j] - curved or square > (WIDE * radius[j] + depth[j]) ** 2:
                continue
            r, s = flat_foot(p, x, sides[j])
            out = overhang(nodes, r, s)[0]
            if out > ASIDE:
                continue
            for a in range(nodes):
                for i in range(3):
                    corners[a, i] = x[sides[j, a], i]
            if out <= 0.0 and ahead > -curved:
                shapes(r, s, N, D, H)
                place(corners, N, D, H, y, d, h)
                unit_cross(d[0], d[1], unit)
                distance, square = 0.0, 0.0
                for i in range(3):
                    distance += (p[i] - y[i]) * unit[i]
                    square += (p[i] - y[i]) ** 2
                aside = (square - distance * distance) / radius[j] ** 2
                if distance > curved * (BEFORE + STEEP * aside):
                    if distance < best:
                        partner[k] = -1
                        break
                    continue
            r, s = foot_point(p, corners, (r, s), (N, D, H), (y, d, h))
            out, edge = overhang(nodes, r, s)
            if out > overhanging[j, edge]:
                continue
            unit_cross(d[0], d[1], unit)
            distance = 0.0
            for i in range(3):
                distance += (p[i] - y[i]) * unit[i]
            if distance < -depth[j] or abs(distance) >= best:
                continue
            best = abs(distance)
            partner[k], at[k, 0], at[k, 1], gap[k] = j, r, s, distance
            if out <= 0.0:
                break
    return partner, at, gap


@njit(**LOOP)
@calls(closest)
def press(x, modes, points, shape, sides, touching, stiff):
    """Forces (r,) and tangent (r, r) of the points that press; ``modes`` are (nodes, 3, r).

    ``touching`` (number, partner, place) are the points and what they touch, ``stiff`` (t,) their stiffness.
    """
    number, partner, at = touching
    nodes, count = sides.shape[1], modes.shape[2]
    force, K = np.zeros(count), np.zeros((count, count))
    N, D, H = np.empty(nodes), np.empty((nodes, 2)), np.empty((nodes, 3))
    y, d, h, apart = np.empty(3), np.empty((2, 3)), np.empty((3, 3)), np.empty(3)
    corners, A, b = np.empty((nodes, 3)), np.empty((3, count)), np.empty((2, count))
    for t in range(len(number)):
        k, j, w = number[t], partner[t], stiff[t]
        for a in range(nodes):
            for i in range(3):
                corners[a, i] = x[sides[j, a], i]
        shapes(at[t, 0], at[t, 1], N, D, H)
        place(corners, N, D, H, y, d, h)
        A[:] = 0.0
        b[:] = 0.0
        for i in range(3):
            apart[i] = -y[i]
            for a in range(points.shape[1]):
                apart[i] += shape[k, a] * x[points[k, a], i]
        for i in range(3):
            for a in range(points.shape[1]):
                for m in range(count):
                    A[i, m] += shape[k, a] * modes[points[k, a], i, m]
            for a in range(nodes):
                for m in range(count):
                    A[i, m] -= N[a] * modes[sides[j, a], i, m]
                    b[0, m] -= D[a, 0] * apart[i] * modes[sides[j, a], i, m]
                    b[1, m] -= D[a, 1] * apart[i] * modes[sides[j, a], i, m]
        rr, rs, ss = curvature(apart, d, h)
        determinant = rr * ss - rs * rs
        for m in range(count):
            for i in range(3):
                b[0, m] -= d[0, i] * A[i, m]
                b[1, m] -= d[1, i] * A[i, m]
        for m in range(count):
            for i in range(3):
                force[m] += w * A[i, m] * apart[i]
            u = w * (ss * b[0, m] - rs * b[1, m]) / determinant
            v = w * (rr * b[1, m] - rs * b[0, m]) / determinant
            for n in range(count):
                K[m, n] += w * (A[0, m] * A[0, n] + A[1, m] * A[1, n] + A[2, m] * A[2, n]) - u * b[0, n] - v * b[1, n]
    return force, K
