"""Procedures: how the path is followed."""

from dataclasses import dataclass, field
from math import inf

from turgor.errors import TurgorError
from turgor.model.model import Model
from turgor.solvers.duration import check_duration


@dataclass(frozen=True, slots=True, kw_only=True)
class Static:
    """Load control from zero to the full load, with steps that grow, cut back and hit requested loads exactly.

    Parameters
    ----------
    first_step : float [-]
        First increment of the load factor, at the start and after every point of a pressure's history, in (0, 1].
    max_step : float [-]
        Largest increment, in (0, 1].
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

    Examples
    --------
    >>> Static(duration=20.0, max_step=0.02).time_of(0.5)
    10.0
    """

    first_step: float = 0.05
    max_step: float = 0.25
    min_step: float = 1e-4
    at: tuple[float, ...] = ()
    tolerance: float = 1e-6
    max_iterations: int = 15
    max_steps: int = 1000
    duration: float | None = field(default=None, metadata={"dimension": "time"})

    def __post_init__(self) -> None:
        check_duration(self.duration)
        for name in ("first_step", "max_step", "min_step"):
            value = getattr(self, name)
            if not 0 < value <= 1:
                raise TurgorError(f"procedure.{name} is {value:g}; allowed is more than 0 up to 1.")
        if self.min_step > self.first_step:
            raise TurgorError(
                f"procedure.min_step is {self.min_step:g}; it must not exceed first_step, {self.first_step:g}."
            )
        if not 1e-12 <= self.tolerance <= 1e-2:
            raise TurgorError(f"procedure.tolerance is {self.tolerance:g}; allowed is 1e-12 to 0.01.")
        for name in ("max_iterations", "max_steps"):
            if getattr(self, name) < 1:
                raise TurgorError(f"procedure.{name} is {getattr(self, name)}; allowed is 1 or more.")
        for factor in self.at:
            if not 0 < factor <= 1:
                raise TurgorError(f"procedure.at holds {factor:g}; a load factor lies in (0, 1].")

    def time_of(self, load_factor: float) -> float | None:
        """Time at a load factor [s], None where there is no duration."""
        return None if self.duration is None else load_factor * self.duration

    def time_between(self, before: float, after: float) -> float:
        """Time from one load factor to another [s]; infinite where there is no duration."""
        return inf if self.duration is None else (after - before) * self.duration

    def amended(self, model: Model) -> Model:
        """Return the model with what the procedure adds to the question: nothing here."""
        return model


def question_of(model: Model, procedure: object) -> Model:
    """Return the model that a procedure follows: what was asked, with what the procedure adds to it.

    Parameters
    ----------
    model : Model
    procedure : Procedure
        `BlockedForce` and `Grasp` add a plate, a hold or a path of the object; the others add nothing.

    Returns
    -------
    Model
    """
    return procedure.amended(model) if isinstance(procedure, Static) else model
