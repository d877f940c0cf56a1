"""Answer: an equilibrium of a reduced model, with its rates and its estimated error."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from turgor.foundation.display import Shown
from turgor.reduced.parts.obstacles import ObstructingAt
from turgor.reduced.settings import ESTIMATE, NEWTON
from turgor.reduced.states.equations import unstable_modes
from turgor.reduced.states.newton import Balance

if TYPE_CHECKING:
    from turgor.core.solvers.solution import State

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class ReducedState(Shown):
    """An equilibrium of a reduced model.

    Parameters
    ----------
    reduced : Reduced
    inputs : (n,) array [SI]
    y : (r + m,) array
        Coordinates of displacement and mean stress.
    rates : (r + m, n) array
        Their derivatives by the inputs, before the last update; they miss some 1e-4 at most, see `with_own_rates`.
    indicator : float [-]
        How far the coordinates move with other sampled points, over the largest that were trained: a share of the
        error that the sampling makes.
    estimate : float [-]
        Estimated error of the displacement of a node, over the largest displacement in training.
    iterations : int
        Newton updates.
    """

    reduced: Any
    inputs: Array
    y: Array
    rates: Array
    indicator: float
    estimate: float
    iterations: int

    @staticmethod
    def of(reduced: Any, result: Balance, vain: int) -> "ReducedState":
        """Make an answer of an equilibrium of the equations, after ``vain`` updates from other starts."""
        at, inverse, r = result.before, result.inverse, reduced.equations.sizes[0]
        rates = -(inverse @ at.by_inputs()[:, 1:])
        other = np.zeros(r)
        for part, check in zip(at.parts, reduced.checks, strict=False):
            its = check.at(at.y[:r])
            if its is not None:
                other += its.forces() - part.forces()
        indicator = float(np.linalg.norm(inverse[:r, :r] @ other)) / reduced.size
        size = float(np.linalg.norm(result.y[:r])) / reduced.size
        estimate = reduced.known.at(at.inputs * reduced.weights, size, indicator)
        return ReducedState(reduced, at.inputs[1:], result.y, rates, indicator, estimate, result.iterations + vain)

    def __repr__(self) -> str:
        text = self.reduced.inputs.text(self.inputs)
        return f"ReducedState({text}, estimated error {self.estimate:.1e}, {self.iterations} iterations)"

    def with_own_rates(self) -> "ReducedState":
        """Return it with the derivatives at the equilibrium itself, which take one more evaluation of the equations."""
        at = self.reduced.equations.at(self.y, np.concatenate([[1.0], self.inputs]))
        return replace(self, rates=-np.linalg.solve(at.tangent(), at.by_inputs()[:, 1:]))

    @property
    def doubtful(self) -> bool:
        """Whether the error of the displacement may be more than two percent of the largest one, or it is unstable."""
        return self.estimate * ESTIMATE.factor > ESTIMATE.doubt or self.unstable_modes > 0

    @property
    def unstable_modes(self) -> int:
        """Directions in which a small push takes the body to another equilibrium; one evaluation of the equations.

        A body that is about to buckle may be stable where its reduced model is not, because modes are few. States of a
        motion or of rubber that relaxes are no equilibria of these equations, and count as stable.
        """
        at = self.reduced.equations.at(self.y, np.concatenate([[1.0], self.inputs]))
        tangent = at.tangent()
        off = np.linalg.norm(np.linalg.solve(tangent, at.residual)[: len(self.q)])
        return unstable_modes(tangent, len(self.q)) if off <= NEWTON.near * self.reduced.size else 0

    @property
    def q(self) -> Array:
        """Coordinates (r,) of the displacement."""
        return self.y[: self.reduced.equations.sizes[0]]

    @property
    def displacement(self) -> Array:
        """Displacement (nodes, 3) [m] of every node."""
        return (self.reduced.modes @ self.q).reshape(-1, 3) * self.reduced.scales[0]

    @property
    def mean_stress(self) -> Array:
        """Mean stress (m,) [Pa]."""
        return np.asarray(self.reduced.stresses @ self.y[len(self.q) :]) * self.reduced.scales[1]

    @property
    def tip(self) -> Array:
        """Mean displacement (3,) [m] of the face ``tip``; zeros where there is none."""
        return self.reduced.tip @ self.q * self.reduced.scales[0]

    @property
    def tip_rates(self) -> Array:
        """Derivatives (3, n) of `tip` by the inputs."""
        return self.reduced.tip @ self.rates[: len(self.q)] * self.reduced.scales[0]

    @property
    def volumes(self) -> dict[str, float]:
        """Volume of every pressed cavity of the whole actuator [m³]."""
        values = self.reduced.equations.cubics.at(self.q).values * self._volume_scale
        return dict(zip(self.reduced.faces, values.tolist(), strict=False))

    @property
    def volume_rates(self) -> dict[str, Array]:
        """Derivatives (n,) of the volumes by the inputs."""
        slopes = self.reduced.equations.cubics.at(self.q).gradients[: len(self.reduced.faces)]
        rates = slopes @ self.rates[: len(self.q)] * self._volume_scale
        return dict(zip(self.reduced.faces, rates, strict=True))

    @property
    def obstacle_forces(self) -> dict[str, Array]:
        """Force (3,) [N] of the whole actuator on every obstacle that was near in training."""
        return self._of_obstacles(lambda at: at.force())

    @property
    def obstacle_force_rates(self) -> dict[str, Array]:
        """Derivatives (3, n) of these forces by the inputs."""
        rates = np.column_stack([np.zeros(len(self.q)), self.rates[: len(self.q)]])
        return self._of_obstacles(lambda at: at.force_rates(rates)[:, 1:])

    def _of_obstacles(self, value: Callable[[ObstructingAt], Array]) -> dict[str, Array]:
        inputs = np.concatenate([[1.0], self.inputs])
        return {part.name: value(part.at(self.q, inputs)) for part in self.reduced.equations.obstacles}

    @property
    def _volume_scale(self) -> float:
        return self.reduced.scales[0] ** 3 * self.reduced.model.mesh.symmetry_factor

    def state(self) -> "State":
        """Return it as a state of the full model, for every measure, picture and response.

        Returns
        -------
        State
            Its nodal forces at free nodes are what modes and sampling miss.
        """
        from turgor.reduced.states.expand import expand  # here: it needs the engine

        r = self.reduced
        values = dict(zip(r.inputs.keys, self.inputs.tolist(), strict=True))
        return expand(r.model, values, (self.displacement, self.mean_stress), r.penalties)
