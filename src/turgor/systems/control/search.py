"""Search: the inputs of a reduced model whose output is nearest to a target, within limits."""

from collections.abc import Iterable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from turgor.foundation.errors import NotSolved
from turgor.reduced.states.answer import ReducedState
from turgor.reduced.states.reduced import Reduced
from turgor.systems.control.forces import continued
from turgor.systems.control.least_squares import least_squares
from turgor.systems.control.limits import LimitsOf
from turgor.systems.control.outputs import OutputOf
from turgor.systems.control.settings import CONTROL

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class Request:
    """What is wanted at one time.

    Parameters
    ----------
    target : (m,) array
        Wanted output.
    low, high : (n,) arrays
        Range of the inputs now.
    before : (n,) array
        Inputs from which a change counts.
    """

    target: Array
    low: Array
    high: Array
    before: Array


@dataclass(frozen=True, slots=True, eq=False)
class Search:
    """Gauss–Newton search with exact derivatives, in the inputs of a reduced model.

    Parameters
    ----------
    reduced : Reduced
    output : OutputOf
    limits : LimitsOf
    smoothness : float
        Weight μ of ``‖y − y*‖² + μ ‖p − p_before‖²``, both scaled.
    iterations : int
        Updates at most.
    """

    reduced: Reduced
    output: OutputOf
    limits: LimitsOf
    smoothness: float = CONTROL.smoothness
    iterations: int = CONTROL.iterations

    def nearest(self, start: ReducedState, request: Request) -> ReducedState:
        """Find the state whose output is nearest to the target.

        Parameters
        ----------
        start : ReducedState
        request : Request

        Returns
        -------
        ReducedState

        Raises
        ------
        NotSolved
            If the reduced model has no equilibrium at the start, or near it.
        """
        state = start
        inside = np.clip(start.inputs, request.low, request.high)
        if (inside != start.inputs).any():
            state = moved(start, inside)
        merit, longest = self._merit(state, request), CONTROL.longest
        for number in range(self.iterations):
            step = self._step(state, request, longest)
            size = float(np.abs(step).max())
            if size <= CONTROL.tolerance:
                break
            if number and max(size, self._effect(state, step)) <= CONTROL.along:
                state = along(state, np.clip(state.inputs + step * self.limits.widths, request.low, request.high))
                break
            new = self._tried(state, step, request)
            value = np.inf if new is None else self._merit(new, request)
            if new is None or value > merit * (1 + 1e-9):
                longest = 0.25 * min(size, longest)
                if longest < CONTROL.shortest:
                    break
                continue
            gained = merit - value
            state, merit, longest = new, value, min(2 * longest, CONTROL.longest)
            if gained <= CONTROL.gained * value:
                break
        return self._within_volumes(state, request)

    def _within_volumes(self, state: ReducedState, request: Request) -> ReducedState:
        """Bring volumes within their limits by the least changes of the inputs, where the search ended just beyond."""
        n, widths = len(state.inputs), self.limits.widths
        for _ in range(CONTROL.iterations):
            rows, ends = self.limits.rows(state)
            if not (ends < -CONTROL.exceeded).any():
                break
            up, down = (request.high - state.inputs) / widths, (state.inputs - request.low) / widths
            C, d = np.vstack([np.eye(n), -np.eye(n), rows * widths]), np.concatenate([up, down, ends])
            result = least_squares(np.eye(n), np.zeros(n), C, d)
            new = None if result is None else self._tried(state, result.x, request)
            if new is None:
                break
            state = new
        return state

    def best(self, state: ReducedState, starts: Iterable[ReducedState], request: Request) -> ReducedState:
        """Search from other starts as well, where a search has ended away from its target; the nearest of all."""
        for start in starts:
            new = self.nearest(start, request)
            if self._merit(new, request) < self._merit(state, request):
                state = new
            if self.error(state, request.target) <= CONTROL.stalled * self.output.size:
                break
        return state

    def error(self, state: ReducedState, target: Array) -> float:
        """Distance of the output of a state from a target [SI]."""
        return float(np.linalg.norm(self.output.at(state)[0] - target))

    def _effect(self, state: ReducedState, step: Array) -> float:
        """Change of the output over its size in the linear model, for a step of the inputs over their ranges."""
        return float(np.linalg.norm(continued(self.output, state)[1] @ (step * self.limits.widths))) / self.output.size

    def _tried(self, state: ReducedState, step: Array, request: Request) -> ReducedState | None:
        aim = np.clip(state.inputs + step * self.limits.widths, request.low, request.high)
        try:
            return moved(state, aim)
        except NotSolved:
            return None

    def _merit(self, state: ReducedState, request: Request) -> float:
        error = (continued(self.output, state)[0] - request.target) / self.output.size
        change = (state.inputs - request.before) / self.limits.widths
        excess = self.limits.excess(state)
        return float(error @ error + self.smoothness * (change @ change) + 1e3 * excess**2)

    def _step(self, state: ReducedState, request: Request, longest: float) -> Array:
        """Best change of the inputs over their ranges in the linear model of the output."""
        widths, n = self.limits.widths, len(state.inputs)
        value, slopes = continued(self.output, state)
        size, weight = self.output.size, np.sqrt(self.smoothness)
        A = np.vstack([slopes * (widths / size), weight * np.eye(n)])
        b = np.concatenate([(request.target - value) / size, weight * (request.before - state.inputs) / widths])
        up = np.minimum((request.high - state.inputs) / widths, longest)
        down = np.minimum((state.inputs - request.low) / widths, longest)
        C, d = np.vstack([np.eye(n), -np.eye(n)]), np.concatenate([up, down])
        rows, ends = self.limits.rows(state)
        result = least_squares(A, b, np.vstack([C, rows * widths]), np.concatenate([d, ends]))
        if result is None:  # no such inputs nearby: the volumes come as near to their limits as they can
            over = ends < 0
            A, b = np.vstack([A, 1e3 * rows[over] * widths]), np.concatenate([b, 1e3 * ends[over]])
            result = least_squares(A, b, C, d)
        return np.zeros(n) if result is None else np.clip(result.x, -down, up)


def moved(state: ReducedState, inputs: Array) -> ReducedState:
    """Find the equilibrium at other inputs, from a state and its derivatives."""
    return state.reduced.at(inputs, along(state, inputs))


def along(state: ReducedState, inputs: Array) -> ReducedState:
    """Go to other inputs along the derivatives of a state."""
    return replace(state, inputs=inputs, y=state.y + state.rates @ (inputs - state.inputs))
