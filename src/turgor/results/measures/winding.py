"""Winding force: the force of threads around the axis of a body, per length along it."""

from dataclasses import replace
from math import pi

import numpy as np
from numpy.typing import NDArray

from turgor.engine.fibers.fiber_kernels import Pieces
from turgor.engine.fibers.smeared import smeared_pieces
from turgor.errors import TurgorError
from turgor.model.fibers import DISCRETE, SMEARED, Fibers, Winding
from turgor.results.fields.fibers import piece_tension, tangents
from turgor.results.fields.state_fields import StateFields
from turgor.units import m

Array = NDArray[np.float64]


def winding_force(at: StateFields) -> float:
    """Force of the threads around the axis for each current length along it, mean over the wound faces [N/m].

    For hoops that is the tension of one thread times threads per length: of a tube with the radius b on which the
    winding presses with q it is q b. Of a thread at an angle to the axis the component around it counts, T sin²α over
    the distance along the axis. Windings of the same faces add up; of several faces the largest counts.

    Parameters
    ----------
    at : StateFields
    """
    if not at.model.reinforcements:
        raise TurgorError("the model has no fibers.")
    total: dict[object, float] = {}
    for fibers in at.model.reinforcements:
        place = (frozenset(fibers.faces), fibers.within)
        total[place] = total.get(place, 0.0) + _force_around(at, fibers)
    return max(total.values())


def _force_around(at: StateFields, fibers: Fibers) -> float:
    """Part of one winding: ∫ T sin²α ds over the current area of the face, s along the threads [N/m]."""
    pieces = at.facts.threads(fibers).pieces if fibers.form == DISCRETE else smeared_pieces(at.mesh, fibers)
    tangent = tangents(pieces, at.points)
    stretch = np.linalg.norm(tangent, axis=1)
    force = piece_tension(fibers, stretch) * pieces.stiffness / fibers.stretching_stiffness  # smeared ones: per width
    hoops, straight = (_laid(at, fibers, angle) for angle in (pi / 2, 0.0))
    around, along = tangents(hoops, at.points), tangents(straight, at.points)
    normal = np.cross(around, along)
    across = np.cross(normal, around)  # in the surface, and perpendicular to the circumference
    lengthwise = _of_sides(hoops, across / np.linalg.norm(across, axis=1)[:, None], pieces)
    share = 1 - (np.einsum("ki,ki->k", tangent, lengthwise) / stretch) ** 2
    area = float(hoops.weights @ np.linalg.norm(normal, axis=1))
    return float((pieces.weights * stretch * force) @ share) / area


def _laid(at: StateFields, fibers: Fibers, angle: float) -> Pieces:
    """Pieces at the integration points of the wound face that run at an angle from the axis."""
    winding = Winding(angle_from_axis=angle, spacing=1 * m, axis=fibers.winding.axis)
    return smeared_pieces(at.mesh, replace(fibers, form=SMEARED, bending=False, winding=winding))


def _of_sides(known: Pieces, vectors: Array, wanted: Pieces) -> Array:
    """Mean direction of vectors (k, 3) in the side of each wanted piece, of length one."""
    rows, place = np.unique(np.concatenate([known.sides, wanted.sides]), axis=0, return_inverse=True)
    here, there = np.split(place.ravel(), [len(known.sides)])
    mean = np.stack([np.bincount(here, component, minlength=len(rows)) for component in vectors.T], axis=1)
    chosen = mean[there]
    return np.asarray(chosen / np.maximum(np.linalg.norm(chosen, axis=1), 1e-300)[:, None])
