"""Friction: Coulomb's law at the quadrature points, regularized by an elastic slip, with a return mapping.

A point sticks where it was in the last converged state. Its trial traction grows with the slip since then; beyond the
limit, which is the coefficient times the contact pressure, the traction is returned to the limit and the point slips.
While the limit is constant, friction has a potential and a symmetric tangent. A limit that follows the pressure adds an
unsymmetric part, which `by_limit` gives and `turgor.core.engine.algebra.tangent` treats apart.
"""

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.contact.settings import FRICTION
from turgor.foundation.display import brief

if TYPE_CHECKING:
    from turgor.core.engine.contact.surface import Surface

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, slots=True, eq=False)
class FrictionHistory:
    """Internal variables of friction: the k points that touched in the last converged state.

    Parameters
    ----------
    points : (k, 2) int array
        Side and quadrature point.
    partner : (k,) int array
        Side that was touched; zeros for obstacles without sides.
    at : (k, 2) array
        Place on it.
    apart : (k, 3) array
        Point minus place in the last state.
    normal : (k, 3) array
        Of the touched side in the last state, out of it.
    traction : (k, 3) array
        Tangential traction per reference area in the last state.
    limit : (k,) array
        Coulomb's limit of the traction.
    slip : (k,) array
        Slip at which the limit is reached from rest.
    constant_limits : bool
        Whether the limits are those here, so that friction has a potential, or follow the pressure.
    """

    points: Ints
    partner: Ints
    at: Array
    apart: Array
    normal: Array
    traction: Array
    limit: Array
    slip: Array
    constant_limits: bool = False

    __repr__ = brief


#: Friction history of every part of the contact, None without friction; empty before the first touch.
Friction = tuple[FrictionHistory | None, ...]


def with_constant_limits(friction: Friction) -> Friction:
    """Friction histories whose limits do not follow the pressure."""
    return tuple(None if each is None else replace(each, constant_limits=True) for each in friction)


def elastic_slip(surface: "Surface", points: Ints, stated: float | None = None) -> Array:
    """Slip (k,) at which points of a surface begin to slide: a stated scaled length, or a share of their sides."""
    if stated is not None:
        return np.full(len(points), stated)
    return np.asarray(FRICTION.elastic_slip * np.sqrt(surface.weights.sum(axis=1))[points[:, 0]])


def mean_elastic_slip(history: FrictionHistory) -> float:
    """Mean elastic slip of the points that stick in a state, weighted by their limits; zero where none does."""
    size = np.linalg.norm(history.traction, axis=1)
    sticks = (history.limit > 0) & (size < FRICTION.sticks * history.limit)
    if not sticks.any():
        return 0.0
    limit = history.limit[sticks]
    return float((size * history.slip)[sticks].sum() / limit.sum())


def tractions(history: FrictionHistory, apart: Array) -> tuple[Array, Array]:
    """Tractions (k, 3) and their derivatives (k, 3, 3) by the present ``apart`` (k, 3)."""
    n = history.normal
    across = np.eye(3) - n[:, :, None] * n[:, None, :]
    _, trial, size, slides = _trial(history, apart)
    share = np.where(slides, history.limit / size, 1.0)
    direction = trial / size[:, None]
    along = direction[:, :, None] * direction[:, None, :]
    matrices = across - np.where(slides, 1.0, 0.0)[:, None, None] * along
    matrices *= (history.limit / history.slip * share)[:, None, None]
    return trial * share[:, None], matrices


def by_limit(history: FrictionHistory, apart: Array) -> Array:
    """Derivatives (k, 3) of the tractions by their limits."""
    slip, trial, size, slides = _trial(history, apart)
    direction = trial / size[:, None]
    stretched = slip / history.slip[:, None]
    turning = stretched - direction * np.einsum("ki,ki->k", stretched, direction)[:, None]
    sliding = direction + (history.limit / size)[:, None] * turning
    return np.asarray(np.where(slides[:, None], sliding, stretched))


def _trial(history: FrictionHistory, apart: Array) -> tuple[Array, Array, Array, NDArray[np.bool_]]:
    """Slips (k, 3) since the last state, trial tractions (k, 3), their magnitudes (k,), and which points slide."""
    n, moved = history.normal, apart - history.apart
    slip = moved - np.einsum("ki,ki->k", moved, n)[:, None] * n
    trial = history.traction + (history.limit / history.slip)[:, None] * slip
    size = np.maximum(np.linalg.norm(trial, axis=1), 1e-300)
    return slip, trial, size, size > history.limit


def taken(history: FrictionHistory, apart: Array, weights: Array) -> float:
    """Energy that friction has dissipated since the last state, by the trapezoidal rule."""
    now, _ = tractions(history, apart)
    n, moved = history.normal, apart - history.apart
    slip = moved - np.einsum("ki,ki->k", moved, n)[:, None] * n
    return float((0.5 * weights * np.einsum("ki,ki->k", history.traction + now, slip)).sum())


def turned(traction: Array, normal: Array) -> Array:
    """Project tractions (k, 3) onto the planes with the given normals (k, 3); their magnitudes stay."""
    flat = traction - np.einsum("ki,ki->k", traction, normal)[:, None] * normal
    before, after = np.linalg.norm(traction, axis=1), np.linalg.norm(flat, axis=1)
    return np.asarray(flat * (before / np.maximum(after, 1e-300))[:, None])
