"""Winding force: the force of threads around the axis of a body, per length along it."""

from dataclasses import replace
from math import pi

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.fibers.fiber_kernels import Pieces
from turgor.core.engine.fibers.smeared import smeared_pieces, unit_axis
from turgor.core.engine.fibers.tension import piece_tension, smooth_tension, tangents
from turgor.core.engine.fibers.thread_rest import ThreadRest
from turgor.core.model.fibers import DISCRETE, SMEARED, Fibers, Winding
from turgor.core.results.fields.state_fields import StateFields
from turgor.foundation.errors import TurgorError
from turgor.units import m

Array = NDArray[np.float64]


def winding_force(at: StateFields) -> float:
    """Force of the threads around the axis for each current length along it, in the middle of the wound faces [N/m].

    End walls and supports stop a tube from widening, so threads near them carry less: the mean counts the middle half
    along the axis, its middle most (`_weight`). For hoops the force is the tension of one thread times threads per
    length: of a tube with the radius b on which the winding presses with q it is q b. Of a thread at an angle to the
    axis the component around it counts, T sin²α over the distance along the axis. Windings of the same faces add up; of
    several faces the largest counts.

    Parameters
    ----------
    at : StateFields
    """
    wound = [fibers for fibers in at.model.reinforcements if not fibers.embedded]
    if not wound:
        raise TurgorError("the model has no fibers on a face.")
    total: dict[object, float] = {}
    for fibers in wound:
        place = (frozenset(fibers.faces), fibers.within)
        total[place] = total.get(place, 0.0) + _force_around(at, fibers)
    return max(total.values())


def _force_around(at: StateFields, fibers: Fibers) -> float:
    """Part of one winding: ∫ T sin²α ds over the current area of the face, s along the threads [N/m]."""
    pieces = at.facts.threads(fibers).pieces if fibers.form == DISCRETE else smeared_pieces(at.mesh, fibers)
    tangent = tangents(pieces, at.points)
    stretch = np.linalg.norm(tangent, axis=1)
    rest = ThreadRest.of(at.model.states_of(fibers.name), at.state.load_factor)
    own = piece_tension(fibers, stretch / rest.length, rest)
    tension = smooth_tension(pieces, own)  # hoops near edges of sides hold half as much
    force = tension * pieces.stiffness / fibers.stretching_stiffness  # smeared ones: per width
    hoops, straight = (_laid(at, fibers, angle) for angle in (pi / 2, 0.0))
    around, along = tangents(hoops, at.points), tangents(straight, at.points)
    normal = np.cross(around, along)
    across = np.cross(normal, around)  # in the surface, and perpendicular to the circumference
    lengthwise = _of_sides(hoops, across / np.linalg.norm(across, axis=1)[:, None], pieces)
    share = 1 - (np.einsum("ki,ki->k", tangent, lengthwise) / stretch) ** 2
    ends = _ends(at, hoops, fibers)
    here, there = pieces.weights * _weight(at, pieces, fibers, ends), hoops.weights * _weight(at, hoops, fibers, ends)
    if not here.sum() > 0:  # hoops so far apart that none lies in the middle
        here, there = pieces.weights, hoops.weights
    # the threads are as dense everywhere: of the middle their mean counts, not how many hoops happen to lie there
    mean, widening = (here * stretch * force) @ share / here.sum(), there @ np.linalg.norm(normal, axis=1) / there.sum()
    return float(mean * pieces.weights.sum() / hoops.weights.sum() / widening)


def _ends(at: StateFields, hoops: Pieces, fibers: Fibers) -> tuple[float, float] | None:
    """Where the winding of the whole actuator begins and ends along its axis at rest [m]; None on one long cell."""
    along = _places(at, hoops, fibers)
    low, high = float(along.min()), float(along.max())
    for name in at.mesh.symmetry_faces:
        level = at.mesh.points[at.mesh.face_nodes(name)] @ unit_axis(fibers.wound)
        if np.ptp(level) < 1e-6 * (high - low):  # a plane across the axis: the other half goes on beyond it
            low, high = min(low, 2 * float(level.mean()) - high), max(high, 2 * float(level.mean()) - low)
    inside = np.abs(along - (low + high) / 2) < (high - low) / 4
    return (low, high) if inside.any() else None


def _weight(at: StateFields, pieces: Pieces, fibers: Fibers, ends: tuple[float, float] | None) -> Array:
    """Weight of each piece: 1 in the middle between the ends, falling to 0 a quarter of the length away from it.

    It falls in a straight line, so that a hoop more or less in the middle half hardly counts.
    """
    if ends is None:
        return np.ones(len(pieces.weights))
    low, high = ends
    away = np.abs(_places(at, pieces, fibers) - (low + high) / 2) / (high - low)
    return np.asarray(np.maximum(1 - 4 * away, 0.0))


def _places(at: StateFields, pieces: Pieces, fibers: Fibers) -> Array:
    """Places of pieces along the axis at rest, (k,) [m]."""
    return np.asarray(np.einsum("ka,ka->k", pieces.middle, (at.mesh.points @ unit_axis(fibers.wound))[pieces.sides]))


def _laid(at: StateFields, fibers: Fibers, angle: float) -> Pieces:
    """Pieces at the integration points of the wound face that run at an angle from the axis."""
    winding = Winding(angle_from_axis=angle, spacing=1 * m, axis=fibers.wound.axis)
    return smeared_pieces(at.mesh, replace(fibers, form=SMEARED, bending=False, winding=winding))


def _of_sides(known: Pieces, vectors: Array, requested: Pieces) -> Array:
    """Mean direction of vectors (k, 3) in the side of each requested piece, of length one."""
    rows, place = np.unique(np.concatenate([known.sides, requested.sides]), axis=0, return_inverse=True)
    here, there = np.split(place.ravel(), [len(known.sides)])
    mean = np.stack([np.bincount(here, component, minlength=len(rows)) for component in vectors.T], axis=1)
    chosen = mean[there]
    return np.asarray(chosen / np.maximum(np.linalg.norm(chosen, axis=1), 1e-300)[:, None])
