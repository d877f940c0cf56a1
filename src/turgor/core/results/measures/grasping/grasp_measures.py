"""Measures of a grasp: forces on bodies, share of Coulomb's limit that friction takes, force closure margin."""

import numpy as np

from turgor.core.meshing.bodies.assembly import SURFACE
from turgor.core.meshing.bodies.named import named_bodies
from turgor.core.results.fields.state_fields import StateFields
from turgor.core.results.measures.grasping.force_closure import force_closure_margin
from turgor.core.results.measures.grasping.grasp_contacts import contact_force_on, grasp_contacts
from turgor.core.results.measures.measure import Measure
from turgor.core.solvers.solution import Solution

#: Endings of the names of these measures.
FORCE, FRICTION_USE, MARGIN = "_contact_force", "_friction_use", "_grasp_margin"


def contact_force(body: str) -> Measure:
    """Make the measure of the force of all contacts on one body, by its name.

    Examples
    --------
    >>> contact_force("finger_1").name
    'finger_1_contact_force'
    """
    return Measure(
        name=f"{body}{FORCE}", unit="N", function=lambda at: float(np.linalg.norm(contact_force_on(at, body))),
        definition=f"magnitude of the force of all contacts on the body {body}, all of it where mirror planes cut it",
    )  # fmt: skip


def friction_use(object: str) -> Measure:
    """Make the measure of how near a grasped object is to slipping, by its name: a body or an obstacle.

    Examples
    --------
    >>> friction_use("ball").name
    'ball_friction_use'
    """
    return Measure(
        name=f"{object}{FRICTION_USE}", unit="", function=lambda at: _friction_use(at, object),
        definition=f"friction on {object} over Coulomb's limit, summed over all places where it is touched: 0 where "
        "nothing rubs, 1 where all of it slips",
    )  # fmt: skip


def grasp_margin(object: str) -> Measure:
    """Make the measure of the force closure margin of a grasped object, by its name: a body or an obstacle.

    Examples
    --------
    >>> grasp_margin("ball").name
    'ball_grasp_margin'
    """
    return Measure(
        name=f"{object}{MARGIN}", unit="", function=lambda at: _margin(at, object),
        definition=f"force closure margin of {object} (Ferrari and Canny): the smallest disturbance, over the pressing "
        "force, that contacts where it is touched cannot resist; 0 without force closure",
    )  # fmt: skip


def grasp_measures_of(solution: Solution) -> tuple[Measure, ...]:
    """Return the measures that a response has by itself: forces on named bodies that touch, the grasp of rigid ones.

    Parameters
    ----------
    solution : Solution

    Returns
    -------
    tuple of Measure
    """
    model = solution.model
    names = named_bodies(model.mesh) if any(state.touches for state in solution.states) else {}
    own = model.contact.self_contact
    rubs = own is not None and own.friction > 0 and len(names) > 1
    chosen = [contact_force(name) for name in names]
    for point in model.points.values():
        if rubs and point.name in names and point.face.startswith(SURFACE):
            chosen += [friction_use(point.name), grasp_margin(point.name)]
    return tuple(chosen)


def grasp_measure(name: str) -> Measure | None:
    """Return the measure of a name such as ``ball_grasp_margin``; None if it is no such name.

    Examples
    --------
    >>> grasp_measure("ball_friction_use").unit
    ''
    """
    for ending, make in ((FORCE, contact_force), (FRICTION_USE, friction_use), (MARGIN, grasp_margin)):
        if name.endswith(ending) and name != ending:
            return make(name.removesuffix(ending))
    return None


def _friction_use(at: StateFields, name: str) -> float:
    touched = grasp_contacts(at, name)
    pressing = np.einsum("ki,ki->k", touched.forces, touched.normals)
    rubbing = np.linalg.norm(touched.forces - pressing[:, None] * touched.normals, axis=1)
    limit = touched.friction * pressing.sum()
    return float(rubbing.sum() / limit) if limit else 0.0


def _margin(at: StateFields, name: str) -> float:
    touched = grasp_contacts(at, name)
    return force_closure_margin(
        touched.points, touched.normals, friction=touched.friction, center=touched.center, length=touched.length
    )
