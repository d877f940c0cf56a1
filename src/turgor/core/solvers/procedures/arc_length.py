"""ArcLength: the length of the path drives it, so that the load may rise and fall."""

from dataclasses import dataclass, field
from typing import Any

from turgor.core.solvers.procedures.procedure import DeckStep
from turgor.core.solvers.procedures.step_options import StepOptions, check_steps, make_numbers
from turgor.foundation.errors import TurgorError


@dataclass(frozen=True, slots=True, kw_only=True)
class ArcLength(StepOptions):
    """Follow the path by its length, so that the load may rise and fall; all loads keep their proportion.

    The length of a step joins the change of the load factor with that of the displacement, scaled so that both are
    alike in the first step; a body that buckles is measured by its own displacement from then on. The path ends where
    the load factor reaches 1 or 0, at one of the bounds, or where it goes back the way it came.

    Parameters
    ----------
    max_stretch : float [-]
        Largest principal stretch anywhere at which the path ends, more than 1.
    max_displacement : float [m], optional
        Largest displacement of a node at which the path ends.
    first_step : float [-]
        Load factor of the first state, in (0, 1].
    max_step, min_step : float [-]
        Largest and smallest length of a step.
    at : tuple of float [-]
        Load factors at which a state is made wherever the path crosses them, each in (0, 1].
    branch : int
        Branch to take at the first bifurcation: 0 stays on the path, 1 and -1 leave it along the mode that becomes
        unstable there and against it.
    tolerance, max_iterations
        As those of `VolumeControl`.
    max_steps : int
        Attempted arcs before the solve stops.

    Examples
    --------
    >>> ArcLength(max_stretch=3.0).max_stretch
    3.0
    """

    finds_load = True

    max_stretch: float = 10.0
    max_displacement: float | None = field(default=None, metadata={"dimension": "length"})
    max_step: float = 0.5
    branch: int = 0

    def __post_init__(self) -> None:
        make_numbers(self)
        if not self.max_stretch > 1:
            raise TurgorError(f"procedure.max_stretch is {self.max_stretch:g}; a stretch above 1 is needed.")
        if self.max_displacement is not None and not self.max_displacement > 0:
            raise TurgorError(f"procedure.max_displacement is {self.max_displacement:g} m; it must be above 0.")
        if self.branch not in (-1, 0, 1):
            raise TurgorError(f"procedure.branch is {self.branch!r}; allowed is -1, 0 or 1.")
        check_steps(self, longest=100.0)

    def follow(self, problem: Any) -> Any:
        """Prescribe the length of each step."""
        from turgor.core.solvers.continuation.scalar_control.arc_length import Bounds, follow_arc  # few jobs need it

        limit = Bounds(self.max_stretch, self.max_displacement, self.at)
        if not self.branch:
            return follow_arc(problem, self, limit)
        from turgor.core.solvers.buckling.branch import follow_branch

        return follow_branch(problem, self, limit, self.branch)

    def deck_step(self, program: str, relaxes: bool) -> DeckStep:
        """Return the step of Riks, which CalculiX lacks."""
        if program != "abaqus":
            raise TurgorError("CalculiX follows no arc length; write for Abaqus, or export a job with static.")
        differs = ", which ends at the full load and not at load factors of at or a stretch"
        return DeckStep("*STATIC, RIKS", differs, more=", 1")  # the last load factor
