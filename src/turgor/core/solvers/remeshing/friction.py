"""Friction on finer cells: the tangential tractions of a state are carried over to the points of the new sides."""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.contact.closest import points_of
from turgor.core.engine.contact.friction import Friction, FrictionHistory, turned
from turgor.core.engine.contact.surface import Surface
from turgor.core.engine.system import System
from turgor.core.solvers.restart import unknowns_of
from turgor.core.solvers.solution import State

Array = NDArray[np.float64]
Ints = NDArray[np.int64]

#: A surface, the scaled positions of all nodes at rest, and the unit of length [m].
Placed = tuple[Surface, Array, float]


def carried_friction(state: State, moved: State, after: System) -> Friction:
    """Friction histories on the finer cells.

    Every side of the new mesh lies in one of the old mesh. The tractions are fitted linearly in each old side, which
    leaves the sum of its forces as it was. A point sticks where it is in the state that was carried over.

    Parameters
    ----------
    state : State
        On the cells before, with friction.
    moved : State
        The same on the finer cells.
    after : System
        Of the finer cells.

    Returns
    -------
    tuple of (FrictionHistory or None)
    """
    assert state.memory is not None
    before = System(state.model, after.controlled)
    unknowns = unknowns_of(after, moved)
    position = after.points + after.split(unknowns)[0]
    contacts = after.contacts(unknowns, state.load_factor)
    histories: list[FrictionHistory | None] = []
    parts = zip(before.contact.parts, after.contact.parts, contacts.gaps, state.memory.friction, strict=True)
    for old, new, gaps, known in parts:
        if known is None:
            histories.append(None)
            continue
        history = new.anchored(position, gaps)
        here, there = (old.surface, before.points, before.length), (new.surface, after.points, after.length)
        values = _fitted(here, there, known, history.points) * before.stress_scale / after.stress_scale
        histories.append(replace(history, traction=turned(values, history.normal)))
    return tuple(histories)


def _fitted(old: Placed, new: Placed, known: FrictionHistory, points: Ints) -> Array:
    """Tractions (k, 3) at points (k, 2) of new sides, by a linear fit in the old sides in which they lie at rest."""
    from scipy.spatial import cKDTree  # here: few jobs need it

    x, normal, y, there = *_at_rest(old), *(each[tuple(points.T)] for each in _at_rest(new))
    values = np.zeros(x.shape)
    values[tuple(known.points.T)] = known.traction
    size = float(np.sqrt(old[0].weights.sum(axis=1).mean())) * old[2]
    tree = cKDTree(np.concatenate([x / size, normal], axis=2).reshape(-1, 6))  # the normal: not through a thin wall
    side = tree.query(np.hstack([y / size, there]))[1] // x.shape[1]
    middle, along = x.mean(axis=1, keepdims=True), x[:, -1] - x[:, 0]
    frame = np.stack([along, np.cross(normal.mean(axis=1), along)], axis=1)
    frame /= (frame**2).sum(axis=2, keepdims=True)
    rows = np.insert(np.einsum("sqi,smi->sqm", x - middle, frame), 0, 1.0, axis=2)
    root = np.sqrt(old[0].weights)[:, :, None]  # weighted, the fit has the sum of the forces of each side
    fits = np.linalg.pinv(root * rows) @ (root * values)
    here = np.insert(np.einsum("ki,kmi->km", y - middle[side, 0], frame[side]), 0, 1.0, axis=1)
    return np.asarray(np.einsum("km,kmi->ki", here, fits[side]))


def _at_rest(placed: Placed) -> tuple[Array, Array]:
    """Positions [m] and normals (s, q, 3) of the points of a surface at rest."""
    surface, points, length = placed
    x, normal, _ = points_of(points, surface.sides, surface.N, surface.dN)
    return x * length, normal
