"""Reduced models: what `turgor.reduce` makes, its budget, and paths of its answers."""

from typing import TYPE_CHECKING

from turgor.foundation.lazy_names import public

if TYPE_CHECKING:
    from turgor.reduced.measures import readings as readings
    from turgor.reduced.measures import with_measures as with_measures
    from turgor.reduced.path import solution_of as solution_of
    from turgor.reduced.reduce import Budget as Budget
    from turgor.reduced.states.answer import ReducedState as ReducedState
    from turgor.reduced.states.controlled import at_gas as at_gas
    from turgor.reduced.states.controlled import at_volumes as at_volumes
    from turgor.reduced.states.following import Followed as Followed
    from turgor.reduced.states.following import Moving as Moving
    from turgor.reduced.states.reduced import Reduced as Reduced
    from turgor.reduced.training.path_runs import PathRuns as PathRuns
    from turgor.reduced.verify import Verified as Verified
    from turgor.reduced.verify import verified as verified
else:
    __getattr__, __dir__, __all__ = public(__file__, globals())
