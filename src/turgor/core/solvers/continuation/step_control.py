"""Step control: choose the length of the next step from load factors and numbers of iterations alone."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import isclose

from turgor.core.solvers.continuation.settings import STEP_CONTROL
from turgor.core.solvers.procedures.step_options import StepOptions
from turgor.core.solvers.solution import Step
from turgor.core.solvers.step_reasons import Cause


@dataclass(frozen=True, slots=True, kw_only=True)
class StepControl:
    """Length of the next step and the load factors still to be hit.

    Parameters
    ----------
    length : float
        Increment that the next step would like to take.
    max_step, min_step : float
        Its bounds.
    targets : tuple of float
        Load factors to hit exactly, rising, the last one is 1.
    patience : int
        Successes since the last failure; steps do not grow right after one.
    comfortable : float
        Iterations of a step that is neither too easy nor too hard.
    """

    length: float
    max_step: float
    min_step: float
    targets: tuple[float, ...]
    patience: int = 2
    comfortable: float = STEP_CONTROL.comfortable_iterations

    @staticmethod
    def of(procedure: StepOptions, kinks: Sequence[float] = (), wrinkling: bool = False) -> "StepControl":
        """Start as requested, and hit the kinks of the load histories too; where sheets wrinkle steps are hard.

        Examples
        --------
        >>> from turgor.core.solvers.procedures.static import Static
        >>> [StepControl.of(Static(), wrinkling=one).accepted(0.05, 9).length for one in (True, False)]
        [0.05, 0.03333333333333333]
        """
        requested = {factor for factor in procedure.at if not any(isclose(factor, kink) for kink in kinks)}
        targets = tuple(sorted({*requested, *kinks, 1.0}))
        return StepControl(
            length=procedure.first_step,
            max_step=procedure.max_step,
            min_step=procedure.min_step,
            targets=targets,
            comfortable=STEP_CONTROL.wrinkling_iterations if wrinkling else STEP_CONTROL.comfortable_iterations,
        )

    def next_load(self, load_factor: float) -> float:
        """Return the load factor to try next: one step on, or the next target exactly.

        Examples
        --------
        >>> from turgor.core.solvers.procedures.static import Static
        >>> control = StepControl.of(Static(first_step=0.3, max_step=0.3, at=(0.5,)))
        >>> control.next_load(0.0), control.next_load(0.3), control.next_load(0.5)
        (0.3, 0.5, 0.8)
        """
        target = next(t for t in self.targets if t > load_factor)
        if load_factor + STEP_CONTROL.stretch * self.length >= target:
            return target
        tidy = round(load_factor + self.length, STEP_CONTROL.load_digits)
        return tidy if load_factor < tidy < target else load_factor + self.length

    def accepted(self, increment: float, iterations: int, touches: bool = False) -> "StepControl":
        """Grow after an easy step, shrink after a hard one; a step shortened by a target does not shrink the next.

        Where walls touch it does, to half at most, because what shortened it was how deep they would be pressed into
        each other.

        Examples
        --------
        >>> from turgor.core.solvers.procedures.static import Static
        >>> control = StepControl.of(Static(first_step=0.2, max_step=0.5))
        >>> [round(control.accepted(0.1, 4, touches).length, 3) for touches in (False, True)]
        [0.3, 0.175]
        >>> round(control.accepted(0.01, 4, True).length, 3)  # half of 0.2, and longer because that was easy
        0.175
        """
        comfortable = max(self.comfortable, STEP_CONTROL.touching_iterations) if touches else self.comfortable
        factor = min(STEP_CONTROL.touching_growth if touches else 2.0, max(0.5, comfortable / max(iterations, 1)))
        if self.patience < 2:
            factor = min(factor, 1.0)
        least = STEP_CONTROL.touching_share * self.length if touches else self.length
        reference = max(increment, least) if factor >= 1 else increment
        return replace(self, length=min(self.max_step, reference * factor), patience=self.patience + 1)

    def turned(self, first_step: float) -> "StepControl":
        """Start again with short steps after a kink in a load history.

        Examples
        --------
        >>> from turgor.core.solvers.procedures.static import Static
        >>> StepControl.of(Static(first_step=0.3, max_step=0.3)).turned(0.1).length
        0.1
        """
        return replace(self, length=min(self.length, first_step))

    def resumed(self, first_step: float) -> "StepControl":
        """Take steps as at the start after cuts that only served to locate the loss of stability.

        Examples
        --------
        >>> from turgor.core.solvers.procedures.static import Static
        >>> control = StepControl.of(Static(first_step=0.2)).failed(0.2)
        >>> round(control.length, 3), control.resumed(0.2).length
        (0.07, 0.2)
        """
        return replace(self, length=max(self.length, first_step), patience=2)

    def failed(self, increment: float) -> "StepControl | None":
        """Cut the step; None when it would fall below the smallest."""
        shorter = increment * STEP_CONTROL.step_cut
        return None if shorter < self.min_step else replace(self, length=shorter, patience=0)


def in_vain(steps: Sequence[Step]) -> bool:
    """Whether shorter steps do not help: the last one ended at round-off, or the last many hardly advanced."""
    if steps[-1].cause is Cause.ROUND_OFF:
        return True
    last = steps[-STEP_CONTROL.creeping_attempts :]
    taken = [step.increment for step in last if step.accepted]
    return (
        len(last) == STEP_CONTROL.creeping_attempts
        and 2 * len(taken) <= len(last)
        and sum(taken) < STEP_CONTROL.creeping_advance
    )
