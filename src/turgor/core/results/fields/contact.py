"""Contact in a state: forces of the whole actuator, areas, pressures, penetration."""

from collections.abc import Iterable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from turgor.core.model.contact import SELF
from turgor.core.model.model import Model
from turgor.core.model.obstacles import Obstacle
from turgor.core.model.obstacles.pose import Pose
from turgor.core.results.fields.state_fields import StateFields
from turgor.core.solvers.solution import State
from turgor.foundation.display import brief

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ContactResult:
    """Results of one contact in one state.

    Parameters
    ----------
    name : str
        Name of the obstacle, or ``"self"``.
    force : (3,) array [N]
        Force of the whole actuator on the obstacle; zero for the contact with itself.
    pressing : float [N]
        Force with which the surfaces press each other, however it is directed: that of all places together.
    area : float [m²]
        Contact area on the deformed surface of the whole actuator; both walls count where the actuator meets itself.
    pressure : float [Pa]
        Largest contact pressure.
    penetration : float [m]
        Deepest penetration.
    share : float [-]
        Penetration as a share of what the tolerance allows there, at the worst place.
    """

    name: str
    force: Array
    pressing: float
    area: float
    pressure: float
    penetration: float
    share: float

    __repr__ = brief


def contact_results(state: State | StateFields) -> tuple[ContactResult, ...]:
    """Read every contact off a state.

    Parameters
    ----------
    state : State or StateFields

    Returns
    -------
    tuple of ContactResult
        The contact of the actuator with itself first, then obstacles in the order of the model.
    """
    at = state if isinstance(state, StateFields) else StateFields(state)
    names = [SELF, *(obstacle.name for obstacle in at.model.contact.obstacles)]
    out = []
    for name in names:
        if name in at.state.touches:
            touch = at.state.touches[name]
            sides = 0.5 if name == SELF else 1.0  # each of two walls has the force of the other
            out.append(
                ContactResult(
                    name=name,
                    force=contact_force(at, name) if name != SELF else np.zeros(3),
                    pressing=float(sides * at.mesh.symmetry_factor * np.linalg.norm(touch.force, axis=1).sum()),
                    area=at.mesh.symmetry_factor * touch.area,
                    pressure=float(touch.pressure.max(initial=0.0)),
                    penetration=touch.penetration,
                    share=touch.share,
                )
            )
    return tuple(out)


def contact_force(at: StateFields, name: str) -> Array:
    """Force of the whole actuator on an obstacle, (3,) [N]; zero where it is not touched."""
    touch = at.state.touches.get(name)
    if touch is None:
        return np.zeros(3)
    return at.facts.of_whole(-at.mesh.symmetry_factor * touch.force.sum(axis=0))


def pose_of(at: StateFields, obstacle: Obstacle) -> Pose:
    """Where an obstacle is in a state [m]."""
    touch, pose = at.state.touches.get(obstacle.name), obstacle.pose(at.state.load_factor)
    return pose if touch is None else replace(pose, place=touch.place)


def contact_moment(at: StateFields, name: str) -> Array:
    """Moment of the whole actuator on an obstacle about the point about which it turns, (3,) [N m].

    By default that is the middle of its shape. It moves with the obstacle.
    """
    touch = at.state.touches.get(name)
    if touch is None:
        return np.zeros(3)
    (obstacle,) = (each for each in at.model.contact.obstacles if each.name == name)
    about = np.array(obstacle.about or obstacle.shape.middle) + touch.place
    moment = -at.mesh.symmetry_factor * np.cross(at.points - about, touch.force).sum(axis=0)
    for plane in at.facts.mirrors:  # an image turns the other way about axes in the mirror
        moment[[axis for axis in range(3) if axis != plane.axis]] = 0.0
    return moment if at.mesh.wedge is None else at.mesh.wedge.mean(moment)


def drawn_obstacles(model: Model) -> tuple[Obstacle, ...]:
    """Return the obstacles that are bodies: all but the mirror planes between the fingers of a grasp."""
    return tuple(each for each in model.contact.obstacles if each.drawn)


def extents_of(states: Iterable[StateFields]) -> dict[str, Array]:
    """Measure the room that the whole actuator takes in some states, and each face that an obstacle is meant for.

    Parameters
    ----------
    states : iterable of StateFields
        At least one, of one path.

    Returns
    -------
    dict of str to (2, 3) array [m]
        Least and greatest coordinates by the name of the face, ``""`` for the whole.
    """
    out: dict[str, Array] = {}
    for at in states:
        faces = {each.face for each in at.model.contact.obstacles if each.face is not None}
        for name in ("", *faces):
            points = at.points if name == "" else at.points[at.mesh.face_nodes(name)]
            whole = np.concatenate([image.of(points) for image in at.facts.images])
            ends = np.stack([whole.min(axis=0), whole.max(axis=0)])
            known = out.get(name, ends)
            out[name] = np.stack([np.minimum(known[0], ends[0]), np.maximum(known[1], ends[1])])
    return out
