"""GasMass: an amount of gas, or the pressure around a sealed one, drives the path."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from turgor.core.model.model import Model
from turgor.core.solvers.procedures.cavity_procedure import CavityProcedure, by_cavity
from turgor.core.solvers.procedures.step_options import check_steps, make_numbers
from turgor.foundation.errors import TurgorError

Array = NDArray[np.float64]

#: Pressure of the air around [Pa].
STANDARD_ATMOSPHERE = 101_325.0


@dataclass(frozen=True, slots=True, kw_only=True)
class GasMass(CavityProcedure):
    """Pump a known amount of gas into closed cavities, or seal them and change the pressure around.

    Absolute pressure times volume to the power n follows the amount of gas: p Vⁿ = p₀ (m/m₀ V₀)ⁿ, with the ambient
    pressure p₀ and the volume V₀ at rest. The load factor leads from a mass ratio m/m₀ of 1 to the requested one,
    and from the ambient pressure to that outside; other loads grow with it.

    Parameters
    ----------
    mass_ratio : float [-], or mapping of str to float
        Gas in a cavity in the end over the gas in it at rest; by cavity where there are several.
    exponent : float [-]
        1 where the gas keeps its temperature (slow), 1.4 for air that exchanges no heat (fast), in [1, 1.7].
    ambient : float [Pa], absolute
        Pressure of the air around and inside at rest.
    outside : float [Pa], absolute, optional
        Pressure around in the end; that at rest if it is not given.
    pressure : float [Pa], gauge
        Pressure at which the cavities are sealed: up to the load factor ``seal`` they are filled to it, and what is
        said above about states at rest holds for that one. Zero seals them at rest.
    seal : float [-]
        Load factor at which they are sealed, in (0, 1); of no meaning without a pressure.
    first_step, max_step, min_step, at, tolerance, max_iterations, max_steps, duration
        As those of `VolumeControl`.

    Examples
    --------
    >>> GasMass(mass_ratio=2.0).final_outside
    101325.0
    """

    drive = "gas_mass_ratio"
    requested_field = "mass_ratio"
    neutral = 1.0

    mass_ratio: float | Mapping[str, float] = field(default=1.0, metadata={"dimension": "number"})
    exponent: float = 1.0
    ambient: float = field(default=STANDARD_ATMOSPHERE, metadata={"dimension": "pressure"})
    outside: float | None = field(default=None, metadata={"dimension": "pressure"})
    pressure: float = field(default=0.0, metadata={"dimension": "pressure"})
    seal: float = 0.5
    max_step: float = 0.1
    min_step: float = 1e-5
    duration: float | None = field(default=None, metadata={"dimension": "time"})

    def __post_init__(self) -> None:
        make_numbers(self)
        for where, ratio in by_cavity(self.mass_ratio, "mass_ratio").items():
            if not 0 < ratio <= 1000:
                raise TurgorError(f"procedure.mass_ratio{where} is {ratio:g}; allowed is more than 0 up to 1000.")
        if not 1 <= self.exponent <= 1.7:
            raise TurgorError(f"procedure.exponent is {self.exponent:g}; allowed is 1 to 1.7.")
        for name, value in (("ambient", self.ambient), ("outside", self.final_outside)):
            if not 0 <= value <= 1e8 or (name == "ambient" and not value):
                raise TurgorError(f"procedure.{name} is {value:g} Pa; an absolute pressure up to 1e8 Pa is needed.")
        if not -self.ambient < self.pressure <= 1e8:
            raise TurgorError(f"procedure.pressure is {self.pressure:g} Pa; more than minus the ambient one is needed.")
        if not 0 < self.seal < 1:
            raise TurgorError(f"procedure.seal is {self.seal:g}; a load factor between 0 and 1 is needed.")
        check_steps(self)

    def emptied(self, model: Model) -> tuple[str, ...]:
        """Name the cavities that it draws from; all of them where the pressure inside falls below that around."""
        outside = self.final_outside > self.ambient or self.pressure < 0
        return self.filled(model) if outside else super(GasMass, self).emptied(model)

    @property
    def final_outside(self) -> float:
        """Pressure around in the end [Pa]."""
        return self.ambient if self.outside is None else self.outside

    @property
    def turns(self) -> tuple[float, ...]:
        """Where the cavities are sealed, if not at the start."""
        return (self.seal,) if self.pressure else ()

    @property
    def no_gradient(self) -> str:
        """The state in which the cavities are sealed has no equation among those of a later one."""
        sealed = "the gas is sealed at a pressure, and its amount depends on the state there"
        return f"{sealed}; leave procedure.pressure out" if self.pressure else ""

    def check_stage(self, number: int) -> None:
        """A later stage seals the gas at the pressure that is there."""
        if number and self.pressure:
            raise TurgorError(
                f"procedure.pressure is {self.pressure:g} Pa, and the gas is sealed at the pressure that the "
                "former stage left; leave it out."
            )

    def target(self, chambers: Any, volumes: Array, pressures: Array) -> Any:
        """The law of the gas in scaled units."""
        from turgor.core.solvers.constraints.cavities import GasTarget  # here: it needs the engine
        from turgor.core.solvers.continuation.scalar_control.settings import CAVITY_CONTROL

        scale = chambers.system.stress_scale
        least = CAVITY_CONTROL.no_volume * float(np.ptp(chambers.system.points, axis=0).prod())
        for name, volume in zip(chambers.faces, volumes, strict=True):
            if volume <= least:
                raise TurgorError(f"{name} encloses no volume at rest, so it holds no gas; use VolumeControl.")
        return GasTarget(
            chambers=chambers,
            volume=volumes,
            mass_ratio=self.requested_of(chambers.faces),
            ambient=self.ambient / scale,
            outside=self.final_outside / scale,
            exponent=self.exponent,
            pressure=np.full(len(volumes), self.pressure / scale) if self.pressure else pressures,
            seal=self.seal if self.pressure else 0.0,
            sealed=not self.pressure,
        )

    def amounts(self, chambers: Any, volumes: Array) -> Callable[[float], Array]:
        """Gas in each cavity over that when it was sealed."""
        ratios, seal = self.requested_of(chambers.faces), self.seal if self.pressure else 0.0
        return lambda load_factor: 1 + max(load_factor - seal, 0.0) / (1 - seal) * (ratios - 1)

    def driven_text(self, now: Mapping[str, float], first: Mapping[str, float]) -> str:
        """The amount of gas, where one cavity is filled."""
        return f"{now[self.drive]:.4g} times the gas" if self.drive in now else ""
