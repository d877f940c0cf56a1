"""Forces and tangents of points pressed against sides, and of points that stick or slip there.

The energy of a point that lies inside the opposite side is half its stiffness times the squared distance to that side,
which is a minimum over the places on the side: so its first derivative is the spring force between the point and its
foot, and its second derivative follows from eliminating the place of the foot exactly. Both are symmetric, the forces
on the two sides are opposite and on one line, and the turning of the normal needs no term of its own.
"""

import numpy as np
from numba import njit

from turgor.core.engine.compiled import LOOP, calls
from turgor.core.engine.contact import closest
from turgor.core.engine.contact.closest import curvature, place, shapes


@njit(**LOOP)
@calls(closest)
def press_forces(position, sides, N1, points, partner, at, spring):
    """Nodal forces (k, n1 + n2, 3) on primary, then secondary side, of the k points ``(side, q)`` pressed together.

    ``sides`` are the primary and the secondary ones.
    """
    primary, secondary = sides
    n1, n2 = primary.shape[1], secondary.shape[1]
    out = np.zeros((len(points), n1 + n2, 3))
    N, D, H = np.empty(n2), np.empty((n2, 2)), np.empty((n2, 3))
    for k in range(len(points)):
        shapes(at[k, 0], at[k, 1], N, D, H)
        side, q = points[k, 0], points[k, 1]
        for i in range(3):
            apart = 0.0
            for a in range(n1):
                apart += N1[q, a] * position[primary[side, a], i]
            for a in range(n2):
                apart -= N[a] * position[secondary[partner[k], a], i]
            for a in range(n1):
                out[k, a, i] = spring[k] * apart * N1[q, a]
            for a in range(n2):
                out[k, n1 + a, i] = -spring[k] * apart * N[a]
    return out


@njit(**LOOP)
@calls(closest)
def press_tangents(position, sides, N1, points, partner, at, spring, start):
    """Tangents (g, m, m), m = 3 (n1 + n2), summed over the points start[g] to start[g + 1] that share both sides."""
    primary, secondary = sides
    n1, n2 = primary.shape[1], secondary.shape[1]
    nodes = n1 + n2
    out = np.zeros((len(start) - 1, 3 * nodes, 3 * nodes))
    N, D, H = np.empty(n2), np.empty((n2, 2)), np.empty((n2, 3))
    y, d, h, apart = np.empty(3), np.empty((2, 3)), np.empty((3, 3)), np.empty(3)
    corners, c, b = np.empty((n2, 3)), np.empty(nodes), np.empty((2, 3 * nodes))
    for g in range(len(start) - 1):
        for k in range(start[g], start[g + 1]):
            side, q = points[k, 0], points[k, 1]
            for a in range(n2):
                for i in range(3):
                    corners[a, i] = position[secondary[partner[k], a], i]
            shapes(at[k, 0], at[k, 1], N, D, H)
            place(corners, N, D, H, y, d, h)
            for i in range(3):
                apart[i] = -y[i]
                for a in range(n1):
                    apart[i] += N1[q, a] * position[primary[side, a], i]
            rr, rs, ss = curvature(apart, d, h)
            determinant = rr * ss - rs * rs
            for a in range(n1):
                c[a] = N1[q, a]
                for m in range(2):
                    for i in range(3):
                        b[m, 3 * a + i] = -N1[q, a] * d[m, i]
            for a in range(n2):
                c[n1 + a] = -N[a]
                for m in range(2):
                    for i in range(3):
                        b[m, 3 * (n1 + a) + i] = N[a] * d[m, i] - D[a, m] * apart[i]
            w = spring[k]
            for a in range(3 * nodes):
                u = w * (ss * b[0, a] - rs * b[1, a]) / determinant
                v = w * (rr * b[1, a] - rs * b[0, a]) / determinant
                for e in range(a + 1):
                    out[g, a, e] -= u * b[0, e] + v * b[1, e]
            for a in range(nodes):
                for e in range(a + 1):
                    for i in range(3):
                        out[g, 3 * a + i, 3 * e + i] += w * c[a] * c[e]
    return out


@njit(**LOOP)
def tie_tangents(weights, matrices, start):
    """Tangents (g, 3 m, 3 m) of points tied by weights (k, m) of nodes and matrices (k, 3, 3), summed by groups."""
    m = weights.shape[1]
    out = np.zeros((len(start) - 1, 3 * m, 3 * m))
    for g in range(len(start) - 1):
        for k in range(start[g], start[g + 1]):
            for a in range(m):
                for e in range(a + 1):
                    w = weights[k, a] * weights[k, e]
                    for i in range(3):
                        for j in range(3):
                            out[g, 3 * a + i, 3 * e + j] += w * matrices[k, i, j]
    return out


@njit(**LOOP)
@calls(closest)
def shares_at(count, at):
    """Shape functions (k, count) of a side with ``count`` nodes at places (k, 2)."""
    out = np.empty((len(at), count))
    D, H = np.empty((count, 2)), np.empty((count, 3))
    for k in range(len(at)):
        shapes(at[k, 0], at[k, 1], out[k], D, H)
    return out


@njit(**LOOP)
@calls(closest)
def normals_at(position, sides, partner, at):
    """Unit normals (k, 3) of sides at places on them."""
    count = sides.shape[1]
    out = np.empty((len(at), 3))
    N, D, H = np.empty(count), np.empty((count, 2)), np.empty((count, 3))
    y, d, h, corners = np.empty(3), np.empty((2, 3)), np.empty((3, 3)), np.empty((count, 3))
    for k in range(len(at)):
        for a in range(count):
            for i in range(3):
                corners[a, i] = position[sides[partner[k], a], i]
        shapes(at[k, 0], at[k, 1], N, D, H)
        place(corners, N, D, H, y, d, h)
        out[k, 0] = d[0, 1] * d[1, 2] - d[0, 2] * d[1, 1]
        out[k, 1] = d[0, 2] * d[1, 0] - d[0, 0] * d[1, 2]
        out[k, 2] = d[0, 0] * d[1, 1] - d[0, 1] * d[1, 0]
        size = np.sqrt(out[k, 0] ** 2 + out[k, 1] ** 2 + out[k, 2] ** 2)
        for i in range(3):
            out[k, i] /= max(size, 1e-300)
    return out


@njit(**LOOP)
@calls(closest)
def foot_changes(position, sides, N1, points, partner, at):
    """Derivatives (k, 2, 3 (n1 + n2)) of the places of feet by the nodes of primary, then secondary sides."""
    primary, secondary = sides
    n1, n2 = primary.shape[1], secondary.shape[1]
    out = np.zeros((len(points), 2, 3 * (n1 + n2)))
    N, D, H = np.empty(n2), np.empty((n2, 2)), np.empty((n2, 3))
    y, d, h, apart, corners = np.empty(3), np.empty((2, 3)), np.empty((3, 3)), np.empty(3), np.empty((n2, 3))
    for k in range(len(points)):
        side, q = points[k, 0], points[k, 1]
        for a in range(n2):
            for i in range(3):
                corners[a, i] = position[secondary[partner[k], a], i]
        shapes(at[k, 0], at[k, 1], N, D, H)
        place(corners, N, D, H, y, d, h)
        for i in range(3):
            apart[i] = -y[i]
            for a in range(n1):
                apart[i] += N1[q, a] * position[primary[side, a], i]
        rr, rs, ss = curvature(apart, d, h)
        determinant = rr * ss - rs * rs
        for a in range(n1 + n2):
            for i in range(3):
                b = a - n1
                along = N1[q, a] * d[0, i] if a < n1 else D[b, 0] * apart[i] - N[b] * d[0, i]
                across = N1[q, a] * d[1, i] if a < n1 else D[b, 1] * apart[i] - N[b] * d[1, i]
                out[k, 0, 3 * a + i] = (ss * along - rs * across) / determinant
                out[k, 1, 3 * a + i] = (rr * across - rs * along) / determinant
    return out
