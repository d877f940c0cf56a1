"""Arc scaling: weigh displacement against load in the arc length, and adapt the weight along the path.

The scale of the first step is that of a stiff body. A body that buckles moves a thousand times as far for its load, and
arcs of the first scale would be far too short. The displacement that weighs as much as the whole load grows with the
largest displacement.
"""

from dataclasses import replace

import numpy as np

from turgor.core.solvers.constraints.load_factor import ArcTarget
from turgor.core.solvers.continuation.path_run import Point, Run
from turgor.core.solvers.continuation.scalar_control.settings import ARC_SCALING


def next_conditions(run: Run, last: Point, now: Point) -> None:
    """Set the arc length of the next step in a suitable scale, and convert the history to it."""
    target = run.constraint.target
    if isinstance(target, ArcTarget):
        run.size = max(run.size, _moved(run, now) / (ARC_SCALING.scale_growth * _largest_load(run, now)))
        target = replace(target, size=run.size)
    following = target.onward(last, now)
    clock = run.constraint.clock.onward(now.parameter)
    run.constraint = replace(run.constraint, target=following, clock=clock)
    if not isinstance(following, ArcTarget) or now.change is None or now.slope is None:
        return
    measure = following.arc.length(now.change, float(now.slope[0]))
    run.history[:] = [_measured(point, now.parameter, measure) for point in run.history]


def _moved(run: Run, now: Point) -> float:
    return float(np.linalg.norm(now.state.displacement - run.states[0].displacement)) / run.task.system.length


def _largest_load(run: Run, now: Point) -> float:
    return max(*(abs(state.load_factor) for state in run.states), abs(float(now.scalars[0])))


def _measured(point: Point, origin: float, measure: float) -> Point:
    """A point with its distance from the last one, and its rates, in the new scale."""
    return replace(
        point,
        parameter=origin + measure * (point.parameter - origin),
        change=None if point.change is None else point.change / measure,
        slope=None if point.slope is None else point.slope / measure,
    )
