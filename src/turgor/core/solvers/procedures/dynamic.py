"""Dynamic: the procedure that follows an actuator through time, with its inertia."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from turgor.core.model.model import Model
from turgor.core.solvers.energies import unbalanced
from turgor.core.solvers.procedures.channel_flow import channel_target, closed_by_channels
from turgor.core.solvers.procedures.procedure import DeckStep
from turgor.core.solvers.procedures.time_options import TimeOptions
from turgor.foundation.errors import TurgorError
from turgor.foundation.finding import Finding


@dataclass(frozen=True, slots=True, kw_only=True)
class Dynamic(TimeOptions):
    """Implicit dynamics of second order: the load factor is time over duration, and histories of loads are over it.

    The generalized-α method in the form that imposes equilibrium and constant volume at the end of every step (Arnold
    and Brüls 2007, doi 10.1007/s11044-007-9084-0). Steps adapt to an estimate of their error.

    Parameters
    ----------
    duration : float [s]
        Time at load factor 1.
    first_step : float [s], optional
        First time step; a thousandth of the duration by default.
    max_step : float [s], optional
        Longest step; a fiftieth of the duration by default.
    min_step : float [s], optional
        Shortest step before the run stops; a millionth of the duration by default.
    accuracy : float [-]
        Largest error of the displacement in one step, as a share of the largest displacement so far.
    adaptive : bool
        Whether steps adapt to the error; otherwise all are as long as the first, except where a load turns.
    mass_damping : float [1/s]
        Rayleigh's α: damping in proportion to the mass, strongest for slow motions. It resists rigid motions too.
    stiffness_damping : float [s]
        Rayleigh's β: damping in proportion to the rate of strain, strongest for fast vibrations; of the order of
        milliseconds for silicone.
    spectral_radius : float [-]
        Numerical damping of vibrations that the steps do not resolve: 1 leaves all of them, 0 takes them at once. With
        mean stresses as unknowns, 1 leaves these free to oscillate from step to step.
    velocity : (3,) floats [m/s], or callable, optional
        Velocity of the whole body at the start; or ``velocity(points) -> (n, 3) velocity [m/s]`` of the (n, 3)
        reference points [m]. Supports stay at rest. The part that
        would change the volume of incompressible rubber is taken out.
    at : tuple of float [-]
        Load factors, time over duration, that must be hit exactly besides 1, each in (0, 1].
    keep : int
        Every which state is kept, besides the last one and the requested ones.
    tolerance : float [-]
        Largest residual force relative to the applied and reaction forces.
    max_iterations : int
        Newton iterations before a step is cut.
    max_steps : int
        Attempted steps before the run stops.

    Examples
    --------
    >>> Dynamic(duration=0.5).step_bounds
    (0.0005, 0.01, 5e-07)
    """

    has_inertia = True
    has_energies = True
    depends_on_path = "the actuator moves, and every state depends on all before it"

    def follow(self, problem: Any) -> Any:
        """Step in time."""
        from turgor.core.solvers.dynamics.time_stepping import follow_motion  # few jobs need it

        return follow_motion(problem, self)

    def controlled(self, model: Model) -> tuple[str, ...]:
        """Name the cavities into which liquid flows through channels."""
        return closed_by_channels(model, self.duration)

    def target(self, chambers: Any, volumes: Any, pressures: Any) -> Any:
        """Each cavity grows by what flows in."""
        return channel_target(chambers, volumes, self.duration)

    def may_be_free(self, model: Model) -> bool:
        """Inertia resists rigid motions."""
        return True

    def findings(self, states: Sequence[Any]) -> tuple[Finding, ...]:
        """Whether too much energy is missing (L05)."""
        return unbalanced(states)

    def deck_step(self, program: str, relaxes: bool) -> DeckStep:
        """Return an implicit step of Hilber, Hughes and Taylor, the relative of the generalized-α method there."""
        if callable(self.velocity):
            raise TurgorError("the velocity is a function, which has no form in .inp files; give three numbers.")
        damping = (self.mass_damping, self.stiffness_damping)
        if program == "calculix" and any(damping):
            raise TurgorError(
                "CalculiX has no damping in an implicit step; set mass_damping and stiffness_damping to 0, or write "
                "for Abaqus."
            )
        first, longest, _ = self.step_bounds
        alpha = -(1 - self.spectral_radius) / (1 + self.spectral_radius)  # of the same spectral radius
        x, y, z = (float(part) for part in (self.velocity if self.velocity is not None else (0.0, 0.0, 0.0)))
        return DeckStep(
            f"*DYNAMIC, ALPHA={max(alpha, -1 / 3):.6g}",
            ", which damps vibrations of single steps alike and not quite those between",
            first=first,
            most=longest,
            damping=damping,
            velocity=(x, y, z),
        )
