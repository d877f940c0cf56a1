"""Fibers on the sides of cells: pieces of thread that stretch with the surface and go slack in compression.

A piece follows its surface through t = Σ gₐ xₐ, the current tangent per reference length; its stretch is λ = |t|, its
tension N = E A (λ − 1), its energy ½ E A (λ − 1)² for each reference length. Smeared fibers are pieces at the
integration points of the surface, with gₐ the derivative of the shape functions along the fiber and an area instead
of a length; a discrete thread is a chain of trusses, with gₐ the same derivative at the middle of each. Pushed
threads go slack: below λ = 1 a share of the stiffness remains, nothing or all of it.
"""

from dataclasses import dataclass

import numpy as np
from numba import njit
from numpy.typing import NDArray

from turgor.core.engine.compiled import LOOP
from turgor.foundation.display import brief

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, slots=True, eq=False)
class Pieces:
    """Pieces of fibers, each tied to one side of a cell, or to one cell.

    Parameters
    ----------
    sides : (k, n) int array
        Nodes of the side, or of the cell, that carries each piece.
    along : (k, n) array
        gₐ: tangent per reference length from the positions of the nodes.
    weights : (k,) array
        Reference length of each piece, or the area it stands for.
    stiffness : (k,) array
        E A, or E A over the distance between fibers.
    pushed : (k,) array
        Share of the stiffness that is left in compression, 0 to 1.
    middle : (k, n) array
        Shape values of the nodes at the middle of each piece.
    hand : (k,) int array
        Family that each piece belongs to: threads of one hand are 0, those of the other 1; of embedded threads each
        is a family of its own.
    """

    sides: Ints
    along: Array
    weights: Array
    stiffness: Array
    pushed: Array
    middle: Array
    hand: Ints

    __repr__ = brief


@njit(**LOOP)
def fiber_tensions(x, dx, sides, along, stiffness, pushed):
    """Stretch λ and tension N + E A n·Δt of each piece, linearized about positions ``x`` for an update ``dx``."""
    stretch = np.empty(len(sides))
    tension = np.empty(len(sides))
    for k in range(len(sides)):
        t = np.zeros(3)
        d = np.zeros(3)
        for a in range(sides.shape[1]):
            for i in range(3):
                t[i] += along[k, a] * x[sides[k, a], i]
                d[i] += along[k, a] * dx[sides[k, a], i]
        size = np.sqrt(t[0] * t[0] + t[1] * t[1] + t[2] * t[2])
        change = (t[0] * d[0] + t[1] * d[1] + t[2] * d[2]) / size
        present = stiffness[k] if size + change >= 1.0 else stiffness[k] * pushed[k]
        stretch[k] = size
        tension[k] = present * (size + change - 1.0)
    return stretch, tension


@njit(**LOOP)
def fiber_forces(x, sides, along, weights, tension):
    """Nodal forces (k, n, 3) of tensions (k,) at positions ``x``."""
    out = np.zeros((len(sides), sides.shape[1], 3))
    for k in range(len(sides)):
        t = np.zeros(3)
        for a in range(sides.shape[1]):
            for i in range(3):
                t[i] += along[k, a] * x[sides[k, a], i]
        factor = weights[k] * tension[k] / np.sqrt(t[0] * t[0] + t[1] * t[1] + t[2] * t[2])
        for a in range(sides.shape[1]):
            for i in range(3):
                out[k, a, i] = factor * along[k, a] * t[i]
    return out


@njit(**LOOP)
def fiber_tangents(x, sides, along, weights, stiffness, tension):
    """Stiffness (k, 3n, 3n) at positions ``x`` with tensions in its geometric part; ``stiffness`` is that of now."""
    n = sides.shape[1]
    out = np.empty((len(sides), 3 * n, 3 * n))
    for k in range(len(sides)):
        t = np.zeros(3)
        for a in range(n):
            for i in range(3):
                t[i] += along[k, a] * x[sides[k, a], i]
        size = np.sqrt(t[0] * t[0] + t[1] * t[1] + t[2] * t[2])
        for a in range(n):
            for b in range(n):
                w = weights[k] * along[k, a] * along[k, b]
                for i in range(3):
                    for j in range(3):
                        nn = t[i] * t[j] / (size * size)
                        delta = 1.0 if i == j else 0.0
                        out[k, 3 * a + i, 3 * b + j] = w * (stiffness[k] * nn + tension[k] / size * (delta - nn))
    return out
