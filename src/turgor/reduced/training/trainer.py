"""Training: full solves along paths, whose accepted states are the snapshots of a reduced model."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from math import inf
from time import process_time

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.algebra.tangent import Tangent
from turgor.core.engine.contact.pair_part import PairPart
from turgor.core.engine.contact.part import Gaps
from turgor.core.engine.contact.shape_part import ShapePart
from turgor.core.engine.faces.pressure_term import PressureTerm
from turgor.core.engine.mass import mass_data
from turgor.core.engine.runtime import EngineOptions
from turgor.core.engine.system import System
from turgor.core.model.history import with_history
from turgor.core.model.model import Model
from turgor.core.model.obstacles.pose import Pose
from turgor.core.results.fields.contact import contact_force
from turgor.core.results.fields.state_fields import StateFields
from turgor.core.solvers.problem import Problem
from turgor.core.solvers.procedures.static import Static
from turgor.core.solvers.restart import unknowns_of
from turgor.core.solvers.solution import State
from turgor.reduced.settings import TRAINING
from turgor.reduced.states.inputs import Inputs
from turgor.reduced.training.assembly import drive_of

Array = NDArray[np.float64]

ModelAt = Callable[[Mapping[str, float]], Model]


@dataclass(frozen=True, slots=True, eq=False)
class Path:
    """A path of full solves from rest to some inputs.

    Parameters
    ----------
    inputs : (k, 1 + n) array
        Those of each state, the share of the loads that are no inputs first.
    displacements : (k, nodes, 3) array
        Scaled.
    mean_stresses : (k, m) array
        Scaled.
    derivatives : (d, nodes 3), (d, m) arrays
        Derivatives of some states by the inputs, times their ranges.
    rest : (1 + n,) array
        Inputs at rest: none but the places of obstacles.
    obstacle_forces : (k, o, 3) array [N]
        Force of the whole actuator on each obstacle.
    scales : tuple of arrays
        Factors on the penalty of each part of contact at the end.
    reached : bool
        Whether the path reached its end.
    seconds : float
    inertial : (d, nodes 3), (d, m) arrays
        Responses to the inertia of motions along the path, each of a size of one; empty without motion.
    cycle : (j, nodes, 3), (j, m) arrays
        States of a sudden load to the end of the path and back, where rubber relaxes or softens.
    """

    inputs: Array
    displacements: Array
    mean_stresses: Array
    derivatives: tuple[Array, Array]
    rest: Array
    obstacle_forces: Array
    scales: tuple[Array, ...]
    reached: bool
    seconds: float
    inertial: tuple[Array, Array] = field(default_factory=lambda: (np.zeros((0, 0)), np.zeros((0, 0))))
    cycle: tuple[Array, Array] = field(default_factory=lambda: (np.zeros((0, 0, 3)), np.zeros((0, 0))))


@dataclass(frozen=True, slots=True)
class Trainer:
    """What a path needs besides its inputs.

    Parameters
    ----------
    model_at : callable
        The model of values by key.
    inputs : Inputs
    steps : int
        Steps of a path at least.
    options : EngineOptions
    motion : bool
        Whether the reduced model shall move.
    """

    model_at: ModelAt
    inputs: Inputs
    steps: int
    options: EngineOptions
    motion: bool = False

    def path(self, values: Array, differentiated: bool = True) -> Path:
        """Solve from rest to some inputs (n,)."""
        began = process_time()
        model = self.model_at(dict(zip(self.inputs.keys, values.tolist(), strict=True)))
        system = System(model)
        tangent = Tangent(system, self.options.linear_solver, self.options.threads, self.options.iteration)
        problem = Problem(system=system, tangent=tangent, history=system.history(step=inf))
        Static(first_step=1 / self.steps, max_step=1 / self.steps).follow(problem)
        states = [state for state in problem.states if state.load_factor > 0]
        nodes, m = model.mesh.points.shape[0], system.element.mean_count
        derivatives = np.zeros((0, 3 * nodes)), np.zeros((0, m))
        inertial = derivatives
        if differentiated and states:
            some = TRAINING.differentiated if len(values) > 1 else 1  # states along the only input have its derivatives
            rates = [self._rates(system, tangent, states[place]) for place in _spread(len(states), some)]
            derivatives = _split(system, np.concatenate(rates))
            if self.motion:
                inertial = _split(system, self._inertial(system, tangent, states))
        return Path(
            inputs=np.array([self.inputs.on_path(values, state.load_factor) for state in states]),
            displacements=np.array([state.displacement for state in states]).reshape(-1, nodes, 3) / system.length,
            mean_stresses=np.array([state.mean_stress for state in states]).reshape(-1, m) / system.stress_scale,
            derivatives=derivatives,
            rest=self.inputs.on_path(values, 0.0),
            obstacle_forces=_obstacle_forces(model, states),
            scales=tuple(part.penalty_scale for part in system.contact.parts),
            reached=bool(states) and states[-1].load_factor == 1.0,
            seconds=process_time() - began,
            inertial=inertial,
            cycle=self._cycle(model),
        )

    def _cycle(self, model: Model) -> tuple[Array, Array]:
        """Scaled states of a sudden load and unloading; none where no rubber remembers."""
        loads = [with_history(load, ((0.0, 0.0), (0.5, 1.0), (1.0, 0.0))) for load in model.loads]
        system = System(replace(model, loads=tuple(loads)))
        if not system.materials.remembers:
            return np.zeros((0, len(model.mesh.points), 3)), np.zeros((0, system.element.mean_count))
        series = [material.prony for material in model.region_materials.values()]
        times = [min(each.tau) for each in series if each is not None]
        sudden = None if not times else TRAINING.sudden * min(times)
        tangent = Tangent(system, self.options.linear_solver, self.options.threads, self.options.iteration)
        problem = Problem(system=system, tangent=tangent, history=system.history(step=inf))
        step = 1 / (2 * self.steps)
        Static(first_step=step, max_step=step, duration=sudden).follow(problem)
        states = [state for state in problem.states if state.load_factor > 0]
        moved = np.array([state.displacement for state in states]) / system.length
        return moved, np.array([state.mean_stress for state in states]) / system.stress_scale

    def _inertial(self, system: System, tangent: Tangent, states: Sequence[State]) -> Array:
        """Responses to the inertia of motions along the path, then to that of these, at states along it."""
        mass, rows = mass_data(system), []
        for place in _spread(len(states), TRAINING.moving):
            for motion in self._rates(system, tangent, states[place]):
                for _ in range(TRAINING.responses):
                    size = max(float(np.linalg.norm(motion)), 1e-300)
                    force = system.layout.base.product(mass, np.where(system.moving, motion / size, 0.0))
                    motion = np.where(system.prescribed, 0.0, tangent.solve(force))
                    rows.append(motion)
        return np.array(rows)

    def _rates(self, system: System, tangent: Tangent, state: State) -> Array:
        """Derivatives (n, size) of the unknowns of a state by the inputs, times their ranges."""
        at = system.evaluate(unknowns_of(system, state), state.load_factor)
        assert at is not None
        tangent.factor(at)
        drive = drive_of(system, self.model_at, self.inputs)
        position = system.configuration(at).position
        # one face each: the system joins faces of the same pressure, whose inputs may differ
        pressed = np.array([_unit_forces(system, face, position) for face in drive.faces]).reshape(-1, *position.shape)
        rows = []
        for k, width in enumerate(self.inputs.high - self.inputs.low, start=1):
            force = drive.forces[:, k].reshape(-1, 3).copy()
            force += np.tensordot(drive.pressures[:, k], pressed, axes=1)
            for part, gaps in zip(system.contact.parts, at.contacts.gaps, strict=True):
                if part.obstacle is not None:
                    force -= _by_place(part, position, gaps, drive.places[part.name].by_inputs[:, k])
            rate = tangent.solve(system.joined(force) * width)
            rows.append(np.where(system.prescribed, 0.0, rate))
        return np.array(rows)


def _spread(count: int, some: int) -> list[int]:
    """Some of a number of states along a path, the last among them."""
    return sorted({(count - 1) * k // some for k in range(1, some + 1)})


def _unit_forces(system: System, face: str, position: Array) -> Array:
    """External forces (n, 3) of a scaled pressure of one on a face."""
    sides = system.model.mesh.carrying_sides(face)
    return PressureTerm(sides, None, -1, system.stress_scale, potential=True).unit_forces(position)


def _by_place(part: PairPart | ShapePart, position: Array, gaps: Gaps, way: Array) -> Array:
    """Derivative (n, 3) of the internal forces of an obstacle that moves along a way (3,)."""
    step, size = 1e-6, float(np.linalg.norm(way))
    if not size:
        return np.zeros_like(position)
    places = (Pose(gaps.pose.place + sign * step / size * way) for sign in (1, -1))
    ends = [part.forces(position, part.look(position, place)) for place in places]
    return (ends[0] - ends[1])[: len(position)] / (2 * step / size)


def _obstacle_forces(model: Model, states: Sequence[State]) -> Array:
    """Forces (k, o, 3) [N] on the obstacles of a model in some states."""
    names = [obstacle.name for obstacle in model.contact.obstacles]
    forces = [[contact_force(StateFields(state), name) for name in names] for state in states]
    return np.array(forces, dtype=np.float64).reshape(len(states), len(names), 3)


def _split(system: System, rows: Array) -> tuple[Array, Array]:
    """Displacements and mean stresses of unknowns (d, size)."""
    n = len(system.model.mesh.points)
    moved = np.array([system.split(row)[0][:n].ravel() for row in rows])
    return moved, np.array([system.split(row)[1] for row in rows])
