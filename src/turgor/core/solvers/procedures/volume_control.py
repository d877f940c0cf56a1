"""VolumeControl: an injected volume drives the path, so that the pressure may fall."""

from collections.abc import Mapping
from dataclasses import dataclass, field

from turgor.core.solvers.procedures.step_options import StepOptions, check_steps, make_numbers
from turgor.foundation.errors import TurgorError


@dataclass(frozen=True, slots=True, kw_only=True)
class VolumeControl(StepOptions):
    """Inject an incompressible fluid into cavities; the pressure is the answer, so it may fall.

    The load factor is the share of the volume that was injected; other loads grow with it.

    Parameters
    ----------
    volume : float [m³], or mapping of str to float
        Volume injected in the end, of the whole actuator where a half is modeled; by cavity where there are several.
        Negative volumes are drawn off.
    first_step, max_step, min_step : float [-]
        First, largest and smallest increment of the load factor, in (0, 1].
    at : tuple of float [-]
        Load factors that must be hit exactly besides 1, each in (0, 1].
    tolerance : float [-]
        Largest relative residual force, and largest error of a volume relative to that of the cavity.
    max_iterations : int
        Newton iterations before a step is cut back.
    max_steps : int
        Attempted steps before the solve stops.
    duration : float [s], optional
        Time at load factor 1, for rubber that relaxes, as that of `Static`.

    Examples
    --------
    >>> VolumeControl(volume=12e-6).volume
    1.2e-05
    """

    volume: float | Mapping[str, float] = field(metadata={"dimension": "volume"})
    first_step: float = 0.02
    max_step: float = 0.1
    min_step: float = 1e-5
    duration: float | None = field(default=None, metadata={"dimension": "time"})

    def __post_init__(self) -> None:
        make_numbers(self)
        for where, volume in by_cavity(self.volume, "volume").items():
            if not volume or not abs(volume) < 1e3:
                raise TurgorError(f"procedure.volume{where} is {volume:g} m³; a volume other than zero is needed.")
        check_steps(self)

    @property
    def requested(self) -> float | Mapping[str, float]:
        """The volume requested, of all cavities or by name."""
        return self.volume

    @property
    def requested_field(self) -> str:
        """The field that states it."""
        return "volume"


def by_cavity(value: float | Mapping[str, float], name: str) -> dict[str, float]:
    """Values by the text that names their place after the field."""
    if not isinstance(value, Mapping):
        return {"": value}
    if not value:
        raise TurgorError(f"procedure.{name} names no cavity; state a number, or one for each cavity.")
    return {f".{cavity}": each for cavity, each in value.items()}
