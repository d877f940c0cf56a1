"""Static: load control from zero to the full load."""

from dataclasses import dataclass, field
from typing import Any

from turgor.core.model.model import Model
from turgor.core.solvers.procedures.channel_flow import channel_target, closed_by_channels
from turgor.core.solvers.procedures.procedure import DeckStep, refuse_remeshing
from turgor.core.solvers.procedures.step_options import StepOptions

#: Largest difference of the creep strain in an increment of Abaqus [-]; rubber in actuators strains by a hundred times
#: as much.
CREEP_TOLERANCE = 1e-3


@dataclass(frozen=True, slots=True, kw_only=True)
class Static(StepOptions):
    """Load control from zero to the full load, with steps that grow, cut back and hit requested loads exactly.

    Parameters
    ----------
    first_step : float [-]
        First increment of the load factor, at the start and after every point of a pressure's history, in (0, 1].
    max_step : float [-]
        Largest increment, in (0, 1]. So far apart are the states of a row of equal chambers whose walls meet, which the
        path of a shorter one leads.
    min_step : float [-]
        Smallest increment before the solve stops, in (0, first_step].
    at : tuple of float [-]
        Load factors that must be hit exactly besides 1, each in (0, 1].
    tolerance : float [-]
        Largest residual force relative to the applied and reaction forces.
    max_iterations : int
        Newton iterations before a step is cut back.
    max_steps : int
        Attempted steps before the solve stops.
    duration : float [s], optional
        Time at load factor 1, for rubber that relaxes: the load factor is time over duration, and histories of loads
        are over it. Steps are as long as ``max_step`` lets them, which decides the accuracy in time. By default the
        load grows so slowly that everything has relaxed.
    remesh : bool
        Whether cells are cut where they degrade, and the path goes on with the finer ones.

    Examples
    --------
    >>> Static(duration=20.0, max_step=0.02).duration
    20.0
    """

    load_control = True

    duration: float | None = field(default=None, metadata={"dimension": "time"})

    remesh: bool = False

    def follow(self, problem: Any) -> Any:
        """Step the load factor, and seek the pressures of cavities at channels."""
        if problem.system.controlled:
            from turgor.core.solvers.continuation.scalar_control.cavity_control import follow_cavities

            return follow_cavities(problem, self)
        from turgor.core.solvers.continuation.load_control import follow_load  # here: it needs the engine

        return follow_load(problem, self)

    def controlled(self, model: Model) -> tuple[str, ...]:
        """Name the cavities into which liquid flows through channels."""
        if self.remesh:
            refuse_remeshing(model)
        return closed_by_channels(model, self.duration)

    def target(self, chambers: Any, volumes: Any, pressures: Any) -> Any:
        """Each cavity grows by what flows in."""
        assert self.duration is not None
        return channel_target(chambers, volumes, self.duration)

    def deck_step(self, program: str, relaxes: bool) -> DeckStep:
        """Return a static step: without a duration one so slow that everything has relaxed."""
        if not relaxes or program != "abaqus":
            return DeckStep("*STATIC")
        if self.duration is None:
            return DeckStep("*STATIC, LONG TERM")
        return DeckStep(f"*VISCO, CETOL={CREEP_TOLERANCE:g}", most=self.max_step * self.duration)
