"""Training: full solves along paths, whose accepted states are the snapshots of a reduced model."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from math import inf
from time import process_time

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.algebra.tangent import Tangent
from turgor.core.engine.contact.pair_part import PairPart
from turgor.core.engine.contact.part import Gaps
from turgor.core.engine.contact.shape_part import ShapePart
from turgor.core.engine.faces.pressure_term import PressureTerm
from turgor.core.engine.runtime import EngineOptions
from turgor.core.engine.system import System
from turgor.core.model.model import Model
from turgor.core.results.fields.contact import contact_force
from turgor.core.results.fields.state_fields import StateFields
from turgor.core.solvers.problem import Problem
from turgor.core.solvers.procedures.static import Static
from turgor.core.solvers.restart import unknowns_of
from turgor.core.solvers.solution import State
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
    """

    model_at: ModelAt
    inputs: Inputs
    steps: int
    options: EngineOptions

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
        if differentiated and states:
            derivatives = self._derivatives(system, tangent, states[-1])
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
        )

    def _derivatives(self, system: System, tangent: Tangent, state: State) -> tuple[Array, Array]:
        """Derivatives of a state by the inputs, times their ranges."""
        at = system.evaluate(unknowns_of(system, state), state.load_factor)
        assert at is not None
        tangent.factor(at)
        drive = drive_of(system, self.model_at, self.inputs)
        position = system.configuration(at).position
        rows = []
        for k, width in enumerate(self.inputs.high - self.inputs.low, start=1):
            force = drive.forces[:, k].reshape(-1, 3).copy()
            for term in system.terms.all:
                if isinstance(term, PressureTerm) and term.load is not None:
                    force += drive.pressures[drive.faces.index(term.load.face)][k] * term.unit_forces(position)
            for part, gaps in zip(system.contact.parts, at.contacts.gaps, strict=True):
                if part.obstacle is not None:
                    force -= _by_place(part, position, gaps, drive.places[part.name].by_inputs[:, k])
            rate = tangent.solve(system.joined(force) * width)
            rows.append(np.where(system.prescribed, 0.0, rate))
        n = 3 * len(system.model.mesh.points)
        moved = np.array([system.split(row)[0][: n // 3].ravel() for row in rows])
        return moved, np.array([system.split(row)[1] for row in rows])


def _by_place(part: PairPart | ShapePart, position: Array, gaps: Gaps, way: Array) -> Array:
    """Derivative (n, 3) of the internal forces of an obstacle that moves along a way (3,)."""
    step, size = 1e-6, float(np.linalg.norm(way))
    if not size:
        return np.zeros_like(position)
    ends = [part.forces(position, part.look(position, gaps.place + sign * step / size * way)) for sign in (1, -1)]
    return (ends[0] - ends[1])[: len(position)] / (2 * step / size)


def _obstacle_forces(model: Model, states: Sequence[State]) -> Array:
    """Forces (k, o, 3) [N] on the obstacles of a model in some states."""
    names = [obstacle.name for obstacle in model.contact.obstacles]
    forces = [[contact_force(StateFields(state), name) for name in names] for state in states]
    return np.array(forces, dtype=np.float64).reshape(len(states), len(names), 3)
