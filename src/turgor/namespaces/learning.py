"""Learning: reduced models as differentiable functions of NumPy, PyTorch and JAX, and as environments of Gymnasium."""

from typing import TYPE_CHECKING

from turgor.foundation.lazy_names import public

if TYPE_CHECKING:
    from turgor.systems.learning.environment import environment as environment
    from turgor.systems.learning.for_jax import to_jax as to_jax
    from turgor.systems.learning.for_torch import to_torch as to_torch
    from turgor.systems.learning.function import ReducedFunction as ReducedFunction
    from turgor.systems.learning.function import function as function
    from turgor.systems.learning.outputs import Coordinates as Coordinates
    from turgor.systems.learning.outputs import Volumes as Volumes
    from turgor.systems.learning.task import FollowTask as FollowTask
    from turgor.systems.learning.valves import Valves as Valves
else:
    __getattr__, __dir__, __all__ = public(__file__, globals())
