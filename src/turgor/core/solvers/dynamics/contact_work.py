"""Work of contacts: the work of moving obstacles on the body, and the energy that friction dissipates."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.contact.part import Gaps
from turgor.core.engine.system import Evaluation, System

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class Pushing:
    """Force of each part of the contact on the body in a state, and place of its obstacle along its path, scaled.

    Parameters
    ----------
    force : (k, 3) array
        Zeros where the body touches itself.
    place : (k, 3) array
        Of the path, without the spring that holds an obstacle.
    moment : (k, 3) array
        Moment of these forces about the point about which the obstacle turns; zeros where it does not.
    gaps : tuple of Gaps
        Those of each part.
    boosts : tuple of (s,) array
        How much stiffer than at first the sides of each part were.
    """

    force: Array
    place: Array
    moment: Array
    gaps: tuple[Gaps, ...]
    boosts: tuple[Array, ...]


def pushing(system: System, at: Evaluation) -> Pushing:
    """Return what obstacles do in a state."""
    parts = system.contact.parts
    force, place, moment = (np.zeros((len(parts), 3)) for _ in range(3))
    for k, (part, gaps) in enumerate(zip(parts, at.contacts.gaps, strict=True)):
        if part.obstacle is not None:
            forces = -part.forces(at.contacts.position, gaps)[: system.node_count]
            force[k] = forces.sum(axis=0)
            if gaps.pose.turn is not None:
                moment[k] = np.cross(at.contacts.position[: system.node_count] - gaps.pose.pivot, forces).sum(axis=0)
            place[k] = part.obstacle.displacement(at.load_factor) / system.length
    return Pushing(force, place, moment, at.contacts.gaps, tuple(part.penalty_scale.copy() for part in parts))


def work_of_contacts(system: System, before: Pushing, now: Pushing) -> float:
    """Work that moving obstacles and raised contact stiffness do between two states, by the trapezoidal rule [J].

    An obstacle on a spring is in equilibrium, so the force that moves the spring equals that of the obstacle.
    """
    work = 0.5 * float(((before.force + now.force) * (now.place - before.place)).sum())
    for moments, old, new in zip(before.moment + now.moment, before.gaps, now.gaps, strict=True):
        work += 0.5 * float(moments @ new.pose.turned_since(old.pose))
    for part, boost, old, new in zip(system.contact.parts, before.boosts, before.gaps, now.gaps, strict=True):
        work += part.stiffened(boost, old, new)
    return work * system.stress_scale * system.length**3


def taken_by_friction(system: System, at: Evaluation) -> float:
    """Energy that friction has dissipated since the last accepted state [J]."""
    parts, contacts = system.contact.parts, at.contacts
    taken = sum(part.rubbed(contacts.position, gaps) for part, gaps in zip(parts, contacts.gaps, strict=True))
    return float(taken) * system.stress_scale * system.length**3
