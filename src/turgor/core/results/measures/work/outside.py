"""Outside loads: the work of an actuator on weights, dead forces, springs and what is fixed and moved."""

from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.algebra.boundary import prescribed_components
from turgor.core.engine.cells import kernels_geometry
from turgor.core.engine.cells.element import element_of
from turgor.core.engine.faces.dead_loads import dead_terms
from turgor.core.engine.points.motion import carrier_displacement
from turgor.core.engine.points.point_unknowns import with_carrier_points
from turgor.core.engine.term import Configuration, Setting
from turgor.core.model.loads import Load
from turgor.core.model.model import Model
from turgor.core.results.fields.contact import pose_of
from turgor.core.results.fields.state_fields import StateFields
from turgor.core.results.measures.work.fluid import fluid_works
from turgor.foundation.errors import TurgorError
from turgor.foundation.round_off import ROUND_OFF

Array = NDArray[np.float64]


def outside_works(path: Sequence[StateFields]) -> Array:
    """Work of the whole actuator on outside loads up to each state of a path, (n,) [J].

    Between two states forces count with their means, as in `fluid_works`.

    Parameters
    ----------
    path : sequence of StateFields
    """
    model = path[0].model
    loads = [load for load in model.loads if load.outside]
    moved = any(each.moves for each in model.supports)
    if not loads and not moved and not model.contact.obstacles:
        raise TurgorError(
            "the model has no outside load: no force, hanging weight or obstacle, and no face that is moved. Its "
            "fluid only strains the rubber."
        )
    steps = np.zeros(len(path) - 1)
    whole = model.mesh.symmetry_factor
    if loads:
        force, way = _dead(path, loads)
        steps -= whole * np.einsum("kni,kni->k", force, way)
    if moved:
        forces, ways = (np.array([getattr(at.state, name) for at in path]) for name in ("nodal_force", "displacement"))
        steps -= whole * np.einsum("kni,kni->k", (forces[1:] + forces[:-1]) / 2, np.diff(ways, axis=0))
    for obstacle in model.contact.obstacles:
        steps += whole * _on_obstacle(path, obstacle.name)
    return np.concatenate([[0.0], np.cumsum(steps)])


def efficiencies(path: Sequence[StateFields]) -> Array:
    """Work on outside loads over work of the fluid up to each state of a path, (n,); nan before the fluid works."""
    fluid = fluid_works(path)
    done = np.abs(fluid) > ROUND_OFF.same * np.abs(fluid).max()
    out = np.full(len(path), np.nan)
    out[done] = outside_works(path)[done] / fluid[done]
    return out


def _dead(path: Sequence[StateFields], loads: list[Load]) -> tuple[Array, Array]:
    """Mean forces (n - 1, k, 3) [N] of dead loads in each step, and ways (n - 1, k, 3) [m] of the nodes."""
    model = replace(path[0].model, loads=tuple(loads))
    setting, carriers = _setting(model)
    terms = dead_terms(setting)
    forces, moved = [], []
    for at in path:
        force = np.zeros_like(setting.points)
        for term in terms:
            term.add_forces(force, Configuration(setting.points, at.state.load_factor, None))
        own = carrier_displacement(carriers, (1.0, 1.0), at.displacement, at.state.points)
        forces.append(force)
        moved.append(np.concatenate([at.displacement, own]))
    force = np.array(forces)
    return (force[1:] + force[:-1]) / 2, np.diff(np.array(moved), axis=0)


def _setting(model: Model) -> tuple[Setting, tuple]:
    """Setting of the loads of a model, in SI units, and its reference points."""
    supports, element, points = prescribed_components(model), element_of(model), model.mesh.points
    table = element.tables
    _, volume = kernels_geometry.reference_geometry(element.shape, points, element.cells, table.dN, table.weights)
    rest = with_carrier_points(points, supports.carriers)
    return Setting(model, rest, supports.along_axes, volume, 1.0, 1.0), supports.carriers


def _on_obstacle(path: Sequence[StateFields], name: str) -> Array:
    """Work of the modeled part on an obstacle in each step of a path, (n - 1,) [J]."""
    forces, moments, poses = np.zeros((len(path), 3)), np.zeros((len(path), 3)), []
    for number, at in enumerate(path):
        (obstacle,) = (each for each in at.model.contact.obstacles if each.name == name)
        poses.append(pose_of(at, obstacle))
        touch = at.state.touches.get(name)
        if touch is not None:
            forces[number] = -touch.force.sum(axis=0)
            moments[number] = np.cross(at.points - poses[-1].pivot, -touch.force).sum(axis=0)
    ways = np.diff([pose.place for pose in poses], axis=0)
    turns = np.array([after.turned_since(before) for before, after in pairwise(poses)]).reshape(-1, 3)
    work = (forces[1:] + forces[:-1]) * ways + (moments[1:] + moments[:-1]) * turns
    return np.asarray(work.sum(axis=1) / 2)
