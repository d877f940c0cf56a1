"""GasMass: an amount of gas, or the pressure around a sealed one, drives the path."""

from collections.abc import Mapping
from dataclasses import dataclass, field

from turgor.core.solvers.procedures.step_options import StepOptions, check_steps, make_numbers
from turgor.core.solvers.procedures.volume_control import by_cavity
from turgor.foundation.errors import TurgorError

#: Pressure of the air around [Pa].
STANDARD_ATMOSPHERE = 101_325.0


@dataclass(frozen=True, slots=True, kw_only=True)
class GasMass(StepOptions):
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

    @property
    def requested(self) -> float | Mapping[str, float]:
        """The mass ratio requested, of all cavities or by name."""
        return self.mass_ratio

    @property
    def requested_field(self) -> str:
        """The field that states it."""
        return "mass_ratio"

    @property
    def final_outside(self) -> float:
        """Pressure around in the end [Pa]."""
        return self.ambient if self.outside is None else self.outside
