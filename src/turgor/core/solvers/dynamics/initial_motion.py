"""Initial motion: velocities that keep the volume, accelerations from the forces."""

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.algebra.linear import LinearSolver, linear_solver
from turgor.core.engine.system import Evaluation, System
from turgor.core.solvers.dynamics.settings import INITIAL_MOTION

Array = NDArray[np.float64]


class Accelerations:
    """Accelerations under given forces, and velocities, both such that rubber and rigid faces keep their constraints.

    Parameters
    ----------
    system : System
    at : Evaluation
        Where the body is, evaluated without inertia.
    mass : (nnz,) array
        Lower triangle of the scaled mass.
    """

    def __init__(self, system: System, at: Evaluation, mass: Array) -> None:
        self._system, self._at = system, at
        incompressible = bool(system.element.mean_count) and bool((system.materials.compliance == 0).any())
        self._fixed = np.zeros(system.size, dtype=bool)  # multipliers that constrain the motion
        self._fixed[system.multipliers] = True
        if incompressible:
            self._fixed[3 * system.node_count :] = True
        self._coupled = bool(self._fixed.any())
        size = float(np.abs(mass).max())
        largest = float(system.dV.sum(axis=1).max(initial=0.0)) or 1.0  # films have no volume, and edges of about 1
        self._scale = largest / size  # makes the mass as large as a stiffness
        data, mass = system.tangent_data(at), system.layout.spread(mass)
        pattern = self._pattern = system.pattern  # now: contact may have changed it
        row_of = pattern.indices
        column_of = np.repeat(np.arange(pattern.size), np.diff(pattern.indptr))
        moves = system.moving
        fixes = self._fixed[row_of] | self._fixed[column_of]
        self._volumes = np.where(fixes & (moves[row_of] != moves[column_of]), data, 0.0)
        unchanged = fixes | ~(moves[row_of] | moves[column_of])
        matrix = np.where(unchanged, data, self._scale * mass)
        system.apply_supports(matrix)
        system.make_definite(matrix)
        self._solver: LinearSolver = linear_solver("rslab", pattern, 1)
        self._solver.factor(matrix)

    def velocity(self, target: Array) -> Array:
        """The velocity (size,) nearest to a target that satisfies the supports and keeps the volume."""
        target = np.where(self._system.prescribed, 0.0, target)
        target[~self._system.moving] = 0.0
        if not self._coupled:
            return target
        right = np.zeros(self._system.size)
        right[self._fixed] = -self._pattern.product(self._volumes, target)[self._fixed]
        right[self._system.prescribed] = 0.0
        change = self._solver.solve(right)
        change[~self._system.moving] = 0.0
        return np.asarray(target + change)

    def acceleration(self, velocity: Array, forces: Array) -> tuple[Array, Array]:
        """Acceleration (size,) and change of the mean stress (size,) under the unbalanced forces at a velocity."""
        right = -(self._at.residual + forces)
        right[~self._system.moving] = 0.0
        if self._coupled and velocity.any():
            right[self._fixed] = -self._turning(velocity) / self._scale
        right[self._system.prescribed] = 0.0
        if not np.abs(right).any():
            return np.zeros_like(right), np.zeros_like(right)
        solved = self._solver.solve(right)
        acceleration, stress = solved * self._scale, solved.copy()
        acceleration[~self._system.moving] = 0.0
        stress[~self._fixed] = 0.0
        return acceleration, stress

    def _turning(self, velocity: Array) -> Array:
        """Second derivative of the constraints along a straight motion (m,), by differences."""
        step = INITIAL_MOTION.difference / float(np.abs(velocity).max())
        volumes = []
        for k in (-1.0, 0.0, 1.0):
            there = self._at.unknowns + k * step * velocity
            at = self._system.evaluate(there, self._at.load_factor, history=self._at.history)
            if at is None:
                return np.zeros(int(self._fixed.sum()))
            volumes.append(at.residual[self._fixed])
        return np.asarray((volumes[0] - 2 * volumes[1] + volumes[2]) / step**2)
