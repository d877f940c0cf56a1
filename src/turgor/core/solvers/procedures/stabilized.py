"""Stabilized: the static procedure with viscous forces where there is no equilibrium nearby."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from turgor.core.meshing.bodies.bodies import find_bodies
from turgor.core.model.model import Model
from turgor.core.solvers.energies import too_viscous
from turgor.core.solvers.procedures.procedure import DeckStep
from turgor.core.solvers.procedures.step_options import StepOptions, check_steps, make_numbers
from turgor.foundation.errors import TurgorError
from turgor.foundation.finding import Finding


@dataclass(frozen=True, slots=True, kw_only=True)
class Stabilized(StepOptions):
    """Load control in which a viscous medium resists motion, so that snapping and local buckling do not end the run.

    The force is c M* Δu/Δs with the mass matrix M* of unit density and the change of the displacement with the load
    factor. It grows as steps are cut, and fades where the actuator moves evenly. At the end the load is constant until
    the forces have faded, so the last state is an equilibrium; those on the way are so up to the viscous forces.
    Supports may leave rigid motions free where there is an obstacle or another body at which it can come to rest.

    Parameters
    ----------
    stabilization : float [-]
        Energy that the viscous forces would take over the whole path if the actuator answered linearly, as a share of
        its strain energy, in (0, 0.1]. What they did take is reported.
    first_step, max_step, min_step, at, tolerance, max_iterations, max_steps
        As in `Static`.

    Examples
    --------
    >>> Stabilized(max_step=0.2).max_step
    0.2
    """

    has_energies = True

    stabilization: float = 5e-4
    max_step: float = 0.1
    min_step: float = 1e-6

    def __post_init__(self) -> None:
        make_numbers(self)
        if not 0 < self.stabilization <= 0.1:
            raise TurgorError(f"procedure.stabilization is {self.stabilization:g}; allowed is more than 0 up to 0.1.")
        check_steps(self)

    def follow(self, problem: Any) -> Any:
        """Step the load factor against viscous forces."""
        from turgor.core.solvers.dynamics.stabilization import follow_viscously  # few jobs need it

        return follow_viscously(problem, self, self.stabilization)

    def may_be_free(self, model: Model) -> bool:
        """Whether there is an obstacle or another body at which a free body can come to rest."""
        return bool(model.contact.obstacles) or len(find_bodies(model.mesh)) > 1

    @property
    def no_gradient(self) -> str:
        """The viscous forces depend on the step."""
        return "artificial viscosity acts in the states of Stabilized; go on with a stage of Static and take its states"

    def findings(self, states: Sequence[Any]) -> tuple[Finding, ...]:
        """Whether the viscous forces took too much energy (L06)."""
        return too_viscous(states)

    def deck_step(self, program: str, relaxes: bool) -> DeckStep:
        """Return a step with viscous forces, which CalculiX lacks."""
        if program != "abaqus":
            raise TurgorError("CalculiX has no viscous forces in a static step; write for Abaqus, or take static.")
        long_term = "LONG TERM, " if relaxes else ""
        return DeckStep(
            f"*STATIC, {long_term}STABILIZE={self.stabilization:g}",
            ", whose viscous forces follow from the first increment and do not fade at the end",
        )
