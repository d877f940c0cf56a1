"""Auto: load control that goes past limit points by the volume of the cavities or by the arc length."""

from dataclasses import dataclass
from typing import Any

from turgor.core.solvers.procedures.procedure import DeckStep
from turgor.core.solvers.procedures.step_options import StepOptions, check_steps, make_numbers
from turgor.foundation.errors import TurgorError
from turgor.foundation.finding import Severity


@dataclass(frozen=True, slots=True, kw_only=True)
class Auto(StepOptions):
    """Load control as long as it goes; before a limit point or a jump the volume of the cavities or the arc takes over.

    Where all loads are pressures in cavities, the volume weighted with the pressures takes over, and the path goes on
    until the load factor has come back to 1 or the cavities have grown ``past`` times as much as at the first limit
    point. Where other loads act, the arc length takes over, up to ``max_stretch``.

    Parameters
    ----------
    past : float [-]
        How far to follow the path: injected volume over that at the limit point, in (1, 1000].
    max_stretch : float [-]
        Largest principal stretch anywhere at which the path ends, more than 1.
    first_step, max_step, min_step, at, tolerance, max_iterations, max_steps
        As those of `Static`.

    Examples
    --------
    >>> Auto(past=4.0).past
    4.0
    """

    finds_load = True
    limit_points = Severity.WARNING

    past: float = 3.0
    max_stretch: float = 10.0

    def __post_init__(self) -> None:
        make_numbers(self)
        if not 1 < self.past <= 1000:
            raise TurgorError(f"procedure.past is {self.past:g}; allowed is more than 1 up to 1000.")
        if not self.max_stretch > 1:
            raise TurgorError(f"procedure.max_stretch is {self.max_stretch:g}; a stretch above 1 is needed.")
        check_steps(self)

    def follow(self, problem: Any) -> Any:
        """Step the load factor, and go on by volume or arc length."""
        from turgor.core.solvers.continuation.branch_switch import follow_auto  # few jobs need it
        from turgor.core.solvers.continuation.scalar_control.arc_length import Bounds

        return follow_auto(problem, self, Bounds(self.max_stretch, past=self.past))

    def deck_step(self, program: str, relaxes: bool) -> DeckStep:
        """Return the step of load control."""
        keyword = "*STATIC, LONG TERM" if relaxes and program == "abaqus" else "*STATIC"
        return DeckStep(keyword, ", which ends at a limit point")
