"""Frames of a rod: rigid motions and their twists, by arrays.

A frame is a rotation matrix and a position. A twist is (velocity or shift, rotation), both in the axes of the frame
itself: moving a frame by a twist multiplies it from the right. Sums over even powers of the angle replace quotients
that lose digits near zero.
"""

from math import factorial

import numpy as np
from numpy.typing import NDArray
from scipy.special import bernoulli

from turgor.foundation.errors import TurgorError

Array = NDArray[np.float64]

#: Powers of the squared angle in the sums for inverse tangents; the rest is below 1e-15 up to the largest angle.
TERMS = 24

#: Largest rotation between the ends of an element [rad].
LARGEST_ANGLE = 2.6

#: Angles below which the closed forms of sine and cosine are replaced by two terms of their sums.
SMALL_ANGLE = 1e-3

_COT = np.array([-abs(bernoulli(2 * k)[2 * k]) / factorial(2 * k) if k else 1.0 for k in range(TERMS + 2)])
_K = np.arange(TERMS)
#: Rows of coefficients: second and fourth power of the commutator, their slopes, and that of the position.
_SUMS = np.stack(
    [
        (_K - 1) * _COT[1 : TERMS + 1],
        (_K + 1) * _COT[2 : TERMS + 2],
        np.append((_K[1:] * (_K[1:] - 1)) * _COT[2 : TERMS + 1], 0.0),
        np.append((_K[1:] * (_K[1:] + 1)) * _COT[3 : TERMS + 2], 0.0),
        -_COT[1 : TERMS + 1],
    ],
    axis=1,
)


def _linear_maps() -> tuple[Array, Array, Array]:
    """Return what turns vectors into flattened matrices of cross products, commutators and `wrench_matrix`."""
    cross = np.zeros((3, 3, 3))
    for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        cross[i, k, j], cross[i, j, k] = 1.0, -1.0
    commute, wrench = np.zeros((6, 6, 6)), np.zeros((6, 6, 6))
    commute[3:, :3, :3], commute[3:, 3:, 3:], commute[:3, :3, 3:] = cross, cross, cross
    wrench[:3, :3, 3:], wrench[:3, 3:, :3], wrench[3:, 3:, 3:] = cross, cross, cross
    return cross.reshape(3, 9), commute.reshape(6, 36), wrench.reshape(6, 36)


_CROSS, _COMMUTATOR, _WRENCH = _linear_maps()


def cross_matrix(vectors: Array) -> Array:
    """Return the matrices of the cross product with vectors, (..., 3, 3)."""
    return (vectors @ _CROSS).reshape(*vectors.shape[:-1], 3, 3)


def commutator(twists: Array) -> Array:
    """Return the matrices ad of the commutator with twists, (..., 6, 6)."""
    return (twists @ _COMMUTATOR).reshape(*twists.shape[:-1], 6, 6)


def wrench_matrix(wrenches: Array) -> Array:
    """Return the matrices L with ad(x)ᵀ F = L(F) x, of wrenches (force, moment), (..., 6, 6)."""
    return (wrenches @ _WRENCH).reshape(*wrenches.shape[:-1], 6, 6)


def adjoint_inverse(rotation: Array, position: Array) -> Array:
    """Return Ad of the inverse frame, (..., 6, 6): it turns twists of a body into those of a frame fixed to it."""
    turned = np.swapaxes(rotation, -1, -2)
    matrix = np.zeros((*position.shape[:-1], 6, 6))
    matrix[..., :3, :3], matrix[..., 3:, 3:] = turned, turned
    matrix[..., :3, 3:] = -turned @ cross_matrix(position)
    return matrix


def exponential(twists: Array) -> tuple[Array, Array]:
    """Return the rotations (n, 3, 3) and positions (n, 3) that twists (n, 6) lead to.

    Examples
    --------
    >>> rotation, position = exponential(np.array([[np.pi / 2, 0, 0, 0, 0, np.pi / 2]]))
    >>> print(position.round(6))
    [[1. 1. 0.]]
    """
    turn = twists[..., 3:]
    squared = np.einsum("...i,...i->...", turn, turn)
    first, second, third = _trigonometric(squared)
    hat = cross_matrix(turn)
    square = hat @ hat
    rotation = np.eye(3) + first[..., None, None] * hat + second[..., None, None] * square
    along = np.eye(3) + second[..., None, None] * hat + third[..., None, None] * square
    return rotation, (along @ twists[..., :3, None])[..., 0]


def logarithm(rotation: Array, position: Array) -> Array:
    """Return the twists (n, 6) that lead to frames.

    Raises
    ------
    TurgorError
        If a frame is turned by more than `LARGEST_ANGLE`.
    """
    axial = 0.5 * (rotation[..., [2, 0, 1], [1, 2, 0]] - rotation[..., [1, 2, 0], [2, 0, 1]])
    sine = np.sqrt(np.einsum("...i,...i->...", axial, axial))
    angle = np.arctan2(sine, 0.5 * (np.einsum("...ii->...", rotation) - 1))
    if not (angle < LARGEST_ANGLE).all():
        raise TurgorError(f"an element turns by more than {LARGEST_ANGLE:g} rad between its ends; take more elements.")
    scale = np.where(sine > SMALL_ANGLE, angle / np.maximum(sine, 1e-300), 1 + sine**2 / 6)
    turn = scale[..., None] * axial
    hat = cross_matrix(turn)
    bent = (hat @ position[..., None])[..., 0]
    more = even_sums(np.einsum("...i,...i->...", turn, turn))[..., 4]
    shift = position - 0.5 * bent + more[..., None] * (hat @ bent[..., None])[..., 0]
    return np.concatenate([shift, turn], axis=-1)


def even_sums(squared_angle: Array) -> Array:
    """Return the five sums over powers of squared angles, (..., 5), that inverse tangents are made of."""
    return (squared_angle[..., None] ** _K) @ _SUMS


def tangent_map(twists: Array) -> Array:
    """Return T with exp(x + dx) = exp(x) exp(T dx), (..., 6, 6), by its sum; for angles up to about 3 rad."""
    ad = -commutator(twists)
    total = np.broadcast_to(np.eye(6), ad.shape).copy()
    term = total.copy()
    for k in range(2, TERMS):
        term = term @ ad / k
        total += term
    return total


def _trigonometric(squared: Array) -> tuple[Array, Array, Array]:
    """Return sin x / x, (1 − cos x)/x² and (x − sin x)/x³ of squared angles."""
    angle = np.sqrt(squared)
    safe = np.where(angle > SMALL_ANGLE, angle, 1.0)
    small = angle <= SMALL_ANGLE
    half = np.sin(0.5 * safe)
    return (
        np.where(small, 1 - squared / 6, np.sin(safe) / safe),
        np.where(small, 0.5 - squared / 24, 2 * half**2 / safe**2),
        np.where(small, 1 / 6 - squared / 120, (safe - np.sin(safe)) / safe**3),
    )
