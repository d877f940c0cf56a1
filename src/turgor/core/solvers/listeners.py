"""Listeners: the callbacks of a solve, for progress and for stopping early."""

import logging
from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace

from turgor.core.solvers.newton.newton_values import NewtonResult, Report
from turgor.core.solvers.progress.progress import cut_back, describe, of_stage
from turgor.core.solvers.solution import Iteration, State, Step
from turgor.foundation.finding import Finding, Severity

#: Where libraries and long scripts read what a solve does: accepted steps as information, rejected ones for debugging.
LOG = logging.getLogger("turgor")
LOG.addHandler(logging.NullHandler())


@dataclass(frozen=True, slots=True)
class Listeners:
    """The callbacks of a solve; see `turgor.core.solvers.solve.solve`.

    Parameters
    ----------
    progress : callable or None
        Called after every Newton update, with the state after every accepted step, and after every rejected step.
    stop : callable or None
        Returns why the run ends early, None where it goes on.
    warn : callable or None
        Called with each finding that is a warning or an error, as soon as it is known.
    stage : str
        Name of the stage whose steps are reported.
    """

    progress: Callable[[Iteration, State | None], None] | None = None
    stop: Callable[[State], str | None] | None = None
    warn: Callable[[Finding], None] | None = None
    stage: str = ""

    def tell(self, findings: Iterable[Finding]) -> None:
        """Report findings but notes."""
        for each in findings:
            if self.warn is not None and each.severity is not Severity.NOTE:
                self.warn(each)

    def reporter(self, step: int, load_factor: float) -> Report:
        """Return what Newton's method calls after each update of a step."""

        def report(iteration: int, residual: float, correction: float, length: float) -> None:
            if self.progress is not None:
                self.progress(_iteration(step, load_factor, (iteration, residual, correction, length)), None)

        return report

    def accepted(self, step: int, state: State, result: NewtonResult) -> str | None:
        """Report the accepted state of a step; return why the caller ends the run, None where it goes on."""
        iteration = _iteration(step, state.load_factor, (result.iterations, result.residual, 0.0, 1.0))
        if LOG.isEnabledFor(logging.INFO):
            LOG.info(f"{of_stage(self.stage)}{describe(iteration, state)}")
        if self.progress is not None:
            self.progress(iteration, state)
        return None if self.stop is None else self.stop(state)

    def rejected(self, number: int, step: Step) -> None:
        """Report that an attempted step was rejected, and why; accepted ones are reported with their state."""
        if step.accepted:
            return
        how = step.iterations, step.residual, 0.0, 1.0
        iteration = replace(_iteration(number, step.load_factor, how), rejected=step.why)
        if LOG.isEnabledFor(logging.DEBUG):
            LOG.debug(f"{of_stage(self.stage)}{cut_back(iteration)}")
        if self.progress is not None:
            self.progress(iteration, None)


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
