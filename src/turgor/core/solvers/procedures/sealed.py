"""Sealed: the content of a cavity stays in it while other loads change."""

from collections.abc import Mapping
from dataclasses import dataclass, field

from turgor.core.solvers.procedures.step_options import check_steps
from turgor.core.solvers.procedures.volume_control import VolumeControl


@dataclass(frozen=True, slots=True, kw_only=True)
class Sealed(VolumeControl):
    """Keep the liquid in cavities while other loads change: their volumes stay, the pressures are the answer.

    As the first procedure, or the only one, it keeps the volumes at rest. Its steps and tolerance are those of
    `VolumeControl`; it takes no volume.

    Parameters
    ----------
    cavities : str or tuple of str
        Which are sealed; the only cavity if left out.

    Examples
    --------
    >>> Sealed(cavities="cavity_1").cavities
    ('cavity_1',)
    """

    requested_field = "cavities"

    cavities: str | tuple[str, ...] = field(default=(), metadata={"dimension": "names"})
    volume: float | Mapping[str, float] = field(init=False, default=0.0)

    def __post_init__(self) -> None:
        if isinstance(self.cavities, str):
            object.__setattr__(self, "cavities", (self.cavities,))
        object.__setattr__(self, "volume", dict.fromkeys(self.cavities, 0.0) or 0.0)
        check_steps(self)

    @property
    def requested(self) -> float | Mapping[str, float]:
        """Nothing is injected into the cavities."""
        return self.volume
