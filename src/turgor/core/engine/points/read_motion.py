"""read_motion: the motions of reference points, read from an evaluation of the equations."""

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.evaluation import Evaluation
from turgor.core.engine.points.bearing_term import BearingTerm
from turgor.core.engine.points.motion import PointMotion
from turgor.core.engine.points.point_unknowns import Carrier
from turgor.core.engine.points.spring_term import SpringTerm
from turgor.core.engine.system import System

Array = NDArray[np.float64]


def motions(system: System, at: Evaluation) -> dict[str, PointMotion]:
    """Motions of all reference points at an evaluation, by their names.

    Parameters
    ----------
    system : System
    at : Evaluation

    Returns
    -------
    dict of str to PointMotion
    """
    if not system.carriers:
        return {}
    u = system.split(at.unknowns)[0]
    unit = system.stress_scale * system.length**2
    forces = system.by_node(at.residual)
    for term in system.terms.all:
        if isinstance(term, SpringTerm | BearingTerm):  # what is left besides these comes from supports and these
            sprung = np.zeros_like(forces)
            term.add_forces(sprung, system.configuration(at))
            forces = forces - sprung
    motions = {}
    for each in system.carriers:
        arrows = u[each.arrows] + each.radius / system.length * np.eye(3)
        motions[each.point.name] = PointMotion(
            displacement=u[each.node] * system.length,
            rotation=arrows.T * system.length / each.radius,
            force=_of_whole(system, each, forces[each.node] * unit, False),
            moment=_of_whole(system, each, _moment(arrows, forces[each.arrows]) * unit * system.length, True),
            multipliers=u[each.multipliers] * unit,
        )
    return motions


def _moment(arrows: Array, forces: Array) -> Array:
    return np.asarray(np.cross(arrows, forces).sum(axis=0))


def _of_whole(system: System, carrier: Carrier, vector: Array, axial: bool) -> Array:
    """A force or an axial moment together with its images (3,)."""
    out = vector * system.model.mesh.symmetry_factor
    none = [k for k in range(3) if k not in carrier.turning] if axial else list(carrier.blocked)
    out[none] = 0.0
    return np.asarray(out)
