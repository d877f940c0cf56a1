"""Equations of rods: residual of equilibrium and its tangent at a state, and the solution of the linear system."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from turgor.core.model.loads import Gravity
from turgor.fast_models.rod.band import Band
from turgor.fast_models.rod.elements import ElementForces, Law, element_forces
from turgor.fast_models.rod.frames import cross_matrix
from turgor.fast_models.rod.layout import Layout, layout_of, nodal_mass, shares_of_ends
from turgor.fast_models.rod.loads import ChamberPressure, LineLoad, PlateForce
from turgor.fast_models.rod.model import RodModel
from turgor.fast_models.rod.state import RodState

Array = NDArray[np.float64]

#: Stiffness of contact over that of an element in bending. The result does not depend on it. A point leaves a plane
#: when its force is negative; what is left of its gap counts by the stiffness of the rod, not by this large one.
PENALTY = 1e3


@dataclass(frozen=True, slots=True, eq=False)
class PointLoads:
    """Forces at points fixed to nodes: dead ones in the axes of space, following ones in those of the node.

    Parameters
    ----------
    node : (p,) array
    at : (p, 3) array [m]
        In the axes of the node.
    dead, dead_moment : (p, 3) arrays [N], [N m]
    following : (p, 6) array [N, N m]
    """

    node: NDArray[np.intp]
    at: Array
    dead: Array
    dead_moment: Array
    following: Array


@dataclass(frozen=True, slots=True, eq=False)
class Evaluation:
    """Residual and tangent at a state.

    Parameters
    ----------
    elements : ElementForces
    residual : (n, 6) array [N, N m]
        Internal less external wrench on every node, in its own axes.
    blocks : (e, 2, 2, 6, 6) array
        Tangent of the elements.
    own : (n, 6, 6) array
        Tangent of each node by its own motion: loads, contact.
    touches : (k, p) array of bool
        Which points press on which planes.
    contact : (k, p) array [N]
        Forces of the planes with the penetration that is left; zero where a point does not press.
    contact_rows : (k, p, 6) array
        How far a point leaves a plane by the twist of its node.
    """

    elements: ElementForces
    residual: Array
    blocks: Array
    own: Array
    touches: NDArray[np.bool_]
    contact: Array
    contact_rows: Array


class RodSystem:
    """The discrete equations of a model.

    Parameters
    ----------
    model : RodModel
    """

    def __init__(self, model: RodModel) -> None:
        self.model = model
        self.layout = layout_of(model)
        self.band = Band(self.layout)
        self.rest_strain = np.array([rod.rest_strain for rod in model.rods])[self.layout.rod] + np.eye(6)[0]
        self.size = float(max(rod.length for rod in model.rods))
        self.touching = _contact_points(model, self.layout)
        stiffness = _largest_stiffness(model)
        self.penalty = PENALTY * stiffness
        self.release = stiffness / max(rod.elements for rod in model.rods) ** 3
        self._places = (6 * self.layout.ends[:, :, None] + np.arange(6)).ravel()
        self._masses = nodal_mass(model, self.layout) if any(isinstance(x, Gravity) for x in model.loads) else None
        self._spread = [(load, *self._spread_of(load)) for load in model.loads if not isinstance(load, ChamberPressure)]
        self._points, self._of_load = _gathered(self._spread)
        self._laws: dict[tuple[float, ...], Law] = {}

    def start(self) -> RodState:
        """Return the state at rest."""
        return RodState(
            turn=self.layout.turn,
            position=self.layout.position,
            force=np.zeros((len(self.layout.ends), 6)),
            contact=np.zeros((len(self.model.planes), len(self.touching[0]))),
        )

    def pressures(self, load_factor: float) -> list[dict[str, float]]:
        """Return the pressure in the chambers of each rod [Pa]."""
        by_rod: list[dict[str, float]] = [{c.name: 0.0 for c in rod.section.chambers} for rod in self.model.rods]
        for load in self.model.loads:
            if isinstance(load, ChamberPressure):
                for rod, own in zip(self.model.rods, by_rod, strict=True):
                    if load.rod in (None, rod.name) and load.chamber in own:
                        own[load.chamber] += load.share(load_factor) * load.pressure
        return by_rod

    def law(self, load_factor: float) -> Law:
        """Return compliance and rest strains of the elements under the pressures at a load factor."""
        every = self.pressures(load_factor)
        key = tuple(value for own in every for value in own.values())
        if key not in self._laws:
            if len(self._laws) > 1:
                self._laws.clear()
            self._laws[key] = self._make_law(every)
        return self._laws[key]

    def pressure_wrench(self, load_factor: float) -> Array:
        """Return the force and moment that the pressure takes of each element, (e, 6)."""
        wrenches = [
            sum((own[c.name] * c.wrench_by_pressure for c in rod.section.chambers), np.zeros(6))
            for rod, own in zip(self.model.rods, self.pressures(load_factor), strict=True)
        ]
        return np.array(wrenches)[self.layout.rod]

    def evaluate(self, state: RodState) -> Evaluation:
        """Return residual and tangent at a state and its load factor.

        Raises
        ------
        TurgorError
            If an element turns too far, or a table does not hold a pressure.
        """
        layout = self.layout
        turn = state.turn[layout.ends] @ layout.end_turn
        position = state.position[layout.ends] + (state.turn[layout.ends] @ layout.end_position[..., None])[..., 0]
        back = np.swapaxes(turn[:, 0], 1, 2)
        shift = (back @ (position[:, 1] - position[:, 0])[:, :, None])[:, :, 0]
        elements = element_forces(self.law(state.load_factor), back @ turn[:, 1], shift, state.force)
        to_node = np.swapaxes(layout.to_end, -1, -2)
        ends = (to_node @ np.stack([elements.first, elements.second], axis=1)[..., None])[..., 0]
        summed = np.bincount(self._places, ends.ravel(), layout.free.size)
        residual = np.asarray(summed, dtype=np.float64).reshape(-1, 6)
        blocks = to_node[:, :, None] @ elements.blocks @ layout.to_end[:, None]
        own = np.zeros((len(residual), 6, 6))
        _add_loads(self.loads(state.load_factor), state, residual, own)
        touches, pressed, rows = self._add_contact(state, residual, own)
        return Evaluation(
            elements=elements, residual=residual, blocks=blocks, own=own,
            touches=touches, contact=pressed, contact_rows=rows,
        )  # fmt: skip

    def loads(self, load_factor: float) -> PointLoads:
        """Return the loads at nodes at a load factor."""
        share = np.array([load.share(load_factor) for load, *_ in self._spread])[self._of_load][:, None]
        where = self._points
        return PointLoads(where.node, where.at, share * where.dead, share * where.dead_moment, share * where.following)

    def penetration(self, state: RodState) -> Array:
        """Return how deep the points of contact are inside the planes, (k, p) [m]; negative outside."""
        node, at, radius = self.touching
        place = state.position[node] + (state.turn[node] @ at[:, :, None])[:, :, 0]
        rows = [radius - (place - np.array(plane.point)) @ np.array(plane.normal) for plane in self.model.planes]
        return np.array(rows).reshape(len(self.model.planes), len(node))

    def _make_law(self, pressures: list[dict[str, float]]) -> Law:
        compliance, strain = [], []
        for rod, own in zip(self.model.rods, pressures, strict=True):
            stiffness, shift, wrench = np.array(rod.section.stiffness), np.zeros(6), np.zeros(6)
            for chamber in rod.section.chambers:
                wrench += own[chamber.name] * chamber.wrench_by_pressure
                if chamber.table is not None:
                    shift += chamber.table.strain_at(own[chamber.name])
                    stiffness += chamber.table.added_stiffness(own[chamber.name])
            compliance.append(np.linalg.inv(stiffness))
            strain.append(shift + compliance[-1] @ wrench)
        which = self.layout.rod
        return Law(self.layout.length, np.array(compliance)[which], self.rest_strain + np.array(strain)[which])

    def _spread_of(self, load: PlateForce | LineLoad | Gravity) -> tuple[NDArray[np.intp], Array, Array, Array]:
        """Nodes, levers, forces and moments of a load."""
        layout = self.layout
        match load:
            case PlateForce():
                where = np.array([self.model.plate_names.index(load.plate)])
                return where, np.array([load.at]), np.array([load.force]), np.array([load.moment])
            case LineLoad():
                names = np.array([load.rod in (None, rod.name) for rod in self.model.rods])
                chosen = np.flatnonzero(names[layout.rod])
                lever = (layout.end_position + shares_of_ends(layout))[chosen].reshape(-1, 3)
                force = np.repeat(layout.length[chosen] / 2, 2)[:, None] * np.array(load.force)
                if load.follows:
                    force = np.einsum("eij,ej->ei", layout.end_turn[chosen].reshape(-1, 3, 3), force)
                return layout.ends[chosen].ravel(), lever, force, np.zeros_like(force)
        assert self._masses is not None
        mass, first, _ = self._masses
        fall = np.array(load.direction, dtype=np.float64)
        force = mass[:, None] * load.acceleration * fall / np.linalg.norm(fall)
        return np.arange(len(mass)), first / mass[:, None], force, np.zeros_like(force)

    def _add_contact(self, state: RodState, residual: Array, own: Array) -> tuple[NDArray[np.bool_], Array, Array]:
        """Add the forces of the planes at points that press, and their stiffness; return forces and directions.

        The force of the last update turns with the node's axes in the tangent; what the penetration adds does not,
        because it is a large number only until the next update removes it.
        """
        node, at, _ = self.touching
        pressed, rows = np.zeros((len(self.model.planes), len(node))), np.zeros((len(self.model.planes), len(node), 6))
        touches = pressed > 0
        if not self.model.planes:
            return touches, pressed, rows
        back = np.swapaxes(state.turn[node], 1, 2)
        for k, (plane, depth) in enumerate(zip(self.model.planes, self.penetration(state), strict=True)):
            along = back @ np.array(plane.normal)
            rows[k] = np.concatenate([along, np.cross(at, along)], axis=1)
            touches[k] = state.contact[k] + self.release * depth > 0
            pressed[k] = np.where(touches[k], state.contact[k] + self.penalty * depth, 0.0)
            np.subtract.at(residual, node, pressed[k][:, None] * rows[k])
            stiff = self.penalty * rows[k][:, :, None] * rows[k][:, None, :]
            stiff += _turning(state.contact[k][:, None] * along, at)
            np.add.at(own, node[touches[k]], stiff[touches[k]])
        return touches, pressed, rows


def _add_loads(loads: PointLoads, state: RodState, residual: Array, own: Array) -> None:
    """Add loads to the residual and to the tangents of the nodes."""
    if not len(loads.node):
        return
    back = np.swapaxes(state.turn[loads.node], 1, 2)
    force = (back @ loads.dead[:, :, None])[:, :, 0]
    moment = (back @ loads.dead_moment[:, :, None])[:, :, 0]
    lifted = (cross_matrix(loads.at) @ force[:, :, None])[:, :, 0]
    np.subtract.at(residual, loads.node, np.concatenate([force, lifted + moment], axis=1) + loads.following)
    turned = _turning(force, loads.at)
    turned[:, 3:, 3:] -= cross_matrix(moment)
    np.add.at(own, loads.node, turned)


def _turning(force: Array, at: Array) -> Array:
    """Tangent of dead forces, which turn backwards in the axes of a node that turns, (p, 6, 6)."""
    tangents = np.zeros((len(force), 6, 6))
    hat = cross_matrix(force)
    tangents[:, :3, 3:], tangents[:, 3:, 3:] = -hat, -cross_matrix(at) @ hat
    return tangents


def _gathered(spread: list[tuple[Any, ...]]) -> tuple[PointLoads, NDArray[np.intp]]:
    """Return all loads at their full size, and which load each point belongs to."""
    none = np.zeros((0, 3))
    parts: list[tuple[Array, ...]] = [(np.zeros(0, np.intp), none, none, none, np.zeros((0, 6)))]
    for load, node, at, force, moment in spread:
        zero = np.zeros_like(force)
        wrench = np.concatenate([force, moment + np.cross(at, force)], axis=1)
        if not isinstance(load, Gravity) and load.follows:
            parts.append((node, at, zero, zero, wrench))
        else:
            parts.append((node, at, force, moment, 0 * wrench))
    which = np.repeat(np.arange(len(spread)), [len(each[1]) for each in spread])
    return PointLoads(*(np.concatenate(each) for each in zip(*parts, strict=True))), which


def _largest_stiffness(model: RodModel) -> float:
    """Return the largest bending stiffness of an element over the cube of its length [N/m]."""
    every = []
    for rod in model.rods:
        stiffness = np.asarray(rod.section.stiffness)
        every.append(max(stiffness[4, 4], stiffness[5, 5]) * (rod.elements / rod.length) ** 3)
    return float(max(every))


def _contact_points(model: RodModel, layout: Layout) -> tuple[NDArray[np.intp], Array, Array]:
    """Nodes, places in their axes and contact radii of the points that may touch planes."""
    node, at, radius = [], [], []
    for rod, own in zip(model.rods, layout.nodes, strict=True):
        places = np.zeros((len(own), 3))
        places[0], places[-1] = rod.start_at.position, rod.end_at.position
        is_fixed = ~layout.free[own].any(axis=1)
        node.append(own[~is_fixed])
        at.append(places[~is_fixed])
        radius.append(np.full((~is_fixed).sum(), rod.section.contact_radius))
    return np.concatenate(node), np.concatenate(at), np.concatenate(radius)
