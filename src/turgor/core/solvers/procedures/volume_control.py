"""VolumeControl: an injected volume drives the path, so that the pressure may fall."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from turgor.core.model.model import Model
from turgor.core.solvers.procedures.cavity_procedure import CavityProcedure, by_cavity
from turgor.core.solvers.procedures.channel_flow import channel_target, closed_by_channels
from turgor.core.solvers.procedures.step_options import check_steps, make_numbers
from turgor.foundation.errors import TurgorError
from turgor.units import mL

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class VolumeControl(CavityProcedure):
    """Inject an incompressible fluid into cavities; the pressure is the answer, so it may fall.

    The load factor is the share of the volume that was injected; other loads grow with it. With a duration it is
    injected evenly in this time, and flows on through channels to other cavities.

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
    remesh : bool
        Whether cells are cut where they degrade, as in `Static`.

    Examples
    --------
    >>> VolumeControl(volume=12e-6).volume
    1.2e-05
    """

    drive = "injected_volume"
    drive_unit = "mL"
    requested_field = "volume"

    volume: float | Mapping[str, float] = field(metadata={"dimension": "volume"})
    first_step: float = 0.02
    max_step: float = 0.1
    min_step: float = 1e-5
    duration: float | None = field(default=None, metadata={"dimension": "time"})
    remesh: bool = False

    def __post_init__(self) -> None:
        make_numbers(self)
        for where, volume in by_cavity(self.volume, "volume").items():
            if not volume or not abs(volume) < 1e3:
                raise TurgorError(f"procedure.volume{where} is {volume:g} m³; a volume other than zero is needed.")
        check_steps(self)

    def closed(self, model: Model) -> tuple[str, ...]:
        """Name the cavities whose pressure is unknown because channels lead to them."""
        if all(load.channel is None for load in model.loads):
            return ()
        return closed_by_channels(model, self.duration, "volume_control")

    def target(self, chambers: Any, volumes: Array, pressures: Array) -> Any:
        """Each cavity has its volume at the start plus a share of the injected one, and what flows in."""
        injected = self.requested_of(chambers.faces) / chambers.system.length**3
        if self.duration is not None and self.closed(chambers.system.model):
            return channel_target(chambers, volumes, self.duration, injected)
        from turgor.core.solvers.constraints.cavities import VolumeTarget  # here: it needs the engine

        return VolumeTarget(chambers, volumes, injected)

    def amounts(self, chambers: Any, volumes: Array) -> Callable[[float], Array]:
        """Volumes injected since rest."""
        injected = self.requested_of(chambers.faces)
        before = (volumes - chambers.volumes(np.zeros(chambers.system.size))) * chambers.system.length**3
        return lambda load_factor: before + load_factor * injected

    def driven_text(self, now: Mapping[str, float], first: Mapping[str, float]) -> str:
        """The injected volume, relative to that at rest where the volume was another at the start."""
        injected, before = now[self.drive], first[self.drive]
        if not before:
            return f"an injected volume of {injected / mL:.4g} mL"
        if abs(injected) < 1e-6 * abs(before):
            return "the volume at rest"
        return f"a volume {abs(injected) / mL:.4g} mL {'larger' if injected > 0 else 'smaller'} than at rest"
