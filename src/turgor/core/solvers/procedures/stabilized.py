"""Stabilized: the static procedure that lets viscous forces carry an actuator through what it cannot pass at rest."""

from dataclasses import dataclass

from turgor.core.solvers.procedures.step_options import StepOptions, check_steps, make_numbers
from turgor.foundation.errors import TurgorError


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

    stabilization: float = 5e-4
    max_step: float = 0.1
    min_step: float = 1e-6

    def __post_init__(self) -> None:
        make_numbers(self)
        if not 0 < self.stabilization <= 0.1:
            raise TurgorError(f"procedure.stabilization is {self.stabilization:g}; allowed is more than 0 up to 0.1.")
        check_steps(self)
