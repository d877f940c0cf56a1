"""to_torch: a reduced model as a differentiable function of PyTorch."""

from collections.abc import Callable, Sequence
from functools import cache
from typing import Any

from turgor.reduced.states.reduced import Reduced
from turgor.studies.runs.optional_parts import needed
from turgor.systems.control.outputs import Output, Tip
from turgor.systems.learning.function import ReducedFunction, function


def to_torch(reduced: Reduced, outputs: Sequence[Output] = (Tip(),)) -> Callable[[Any], Any]:
    """Make a differentiable function of PyTorch from a reduced model, also for `torch.func`.

    Derivatives are exact, those of the reduced equilibrium, forward and backward; second derivatives are refused.
    The work is done in float64 on the processor; the result has the type and the device of the inputs.

    Parameters
    ----------
    reduced : Reduced
    outputs : sequence of Output
        What it returns: `Tip` (the default), `Points`, `Shape`, `Angle`, `Volumes`, `Coordinates`, or some of them.

    Returns
    -------
    callable
        Takes a tensor (..., n) of inputs [SI], in the order of ``reduced.inputs.keys``, and returns one (..., m) [SI].

    Raises
    ------
    TurgorError
        If PyTorch is not installed.
    """
    made, operation = function(reduced, outputs), _operation()

    def of_reduced(inputs: Any) -> Any:
        return operation.apply(inputs, made)[0]

    return of_reduced


@cache
def _operation() -> Any:
    """An operation of PyTorch that returns values and rates; the rates are no path for gradients."""
    torch = needed("torch", "to_torch", None)
    base: Any = torch.autograd.Function

    class OfReduced(base):  # type: ignore[misc]
        @staticmethod
        def forward(inputs: Any, made: ReducedFunction) -> Any:
            both = made.with_rates(inputs.detach().cpu().double().numpy())
            values, rates = (torch.as_tensor(each, dtype=inputs.dtype, device=inputs.device) for each in both)
            return values, rates

        @staticmethod
        def setup_context(ctx: Any, inputs: Any, output: Any) -> None:
            ctx.mark_non_differentiable(output[1])
            ctx.save_for_backward(output[1])
            ctx.save_for_forward(output[1])

        @staticmethod
        @torch.autograd.function.once_differentiable
        def backward(ctx: Any, by_values: Any, _: Any) -> Any:
            (rates,) = ctx.saved_tensors
            return torch.einsum("...m,...mn->...n", by_values, rates), None

        @staticmethod
        def jvp(ctx: Any, change: Any, _: Any) -> Any:
            (rates,) = ctx.saved_tensors
            return torch.einsum("...mn,...n->...m", rates, change), None

        @staticmethod
        def vmap(info: Any, places: Any, inputs: Any, made: ReducedFunction) -> Any:
            return OfReduced.apply(inputs.movedim(places[0], 0), made), (0, 0)

    return OfReduced
