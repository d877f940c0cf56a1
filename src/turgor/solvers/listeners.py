"""Listeners: the callbacks of a solve, for progress and for stopping early."""

from collections.abc import Callable
from dataclasses import dataclass, replace

from turgor.solvers.newton.newton import NewtonResult, Report
from turgor.solvers.solution import Iteration, State, Step


@dataclass(frozen=True, slots=True)
class Listeners:
    """The callbacks of a solve; see `turgor.solvers.solve.solve`.

    Parameters
    ----------
    progress : callable or None
        Called after every Newton update, with the state after every accepted step, and after every rejected step.
    stop : callable or None
        Returns why the run ends early, None where it goes on.
    """

    progress: Callable[[Iteration, State | None], None] | None = None
    stop: Callable[[State], str | None] | None = None

    def reporter(self, step: int, load_factor: float) -> Report:
        """Return what Newton's method calls after each update of a step."""

        def report(iteration: int, residual: float, correction: float, length: float) -> None:
            if self.progress is not None:
                self.progress(_iteration(step, load_factor, (iteration, residual, correction, length)), None)

        return report

    def accepted(self, step: int, state: State, result: NewtonResult) -> str | None:
        """Tell the accepted state of a step; return why the caller ends the run, None where it goes on."""
        if self.progress is not None:
            how = result.iterations, result.residual, 0.0, 1.0
            self.progress(_iteration(step, state.load_factor, how), state)
        return None if self.stop is None else self.stop(state)

    def rejected(self, number: int, step: Step) -> None:
        """Tell that an attempted step was rejected, and why; accepted ones are told with their state."""
        if self.progress is not None and not step.accepted:
            how = step.iterations, step.residual, 0.0, 1.0
            self.progress(replace(_iteration(number, step.load_factor, how), rejected=step.why), None)


def silent(iteration: int, residual: float, correction: float, length: float) -> None:
    """Report nothing."""


def _iteration(step: int, load_factor: float, how: tuple[int, float, float, float]) -> Iteration:
    iteration, residual, correction, length = how
    return Iteration(
        step=step,
        iteration=iteration,
        load_factor=load_factor,
        residual=residual,
        correction=correction,
        step_length=length,
    )
