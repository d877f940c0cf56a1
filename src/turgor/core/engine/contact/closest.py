"""Points and normals of quadratic sides, and closest points: six-node triangles and nine-node quadrilaterals."""

import numpy as np
from numba import njit

from turgor.core.engine.compiled import INNER, LOOP

#: Newton steps to the foot point; each gains a factor of distance times curvature, small where walls nearly touch.
STEPS = 12

#: How far outside a side, in reference coordinates, the foot point is looked for.
ROAM = 0.6


@njit(**LOOP)
def shapes(r, s, N, D, H):
    """Fill shape functions (n,), first (n, 2) and second (n, 3: rr, rs, ss) derivatives of a side at (r, s)."""
    if len(N) == 6:
        t = 1.0 - r - s
        N[0], N[1], N[2] = t * (2 * t - 1), r * (2 * r - 1), s * (2 * s - 1)
        N[3], N[4], N[5] = 4 * t * r, 4 * r * s, 4 * s * t
        D[0, 0], D[1, 0], D[2, 0], D[3, 0], D[4, 0], D[5, 0] = 1 - 4 * t, 4 * r - 1, 0.0, 4 * (t - r), 4 * s, -4 * s
        D[0, 1], D[1, 1], D[2, 1], D[3, 1], D[4, 1], D[5, 1] = 1 - 4 * t, 0.0, 4 * s - 1, -4 * r, 4 * r, 4 * (t - s)
        H[0, 0], H[1, 0], H[2, 0], H[3, 0], H[4, 0], H[5, 0] = 4.0, 4.0, 0.0, -8.0, 0.0, 0.0
        H[0, 1], H[1, 1], H[2, 1], H[3, 1], H[4, 1], H[5, 1] = 4.0, 0.0, 0.0, -4.0, 4.0, -4.0
        H[0, 2], H[1, 2], H[2, 2], H[3, 2], H[4, 2], H[5, 2] = 4.0, 0.0, 4.0, 0.0, 0.0, -8.0
        return
    a = ((1 - r) * (1 - 2 * r), 4 * r * (1 - r), r * (2 * r - 1))
    b = ((1 - s) * (1 - 2 * s), 4 * s * (1 - s), s * (2 * s - 1))
    da = (4 * r - 3, 4 - 8 * r, 4 * r - 1)
    db = (4 * s - 3, 4 - 8 * s, 4 * s - 1)
    curved = (4.0, -8.0, 4.0)
    along = (0, 2, 2, 0, 1, 2, 1, 0, 1)
    across = (0, 0, 2, 2, 0, 1, 2, 1, 1)
    for k in range(9):
        i, j = along[k], across[k]
        N[k] = a[i] * b[j]
        D[k, 0], D[k, 1] = da[i] * b[j], a[i] * db[j]
        H[k, 0], H[k, 1], H[k, 2] = curved[i] * b[j], da[i] * db[j], a[i] * curved[j]


@njit(**LOOP)
def place(corners, N, D, H, x, d, h):
    """Fill position (3,), tangents (2, 3) and second derivatives (3, 3: rr, rs, ss) of a side from its shapes."""
    for i in range(3):
        x[i] = 0.0
        for m in range(2):
            d[m, i] = 0.0
        for m in range(3):
            h[m, i] = 0.0
        for a in range(len(N)):
            c = corners[a, i]
            x[i] += N[a] * c
            for m in range(2):
                d[m, i] += D[a, m] * c
            for m in range(3):
                h[m, i] += H[a, m] * c


@njit(**INNER)
def curvature(apart, d, h):
    """Second derivatives (rr, rs, ss) of half the squared distance; ``apart`` is the point minus the foot."""
    rr, rs, ss = 0.0, 0.0, 0.0
    bent_rr, bent_rs, bent_ss = 0.0, 0.0, 0.0
    for i in range(3):
        rr += d[0, i] * d[0, i]
        rs += d[0, i] * d[1, i]
        ss += d[1, i] * d[1, i]
        bent_rr += apart[i] * h[0, i]
        bent_rs += apart[i] * h[1, i]
        bent_ss += apart[i] * h[2, i]
    full = (rr - bent_rr, rs - bent_rs, ss - bent_ss)
    if full[0] > 0.1 * rr and full[0] * full[2] - full[1] * full[1] > 0.1 * (rr * ss - rs * rs):
        return full
    return rr, rs, ss  # far from the surface: Gauss–Newton


@njit(**LOOP)
def foot_point(point, corners, guess, values, frame):
    """Foot (r, s) of a point on the surface that extends a side, from a first guess (r, s).

    ``values`` (N, D, H) as in `shapes` and ``frame`` (x, d, h) as in `place` are filled there.
    """
    (r, s), (N, D, H), (x, d, h) = guess, values, frame
    apart = np.empty(3)
    last = False
    for step in range(STEPS + 1):
        shapes(r, s, N, D, H)
        place(corners, N, D, H, x, d, h)
        if last or step == STEPS:
            break
        f, g = 0.0, 0.0
        for i in range(3):
            apart[i] = point[i] - x[i]
            f += apart[i] * d[0, i]
            g += apart[i] * d[1, i]
        rr, rs, ss = curvature(apart, d, h)
        determinant = rr * ss - rs * rs
        if determinant <= 0.0:
            break
        old_r, old_s = r, s
        r = min(max(r + (ss * f - rs * g) / determinant, -ROAM), 1.0 + ROAM)
        s = min(max(s + (rr * g - rs * f) / determinant, -ROAM), 1.0 + ROAM)
        last = abs(r - old_r) + abs(s - old_s) < 1e-13
    return r, s


@njit(**LOOP)
def overhang(count, r, s):
    """How far (r, s) lies outside a side of ``count`` nodes, and beyond which of its edges."""
    if count == 6:
        out, edge = -s, 0
        if r + s - 1 > out:
            out, edge = r + s - 1, 1
        if -r > out:
            out, edge = -r, 2
        return out, edge
    out, edge = -s, 0
    if r - 1 > out:
        out, edge = r - 1, 1
    if s - 1 > out:
        out, edge = s - 1, 2
    if -r > out:
        out, edge = -r, 3
    return out, edge


@njit(**LOOP)
def centers_of(position, sides, corners):
    """Centers (s, 3) of the corners of sides, radii (s,) about them that hold all nodes, and unit normals (s, 3)."""
    count, nodes = sides.shape
    center, radius, normal = np.empty((count, 3)), np.empty(count), np.empty((count, 3))
    p, q = np.empty(3), np.empty(3)
    begin, end, other = (0, 2, 1) if corners == 4 else (0, 1, 0)  # diagonals of a quadrilateral, edges of a triangle
    for k in range(count):
        for i in range(3):
            center[k, i] = 0.0
            for a in range(corners):
                center[k, i] += position[sides[k, a], i] / corners
            p[i] = position[sides[k, end], i] - position[sides[k, begin], i]
            q[i] = position[sides[k, corners - 1], i] - position[sides[k, other], i]
        largest = 0.0
        for a in range(nodes):
            away = 0.0
            for i in range(3):
                away += (position[sides[k, a], i] - center[k, i]) ** 2
            largest = max(largest, away)
        radius[k] = np.sqrt(largest)
        unit_cross(p, q, normal[k])
    return center, radius, normal


@njit(**INNER)
def unit_cross(a, b, out):
    """Fill the unit vector along a × b, and return the length of the product."""
    square = 0.0
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        out[i] = a[j] * b[k] - a[k] * b[j]
        square += out[i] * out[i]
    length = np.sqrt(square)
    if length > 0:
        for i in range(3):
            out[i] /= length
    return length


@njit(**LOOP)
def points_of(position, sides, N, dN):
    """Positions and unit normals (s, q, 3) at the quadrature points of sides, and how much their area has grown."""
    count, nodes = sides.shape
    points = len(N)
    x, n, area = np.empty((count, points, 3)), np.empty((count, points, 3)), np.empty((count, points))
    r, s = np.empty(3), np.empty(3)
    for k in range(count):
        for q in range(points):
            for i in range(3):
                at, along, across = 0.0, 0.0, 0.0
                for a in range(nodes):
                    c = position[sides[k, a], i]
                    at += N[q, a] * c
                    along += dN[q, a, 0] * c
                    across += dN[q, a, 1] * c
                x[k, q, i], r[i], s[i] = at, along, across
            area[k, q] = unit_cross(r, s, n[k, q])
    return x, n, area
