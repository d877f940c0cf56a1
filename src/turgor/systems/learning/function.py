"""Function: outputs of a reduced model as a differentiable function of its inputs, in NumPy."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from turgor.foundation.display import Shown
from turgor.foundation.errors import TurgorError
from turgor.reduced.states.answer import ReducedState
from turgor.reduced.states.reduced import Reduced
from turgor.systems.control.outputs import Output, OutputOf, Tip

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class ReducedFunction(Shown):
    """Outputs of a reduced model as a function of its inputs, with exact first derivatives; made by `function`.

    Parameters
    ----------
    reduced : Reduced
    outputs : tuple of OutputOf
        Their numbers stand one after the other.
    """

    reduced: Reduced
    outputs: tuple[OutputOf, ...]

    def __repr__(self) -> str:
        return f"ReducedFunction({', '.join(self.reduced.inputs.keys)} → {', '.join(self.names)})"

    @property
    def names(self) -> tuple[str, ...]:
        """Name of each number of the result."""
        return tuple(name for output in self.outputs for name in output.names)

    def __call__(self, inputs: ArrayLike) -> Array:
        """Values (..., m) [SI] at inputs (..., n) [SI]; see `with_rates`."""
        return self.with_rates(inputs)[0]

    def with_rates(self, inputs: ArrayLike) -> tuple[Array, Array]:
        """Find the equilibria at inputs, each from the training states, so that no result depends on the others.

        Parameters
        ----------
        inputs : (..., n) array [SI]
            In the order of ``reduced.inputs.keys``.

        Returns
        -------
        (..., m) array, (..., m, n) array
            Values, and their derivatives by the inputs.

        Raises
        ------
        TurgorError
            If the last axis does not have the inputs, or a value lies outside of the trained range.
        NotSolved
            If no equilibrium was found.
        """
        table, n = np.asarray(inputs, dtype=np.float64), len(self.reduced.inputs.keys)
        if table.ndim == 0 or table.shape[-1] != n:
            raise TurgorError(
                f"the inputs have the shape {table.shape}; their last axis needs {n} values, "
                f"{', '.join(self.reduced.inputs.keys)}."
            )
        rows: list[tuple[Array, Array]] = []
        for row in table.reshape(-1, n):
            if not np.isfinite(row).all():
                raise TurgorError(f"the inputs are {row.tolist()}; finite numbers are needed.")
            self.reduced.inputs.check(row)
            rows.append(self.of_state(self.reduced.at(row).with_own_rates()))
        shape, m = table.shape[:-1], len(self.names)
        values = np.array([each for each, _ in rows]).reshape(*shape, m)
        return values, np.array([each for _, each in rows]).reshape(*shape, m, n)

    def of_state(self, state: ReducedState) -> tuple[Array, Array]:
        """Values (m,) and derivatives (m, n) by the inputs at an equilibrium."""
        each = [output.at(state) for output in self.outputs]
        return np.concatenate([value for value, _ in each]), np.vstack([rates for _, rates in each])


def function(reduced: Reduced, outputs: Sequence[Output] = (Tip(),)) -> ReducedFunction:
    """Make a differentiable function of a reduced model, for NumPy.

    Parameters
    ----------
    reduced : Reduced
    outputs : sequence of Output
        What it returns: `Tip` (the default), `Points`, `Shape`, `Angle`, `ContactForce`, `Volumes`, `Coordinates`, or
        some of them.

    Returns
    -------
    ReducedFunction
    """
    if not outputs:
        raise TurgorError("a function needs an output, such as Tip(); there is none.")
    return ReducedFunction(reduced, tuple(output.of(reduced) for output in outputs))
