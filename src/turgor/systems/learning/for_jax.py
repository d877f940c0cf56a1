"""to_jax: a reduced model as a differentiable function of JAX."""

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from turgor.reduced.states.reduced import Reduced
from turgor.studies.runs.optional_parts import needed
from turgor.systems.control.outputs import Output, Tip
from turgor.systems.learning.function import function


def to_jax(reduced: Reduced, outputs: Sequence[Output] = (Tip(),)) -> Callable[[Any], Any]:
    """Make a differentiable function of JAX from a reduced model, for `jit`, `grad`, `jacfwd`, `jacrev` and `vmap`.

    Derivatives are exact, those of the reduced equilibrium, forward and backward; second derivatives are refused.
    The work is done in float64 by a callback on the processor; the result has the type of the inputs.

    Parameters
    ----------
    reduced : Reduced
    outputs : sequence of Output
        What it returns: `Tip` (the default), `Points`, `Shape`, `Angle`, `Volumes`, `Coordinates`, or some of them.

    Returns
    -------
    callable
        Takes an array (..., n) of inputs [SI], in the order of ``reduced.inputs.keys``, and returns one (..., m) [SI].

    Raises
    ------
    TurgorError
        If JAX is not installed.
    """
    jax = needed("jax", "to_jax", "learning")
    made = function(reduced, outputs)
    m, n = len(made.names), len(reduced.inputs.keys)

    def with_rates(inputs: Any) -> Any:
        def run(numbers: Any) -> Any:
            return tuple(each.astype(kind) for each in made.with_rates(np.asarray(numbers)))

        kind = jax.numpy.promote_types(inputs.dtype, np.float32)
        sizes = ((*inputs.shape[:-1], m), (*inputs.shape[:-1], m, n))
        shapes = tuple(jax.ShapeDtypeStruct(size, kind) for size in sizes)
        return jax.pure_callback(run, shapes, inputs, vmap_method="expand_dims")

    @jax.custom_jvp
    def of_reduced(inputs: Any) -> Any:
        return with_rates(jax.numpy.asarray(inputs))[0]

    @of_reduced.defjvp
    def with_change(inputs: Any, changes: Any) -> Any:
        values, rates = with_rates(jax.numpy.asarray(inputs[0]))
        return values, jax.numpy.einsum("...mn,...n->...m", rates, changes[0])

    return of_reduced
