"""Rest of threads: the length and the stiffness that states before loading give to the threads of a winding.

A piece of the length ℓ in the mesh has the length λ₀ ℓ without stress. At the stretch λ of the face it is stretched by
λ / λ₀, and stores ½ E A (λ / λ₀ − 1)² over λ₀ ℓ. It is a piece with the tangent gₐ / λ₀ per length without stress and
the weight λ₀ ℓ, so that the kernels of fibers know nothing of states.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import exp, prod

import numpy as np

from turgor.core.engine.fibers.fiber_kernels import Pieces
from turgor.core.model.loads import Load
from turgor.core.model.model import Model


@dataclass(frozen=True, slots=True)
class ThreadRest:
    """Threads of one winding without stress.

    Parameters
    ----------
    length : float
        λ₀, length without stress over that in the mesh.
    stiffness : float
        Stiffness over that of the material.

    Examples
    --------
    >>> from turgor.core.model.loads import PreStretch
    >>> ThreadRest.of([PreStretch("hoops", 1.25)], 1.0)
    ThreadRest(length=0.8, stiffness=1.0)
    """

    length: float = 1.0
    stiffness: float = 1.0

    @staticmethod
    def of(loads: Sequence[Load], load_factor: float) -> "ThreadRest":
        """The threads at a load factor, with all states that act on their winding."""
        logs = (load.log_length(load_factor) for load in loads)
        return ThreadRest(exp(sum(log for log in logs if log)), prod(load.stiffness(load_factor) for load in loads))

    def pieces(self, laid: Pieces) -> Pieces:
        """Pieces of these threads, from those that are free of stress in the mesh."""
        return replace(
            laid,
            along=np.ascontiguousarray(laid.along / self.length),
            weights=laid.weights * self.length,
            stiffness=laid.stiffness * self.stiffness,
        )


def threads_have_states(model: Model) -> bool:
    """Whether a load is a state of a winding."""
    return any(model.states_of(each.name) for each in model.reinforcements)
